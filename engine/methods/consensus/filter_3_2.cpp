#include "engine/methods/consensus/filter_impl.hpp"

namespace vigil::consensus {
template class Filter<3, 2>;
}  // namespace vigil::consensus
