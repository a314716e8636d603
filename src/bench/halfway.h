// Halfway between a model at rest and its shapes: errors of edges and volume, in log space and linearly.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::bench {

/// A model at rest, and shapes of it.
struct ShapesOfModel {
  mesh::Surface rest;
  std::vector<std::string> names;
  std::vector<std::vector<mesh::Point>> shapes;
};

/// Throws base::Error.
ShapesOfModel read_shapes_of_model(const std::filesystem::path& rest,
                                   const std::vector<std::filesystem::path>& shapes);

/// Root mean square of |log(length in shape / geometric mean of the lengths in a and b)| over all edges.
/// Skips edges without length.
double edge_error(std::span<const mesh::Edge> edges, std::span<const mesh::Point> a,
                  std::span<const mesh::Point> b, std::span<const mesh::Point> shape);

/// Halfway from rest to each shape, in log space and linearly: a row for each shape, with deviations of edges
/// and volume from those of both ends. The volume is relative to the smaller end's, NaN for a model that
/// encloses none; "volumes": at 21 evenly spaced moments from rest to the shape. Throws base::Cancelled.
nlohmann::json measure_halfway(const ShapesOfModel& model, base::Progress& progress);

}  // namespace viete::bench
