// Link 5 of the frame: x' = exp(Y) exp(X) (x - sum w c) + sum w c'.
#pragma once

#include <span>

#include "deform/blend.h"

namespace viete::deform {

/// Vertices [begin, end) of positions from the sums and their stretch exponentials (link 4: sym3::exp of
/// sums.stretch): origin + (exp(Y) exp(X) offset + center), origin = pose_origin().
void apply(const Binding& binding, const BlendedLogs& sums, std::span<const sym3::Sym3<double>> stretches,
           const Vec3& origin, std::size_t begin, std::size_t end, std::span<mesh::Point> positions);

}  // namespace viete::deform
