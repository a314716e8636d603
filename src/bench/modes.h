// viete bench modes: all schemes side by side on the poses of a model.
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

/// A deformed model beside the model at rest.
struct ShapeQuality {
  Distortion distortion;
  double bending = 0;  ///< RestModel::bending()
  double volume = 1;   ///< over that at rest; NaN where the model encloses none
  double gap = 0;      ///< see bench::gap()
  double torn = 0;     ///< see bench::torn()
  /// Over those of mean value coordinates in the same run; NaN where these have next to none, or are not
  /// there.
  double energy_ratio = 0, bending_ratio = 0, torn_ratio = 0;
};

/// One way of blending.
struct Mode {
  deform::Scheme scheme;
  std::string problem;                  ///< why it cannot be had of this model and cage; empty: it can
  std::array<double, 4> deviations{};   ///< of whole_poses()
  double leak = 0;                      ///< see bench::leak()
  std::vector<ShapeQuality> qualities;  ///< one a pose
  bool fused = false;                   ///< its frame, which is timed
  double frame_ms = 0, bind_ms = 0;     ///< processor time of one thread
};

/// All that are measured of one model in one cage.
struct ModeComparison {
  std::vector<Mode> modes;
  bool encloses = true;                 ///< the model has a volume to compare
  std::size_t without_area = 0;         ///< triangles of the model that are left out
  double rest_gap = 0;                  ///< with which to compare the gaps of poses
  std::vector<std::string> warnings{};  ///< of the bindings, each once
};

/// The model's vertices in a pose of the cage.
using Deform = std::function<std::vector<mesh::Point>(const deform::Pose&)>;

/// A map of space, posing the cage as a whole: x -> linear (x - middle) + middle + shift, the middle that of
/// the cage's box, the shift in its diagonals.
struct WholePose {
  const char* name;
  sym3::Mat3<double> linear;
  mesh::Vec3 shift;
};
/// A translation, a rigid motion, a similarity and an affine pose, each of its kind and no simpler.
std::span<const WholePose> whole_poses();

/// What a deformation is said to reproduce if it is no farther off: what rounding leaves.
inline constexpr double exactly = 1e-9;

/// How far the model is from where the pose has the space around it: the largest distance of a vertex, in
/// diagonals of the posed cage.
double deviation(const WholePose& pose, const deform::Cage& cage, std::span<const mesh::Point> model,
                 const Deform& deform);

/// What one vertex of the cage does to what is far from it: it is moved along its normal by a tenth of the
/// cage's diagonal, and this is how far those vertices of the model move that are more than a quarter of it
/// away, in diagonals: the median of those, and of at most 8 vertices of the cage. NaN if none is so far
/// away.
double leak(const deform::Cage& cage, std::span<const mesh::Point> model, const Deform& deform);

/// A point of the cage's surface: of a triangle by its corners.
struct CagePoint {
  std::uint32_t triangle;
  mesh::Vec3 barycentric;
};
/// Of each point the nearest one of the cage at rest.
std::vector<CagePoint> nearest_on_cage(const deform::Cage& cage, std::span<const mesh::Point> points,
                                       base::WorkerPool& pool);
/// How far the points are from where a pose has these of the cage: mean by shares, which sum to 1, in
/// diagonals of the cage at rest.
double gap(const deform::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const mesh::Point> posed_cage, std::span<const mesh::Point> points);

/// Pairs of vertices within 1 % of the model's diagonal that are of different parts (vertices at the same
/// place counting as one), or within 0.1 % of it where no path of edges shorter than 1 % joins them. Of large
/// models, those of 20,000 vertices spread over the file.
std::vector<mesh::Edge> near_pairs(const mesh::Surface& model, base::WorkerPool& pool);

/// The largest change of distance of these pairs, in diagonals of the model at rest; 0 without pairs.
double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions);

struct ModeSettings {
  std::size_t rounds = 11;
  deform::PartialChoice choice{};  ///< if any: all ways of blending that have it, and mean value coordinates
  std::optional<double> radius{};  ///< of cut-off weights
  sym3::Method method = sym3::Method::fast;
  int iterations = 0;  ///< of stitching, where a way of blending can be stitched
  deform::Holding holding{};
  bool named_only = false;  ///< only ways that have names
};

struct ModesOptions {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;
  ModeSettings settings;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// The ways that have names and the other valid schemes that have what is chosen, measured in double, link by
/// link, stitched ones as they run; frames as the program would run them, one after the other, in interleaved
/// rounds, of the first pose. poses must not be empty. Throws base::Error, base::Cancelled.
ModeComparison measure_modes(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                             std::span<const NamedPose> poses, const ModeSettings& settings,
                             base::Progress& progress);

/// Named by their files: "pose_alert.obj" is alert. Throws base::Error.
std::vector<NamedPose> read_poses(std::span<const std::filesystem::path> files, const deform::Cage& cage,
                                  std::vector<std::string>& warnings);

/// Prints the tables. Throws base::Error.
void bench_modes(const ModesOptions& options);

}  // namespace viete::bench
