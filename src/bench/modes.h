// viete bench modes: compares all schemes on the poses of a model.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "bench/models.h"
#include "deform/cage.h"
#include "deform/scheme.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::bench {

struct NamedPose {
  std::string name;
  deform::Pose pose;
};

/// Measures of a deformed model relative to the model at rest.
struct ShapeQuality {
  double energy = 0;          ///< see Distortion
  std::size_t collapsed = 0;  ///< see Distortion
  double bending = 0;         ///< see RestModel::bending()
  double volume = 1;          ///< relative to rest; NaN if the model encloses none
  double gap = 0;             ///< see bench::gap()
  double torn = 0;            ///< see bench::torn()
  /// Relative to mean value coordinates in the same run; NaN if those are nearly 0 or not measured.
  double energy_ratio = NAN, bending_ratio = NAN, torn_ratio = NAN;
};

/// Results of one scheme.
struct Mode {
  deform::Scheme scheme;
  std::string problem;                  ///< why the scheme cannot be used with this model and cage; or empty
  std::array<double, 4> deviations{};   ///< one for each of whole_poses()
  double leak = 0;                      ///< see bench::leak()
  std::vector<ShapeQuality> qualities;  ///< one per pose
  bool fused = false;                   ///< true if the timed frame is fused
  double frame_ms = 0, bind_ms = 0;     ///< processor time of one thread
};

/// Results of all schemes for one model in one cage.
struct ModeComparison {
  std::vector<Mode> modes;
  bool encloses = true;                 ///< true: the model has a volume to compare
  std::size_t without_area = 0;         ///< triangles of the model without area, which are ignored
  double rest_gap = 0;                  ///< gap at rest, as a reference for poses
  std::vector<std::string> warnings{};  ///< warnings of the bindings, without duplicates
};

/// A pose of the whole cage by one map of space: x -> linear (x - middle) + middle + shift. middle is the
/// middle of the cage's box, and shift is in diagonals of the box.
struct WholePose {
  const char* name;
  sym3::Mat3<double> linear;
  mesh::Vec3 shift;
};
/// A translation, a rigid motion, a similarity and an affine pose.
std::span<const WholePose> whole_poses();

/// A deformation with at most this deviation reproduces a pose up to rounding.
inline constexpr double exactly = 1e-9;

/// Returns the model's vertices in a pose of the cage.
using Deform = std::function<std::vector<mesh::Point>(const deform::Pose&)>;

/// Returns the largest distance of a vertex from its image under the map, in diagonals of the posed cage.
double deviation(const WholePose& pose, const deform::Cage& cage, std::span<const mesh::Point> model,
                 const Deform& deform);

/// Measures the effect of one cage vertex on distant parts. The vertex moves along its normal by a tenth of
/// the cage's diagonal. Returns how far model vertices more than a quarter of the diagonal away move, in
/// diagonals: the median over them and over at most 8 cage vertices. NaN if no vertex is that far away.
double leak(const deform::Cage& cage, std::span<const mesh::Point> model, const Deform& deform);

/// A point of the cage's surface: a triangle and barycentric coordinates.
struct CagePoint {
  std::uint32_t triangle;
  mesh::Vec3 barycentric;
};
/// Returns for each point the nearest point of the cage at rest.
std::vector<CagePoint> nearest_on_cage(const deform::Cage& cage, std::span<const mesh::Point> points,
                                       base::WorkerPool& pool);
/// Returns the mean distance of the points from the posed positions of these cage points, in diagonals of the
/// cage at rest. The mean is weighted by shares, whose sum is 1.
double gap(const deform::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const mesh::Point> posed_cage, std::span<const mesh::Point> points);

/// Returns pairs of vertices that are near but not connected. Vertices of different parts must be within 1 %
/// of the model's diagonal (vertices at the same place count as one). Vertices of one part must be within
/// 0.1 %, and no path of edges shorter than 1 % may join them. The model must have a triangle. In large
/// models, only 20,000 vertices spread over the file are compared with all others.
std::vector<mesh::Edge> near_pairs(const mesh::Surface& model);
/// Returns the largest change of distance of these pairs, in diagonals of the model at rest; 0 without pairs.
double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions);

struct ModeSettings {
  std::size_t rounds = 11;
  deform::PartialChoice choice{};  ///< if set: all schemes that agree with it, and mean value coordinates
  std::optional<double> radius{};  ///< for cut-off weights
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< number of solves, for schemes that can be stitched
  deform::Holding holding{};
  bool named_only = false;  ///< only named deformers
};

/// Measures named deformers and other valid schemes that match settings.choice. Computes shapes in double,
/// step by step if not stitched. Times frames of the first pose as in the program, sequentially and in
/// interleaved rounds. poses must not be empty. Throws base::Error and base::Cancelled.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress);

/// Reads poses and names them by their files: "pose_alert.obj" becomes "alert". Throws base::Error.
std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                                  std::vector<std::string>& warnings);

/// Least, median and largest value over the poses; NaN if no pose has a number.
struct OverPoses {
  double least, middle, most;
};
OverPoses over_poses(const Mode& mode, double ShapeQuality::*value);

nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses);

/// Prints the tables of the schemes and of each pose, and a summary of several poses. Throws base::Error.
void bench_modes(const ModelOptions& options, ModeSettings settings);

}  // namespace viete::bench
