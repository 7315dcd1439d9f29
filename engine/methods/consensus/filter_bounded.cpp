#include "engine/methods/consensus/filter_impl.hpp"

namespace vigil::consensus {
template class Filter<Eigen::Dynamic, Eigen::Dynamic>;
}  // namespace vigil::consensus
