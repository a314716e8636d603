// Halfway from a model at rest to its shapes: how far edges and volume are off, in log space and straight.
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

/// Root mean square of |log(length in shape / geometric mean of the lengths in a and b)| over all edges. Edges
/// without length are skipped.
double edge_error(std::span<const mesh::Edge> edges, std::span<const mesh::Point> a,
                  std::span<const mesh::Point> b, std::span<const mesh::Point> shape);

/// Halfway from rest to each shape, in log space and on straight lines: how far edges and volume are from
/// those of both ends. The volume is over the smaller end's, NaN where the model encloses none; so are those
/// of `moments` even ones from rest (the first) to the shape (the last one). Throws base::Cancelled.
nlohmann::json measure_halfway(const ShapesOfModel& model, base::Progress& progress, std::size_t moments = 0);
/// Positions there: on straight lines, and in log space.
struct HalfwayShapes {
  std::vector<mesh::Point> straight, in_log_space;
};
HalfwayShapes halfway_to(const ShapesOfModel& model, std::size_t shape);

/// The row of the shape that straight lines lose most volume on the way to; null if there is none.
const nlohmann::json* most_lost(const nlohmann::json& halfway);
/// By its file: "shape_coiled.pc2" is coiled.
std::string name_of_shape(const nlohmann::json& row);

}  // namespace viete::bench
