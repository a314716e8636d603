// The matrices that benchmarks run on, all from fixed seeds.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <vector>

#include "sym3/sym3.h"

namespace viete::app {

using Matrices = std::vector<sym3::Sym3<double>>;
using Random = std::mt19937_64;

/// The paper's: S = M M^T, entries of M uniform in [-1, 1].
Matrices paper_ensemble(std::size_t count);

/// The upper triangle's six entries uniform in [low, high].
Matrices uniform_entries(double low, double high, std::size_t count);

/// Two eigenvalues `gap` apart and one anywhere, or three, each `gap` from the next; all within [0, 3].
Matrices pairs(double gap, std::size_t count);
Matrices triples(double gap, std::size_t count);

/// Largest minus smallest eigenvalue = spread, around zero; the middle one at either end, near it, half-way or anywhere.
Matrices spreads(double spread, std::size_t count);

/// Eigenvalues as given, up to the rounding of the entries, in a frame that is uniform over the rotations.
sym3::Sym3<double> with_eigenvalues(const std::array<double, 3>& values, Random& random);

}  // namespace viete::app
