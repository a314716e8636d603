// How far a pose tears apart what lies together at rest and no edges join.
#pragma once

#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::bench {

/// Pairs of vertices within 1 % of the model's diagonal that are of different parts (vertices at the same
/// place counting as one), or within 0.1 % of it where no path of edges shorter than 1 % joins them. Of large
/// models, those of 20,000 vertices spread over the file.
std::vector<mesh::Edge> near_pairs(const mesh::Surface& model, base::WorkerPool& pool);

/// The largest change of distance of these pairs, in diagonals of the model at rest; 0 without pairs.
double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions);

}  // namespace viete::bench
