/// Importer of UTIAS MRCLAM recordings (Leung, Halpern, Barfoot, Liu, IJRR 30(8), 2011): one robot becomes a trace.
#pragma once

#include <string>

namespace vigil {

/// Contents of the five files of one robot; the caller reads them.
struct MrclamFiles {
  std::string barcodes;     ///< subject, barcode
  std::string landmarks;    ///< subject, x, y, … [m]
  std::string groundtruth;  ///< time [s], x, y [m], orientation [rad]
  std::string measurement;  ///< time [s], barcode, range [m], bearing [rad]
  std::string odometry;     ///< time [s], forward velocity [m/s], angular velocity [rad/s]
};

/// A frame file with columns truth.{x,y,theta}, input.{v,omega}, sensor.<landmark>.{range,bearing} and, in row 0, the
/// survey node.<landmark>.position.{x,y}. Tick k is at k dt after the first moment that odometry and truth both cover.
/// Inputs are the mean of the odometry, held between its rows, from tick k-1 to k; truth is interpolated; a reading
/// goes to the nearest tick (several of one landmark are averaged). Readings of other robots and unknown barcodes are
/// left out. Throws InputError naming the file and line.
std::string mrclam_to_csv(const MrclamFiles& files, double dt);

}  // namespace vigil
