/// The figures of runs side by side.
#pragma once

#include "server/compare/compared_run.hpp"

namespace vigil {

/// [{"lane","node","name","variant","values":[…],"difference":[…]}]: every metric that any run has; difference from the
/// first run, null where one has none or the values are no numbers.
Json metric_rows(const std::vector<ComparedRun>& runs);

/// Where runs of one document and of another share two seeds or more: the metrics' differences, paired seed by seed.
/// [{"metric":{"lane","node","name","variant"},"against":id,"pairs":[[id,id],…],"mean","se","ci","p","n"}]: mean of the
/// second less the first; `against` is the first run of the second document.
Json paired_metrics(const std::vector<ComparedRun>& runs);

/// {"mean","se","ci":[lo,hi] or null,"p","n"} and, where they were used, "batches" and "lag1".
Json paired_json(const struct PairedDifference& paired);

/// A number, or null where it is not finite.
Json finite_json(double value);

}  // namespace vigil
