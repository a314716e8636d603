// Compares log space and linear interpolation halfway from a model at rest to its shapes.
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

struct ShapesOfModel {
  mesh::Surface rest;
  std::vector<std::string> names;
  std::vector<std::vector<mesh::Point>> shapes;
};

/// Reads the model at rest and its shapes. Throws base::Error.
ShapesOfModel read_shapes_of_model(const std::filesystem::path& rest,
                                   const std::vector<std::filesystem::path>& shapes);

/// Returns the root mean square of log(length in shape / geometric mean of lengths in a and b) over all
/// edges. Skips edges of length 0.
double edge_error(std::span<const mesh::Edge> edges, std::span<const mesh::Point> a,
                  std::span<const mesh::Point> b, std::span<const mesh::Point> shape);

/// Results halfway from rest to each shape, in log space and with linear interpolation.
struct Halfway {
  /// One row for each shape. "edges" is edge_error(). "volume" is relative to the smaller volume of rest and
  /// shape, or NaN if the model encloses no volume. "volumes" has the relative volumes at 21 even steps from
  /// rest to the shape.
  nlohmann::json rows;
  std::size_t most_lost = 0;  ///< row of the smallest volume halfway, with linear interpolation
};
/// Requires one shape or more. Throws base::Cancelled.
Halfway measure_halfway(const ShapesOfModel& model, base::Progress& progress);

/// Returns the shape's name: "coiled" for the file "shape_coiled.pc2".
std::string name_of_shape(const nlohmann::json& row);

}  // namespace viete::bench
