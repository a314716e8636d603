// Makes the vector functions of base available in this namespace.
#pragma once

#include "base/vector.h"

namespace viete::mesh {

using base::cosine, base::cross, base::dot, base::largest_abs, base::norm, base::relative_to,
    base::squared_norm, base::stable_norm, base::Vec3, base::Vec3f;

}  // namespace viete::mesh
