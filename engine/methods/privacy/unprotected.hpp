/// Messages to a fusion centre that nothing protects.
#pragma once

#include <memory>

#include "engine/methods/privacy/protection.hpp"

namespace vigil::privacy {

/// Who listens (`fusing`, `zero`) knows what the legitimate user does.
std::unique_ptr<Protection> unprotected(const Knowledge& knowledge);

}  // namespace vigil::privacy
