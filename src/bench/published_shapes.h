// Shapes of published meshes, a lion's poses and a horse's gallop, and what is known to be possible there.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/bars.h"
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
/// Of a folder that holds lion/rest.obj and lion/pose_##.obj. Throws base::Error.
ShapesOfModel read_lion(const std::filesystem::path& folder);

/// Halfway from rest to each shape, in log space and on straight lines: how far edges and volume are from
/// those of both ends. The volume is over the smaller end's, NaN where the model encloses none; so are those
/// of `moments` even ones from rest (the first) to the shape (the last one). Throws base::Cancelled.
nlohmann::json measure_halfway(const ShapesOfModel& model, base::Progress& progress, std::size_t moments = 0);
/// Positions there: on straight lines, and in log space.
struct HalfwayShapes {
  std::vector<mesh::Point> straight, in_log_space;
};
HalfwayShapes halfway_to(const ShapesOfModel& model, std::size_t shape);
void print_halfway(const nlohmann::json& halfway);

/// The row of the shape that straight lines lose most volume on the way to; null if there is none.
const nlohmann::json* most_lost(const nlohmann::json& halfway);
/// By its file: "shape_coiled.pc2" is coiled.
std::string name_of_shape(const nlohmann::json& row);

/// The lion's, compared with their bars.
void check_halfway(const nlohmann::json& halfway, Bars& bars);

/// Frames of horse/gallop_##.obj that are left out, and filled in by a timeline; and frames that are posed by
/// seven vertices and six of the others, beside linear blend shapes. Throws base::Error.
nlohmann::json check_gallop(const std::filesystem::path& folder, Bars& bars);

}  // namespace viete::bench
