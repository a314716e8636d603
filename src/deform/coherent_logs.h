// Which of the many logs of a rotation, over a mesh of many triangles: neighbours take near ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/vector.h"
#include "sym3/rotation.h"

namespace viete::deform {

/// Triangles and their neighbours.
struct WeightedPairs {
  std::vector<mesh::Edge> pairs;  ///< i < j, sorted, each once
  std::vector<double> weights;    ///< of each pair, how much it counts
  mesh::Adjacency around;         ///< of each triangle its pairs
};
WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas);

/// Makes the sum of the distances between neighbours' logs, by weight, small, by other branches than the
/// given ones. Tried are those along the tree of least relative rotations, from the triangle of each part
/// that turns least: they are taken where the sum over what differs, and hangs together, is less; then what
/// is nearest to each triangle's neighbours. So the sum never grows: what is coherent stays, bit for bit, and
/// a single triangle that was turned over turns no others. Near a whole turn other than 0 logs have no clear
/// axis, and no choice is coherent. Thread-safe. O(n log n).
void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<mesh::Vec3>& logs);

/// Pairs whose logs are more than half a turn apart.
std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const mesh::Vec3> logs);

}  // namespace viete::deform
