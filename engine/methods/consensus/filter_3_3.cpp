#include "engine/methods/consensus/filter_impl.hpp"

namespace vigil::consensus {
template class Filter<3, 3>;
}  // namespace vigil::consensus
