// Takes vertices out of a closed mesh where they are missed least.
#pragma once

#include <functional>

#include "dragon/mesh.h"

namespace viete::dragon {

/// How much an error at a place counts.
using Importance = std::function<double(Vec3)>;

/// Collapses edges until the mesh has the given number of vertices, cheapest first, by quadric error (Garland
/// and Heckbert 1997) with a small cost on length that keeps flat regions even. A closed manifold mesh stays
/// one, of the same genus. Ties are broken by vertex number, so that the result is the same everywhere. Edges
/// below the length shortest go first, in one quick pass; importance weighs the error.
Mesh simplify(Mesh mesh, std::size_t vertices, double shortest, const Importance& importance);

}  // namespace viete::dragon
