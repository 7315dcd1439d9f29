/// What those of section 3.5 of the specification (privacy) look at, as weights of the noises that they meet.
#pragma once

#include <vector>

#include "engine/methods/privacy/dp_fusion.hpp"
#include "engine/methods/privacy/loss_meter.hpp"

namespace vigil::privacy {

/// Noise at the sensors: the mechanism's noise of a tick is xi, n L, before the gains G. Views mean, mean_worst,
/// mean_difference, instant, packets, fused_stream, packet_stream and sustained, all of the output after the sensors.
std::vector<LossView> dp_sensor_losses(const DpFusion& design, const DpSettings& settings);

/// Noise of variance q at the centre: the mechanism's noise of a tick is that of what is published, n. Views mean,
/// mean_worst, mean_difference, mean_stream (all that is published from then on) and sustained; packets and
/// packet_stream, which meet no noise.
std::vector<LossView> dp_centre_losses(const DpFusion& design, const DpSettings& settings, double q);

}  // namespace vigil::privacy
