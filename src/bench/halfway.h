// Halfway between a model at rest and its shapes: errors of edges and volume, in log space and linearly.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/plot.h"
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

/// Vertices on the visible side of a model, from above and from the side, back faces removed: centred at 0,
/// y up, in diagonals of the model at rest.
struct ShapePicture {
  std::string name;
  std::vector<SvgPoint> dots;
};

/// Halfway from rest to each shape, in log space and linearly.
struct Halfway {
  /// Per shape, halfway: "edges", see edge_error(); "volume", relative to the smaller of the volumes at rest
  /// and in the shape, NaN for a model that encloses none. "volumes": the same at 21 evenly spaced moments
  /// from rest to the shape.
  nlohmann::json rows;
  std::size_t most_lost = 0;           ///< row of the shape with the largest volume loss on straight lines
  std::vector<ShapePicture> pictures;  ///< from rest to that shape
};
/// Needs at least one shape. Throws base::Cancelled.
Halfway measure_halfway(const ShapesOfModel& model, base::Progress& progress);

/// Shape name from its file: "shape_coiled.pc2" is coiled.
std::string name_of_shape(const nlohmann::json& row);

}  // namespace viete::bench
