// viete bench modes: compares all schemes on the poses of a model.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "bench/mode_comparison.h"
#include "bench/models.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::bench {

/// The model's vertices in a pose of the cage.
using Deform = std::function<std::vector<mesh::Point>(const deform::Pose&)>;

/// Distance of the model from the image of space under the pose: the largest over vertices, in diagonals of
/// the posed cage.
double deviation(const WholePose& pose, const deform::Cage& cage, std::span<const mesh::Point> model,
                 const Deform& deform);

/// Effect of one cage vertex on distant parts: the vertex moves along its normal by a tenth of the cage's
/// diagonal; measured is the displacement of those vertices of the model that are more than a quarter of the
/// diagonal away, in diagonals: the median over them and over at most 8 vertices of the cage. NaN if no
/// vertex is that far away.
double leak(const deform::Cage& cage, std::span<const mesh::Point> model, const Deform& deform);

/// A point of the cage's surface: a triangle and barycentric coordinates.
struct CagePoint {
  std::uint32_t triangle;
  mesh::Vec3 barycentric;
};
/// For each point the nearest point of the cage at rest.
std::vector<CagePoint> nearest_on_cage(const deform::Cage& cage, std::span<const mesh::Point> points,
                                       base::WorkerPool& pool);
/// Distance of the points from the posed positions of these cage points: mean weighted by shares (sum 1), in
/// diagonals of the cage at rest.
double gap(const deform::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const mesh::Point> posed_cage, std::span<const mesh::Point> points);

/// Pairs of vertices within 1 % of the model's diagonal that belong to different parts (vertices at the same
/// place count as one), or within 0.1 % if no path of edges shorter than 1 % joins them. For large models,
/// only 20,000 vertices spread over the file are considered.
std::vector<mesh::Edge> near_pairs(const mesh::Surface& model, base::WorkerPool& pool);

/// The largest change of distance of these pairs, in diagonals of the model at rest; 0 without pairs.
double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions);

struct ModeSettings {
  std::size_t rounds = 11;
  deform::PartialChoice choice{};  ///< if set: all schemes that agree with it, and mean value coordinates
  std::optional<double> radius{};  ///< for cut-off weights
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< of stitching, for schemes that can be stitched
  deform::Holding holding{};
  bool named_only = false;  ///< only named deformers
};

struct ModesOptions {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;
  ModeSettings settings;
  std::filesystem::path json;  ///< output of the numbers; empty: none
};

/// Measures named deformers and other valid schemes that match settings.choice. Computes shapes in double,
/// step by step if not stitched. Times frames of the first pose as in the program, sequentially and in
/// interleaved rounds. poses must not be empty. Throws base::Error and base::Cancelled.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress);

/// Names poses by their files: "pose_alert.obj" is alert. Throws base::Error.
std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                                  std::vector<std::string>& warnings);

/// Prints the tables. Throws base::Error.
void bench_modes(const ModesOptions& options);

}  // namespace viete::bench
