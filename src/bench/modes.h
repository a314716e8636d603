// viete bench modes: compares all deformers on the poses of a model.
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
#include "mesh/half_edges.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "pose/deformer.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::bench {

struct NamedPose {
  std::string name;
  pose::Pose pose;
};

/// Numbers that compare a deformed model with the model at rest.
struct ShapeQuality {
  double energy = 0;          ///< see Distortion
  std::size_t collapsed = 0;  ///< see Distortion
  double bending = 0;         ///< see RestModel::bending()
  double volume = 1;          ///< relative to rest; NaN if the model encloses no volume
  double gap = 0;             ///< see bench::gap()
  double torn = 0;            ///< see bench::torn()
  /// `energy`, `bending` and `torn` of this deformer, divided by those of mean value coordinates. NaN if the
  /// divisor is nearly 0 or unknown.
  double energy_ratio = NAN, bending_ratio = NAN, torn_ratio = NAN;
};

/// Results of one deformer.
struct Mode {
  pose::Deformer deformer;
  std::string problem;                  ///< reason if this model and cage do not support the deformer
  std::array<double, 4> deviations{};   ///< one deviation for each of whole_poses()
  double leak = 0;                      ///< see bench::leak()
  std::vector<ShapeQuality> qualities;  ///< one entry for each pose
  bool fused = false;                   ///< true if the timed frame is fused
  double frame_ms = 0, bind_ms = 0;     ///< processor time of one thread
};

/// Results of all deformers for one model in one cage.
struct ModeComparison {
  std::vector<Mode> modes;
  bool encloses = true;                 ///< true if the model has a volume to compare
  std::size_t without_area = 0;         ///< number of ignored triangles without area
  double rest_gap = 0;                  ///< bench::gap() at rest, to compare with the gaps of poses
  std::vector<std::string> warnings{};  ///< warnings of the bindings, without duplicates
};

/// A pose of the whole cage by one map: x -> linear * (x - middle) + middle + shift. `middle` is the middle
/// of the cage's box, and `shift` is in diagonals of the box.
struct WholePose {
  const char* name;
  sym3::Mat3<double> linear;
  mesh::Vec3 shift;
};
/// Returns four poses: a translation, a rigid motion, a similarity and an affine pose.
std::span<const WholePose> whole_poses();

/// If the deviation is at most this value, a deformation reproduces a pose up to rounding.
inline constexpr double exactly = 1e-9;

/// Returns the model's vertices for a pose of the cage.
using Deform = std::function<std::vector<mesh::Point>(const pose::Pose&)>;

/// Returns the largest distance between a deformed vertex and the vertex moved by the map of `pose`, in
/// diagonals of the posed cage.
double deviation(const WholePose& pose, const pose::Cage& cage, std::span<const mesh::Point> model,
                 const Deform& deform);

/// Moves one cage vertex along its normal by a tenth of the cage's diagonal. Takes the median motion of all
/// model vertices that were more than a quarter of the diagonal away from this cage vertex. Returns the
/// median of these medians over at most 8 cage vertices, in diagonals. If no model vertex is that far away,
/// returns NaN.
double leak(const pose::Cage& cage, std::span<const mesh::Point> model, const Deform& deform);

/// A point of the cage's surface: a triangle and barycentric coordinates.
struct CagePoint {
  std::uint32_t triangle;
  mesh::Vec3 barycentric;
};
/// Returns for each point the nearest point of the cage at rest.
std::vector<CagePoint> nearest_on_cage(const pose::Cage& cage, std::span<const mesh::Point> points,
                                       base::WorkerPool& pool);
/// Returns the mean distance between the points and the posed positions of `nearest`, in diagonals of the
/// cage at rest. The weights of the mean are `shares`; their sum is 1.
double gap(const pose::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const mesh::Point> posed_cage, std::span<const mesh::Point> points);

/// Returns pairs of vertices that are near but not connected. Vertices at one place count as one vertex. The
/// pairs are, with distances in percent of the model's diagonal:
///   - vertices of different parts, with a distance of at most 1 %
///   - vertices of one part, with a distance of at most 0.1 %, if all paths of edges between them exceed 1 %
/// In large models, only 20,000 evenly chosen vertices are compared with all other vertices. The model must
/// have a triangle.
std::vector<mesh::Edge> near_pairs(const mesh::Surface& model);
/// Returns the largest change of the distance of a pair, in diagonals of the model at rest; 0 without pairs.
double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions);

struct ModeSettings {
  std::size_t rounds = 11;
  pose::PartialChoice choice{};    ///< limits the deformers; mean value coordinates are always measured
  std::optional<double> radius{};  ///< radius of cut-off weights
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< number of solves for stitched deformers
  pose::Holding holding{};
  bool named_only = false;  ///< if true, measures only named deformers
};

/// Measures the named deformers and all other valid deformers, if they match settings.choice. The staged
/// engine computes the shapes, except those of stitched deformers. Frame times are for the first pose, on one
/// thread, in interleaved rounds. `poses` must not be empty. Throws base::Error and base::Cancelled.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress);

/// Reads poses and names them by their files: "pose_alert.obj" becomes "alert". Throws base::Error.
std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const pose::Cage& cage,
                                  std::vector<std::string>& warnings);

/// The smallest, the median and the largest value over the poses. NaN if no pose has a number.
struct OverPoses {
  double least, middle, most;
};
OverPoses over_poses(const Mode& mode, double ShapeQuality::*value);

nlohmann::json to_json(const ModeComparison& compared, std::span<const NamedPose> poses);

/// Prints the tables of the deformers and of each pose, and a summary of all poses. Throws base::Error.
void bench_modes(const ModelOptions& options, ModeSettings settings);

}  // namespace viete::bench
