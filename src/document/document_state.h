// The part of a document that edits change: surfaces, pose, selection, settings and named poses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "document/range.h"
#include "document/selection.h"
#include "document/timeline.h"
#include "formats/attributes.h"
#include "formats/original.h"
#include "mesh/splats.h"
#include "mesh/summary.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "pose/deformer.h"
#include "pose/probe.h"
#include "weights/binding.h"

namespace viete::document {

struct NamedPose {
  std::string name;
  SharedPose pose;
  double weight = 0;  ///< the factor of the pose in the mix; may be negative or above 1

  friend bool operator==(const NamedPose&, const NamedPose&) = default;
};

struct NamedShape {
  std::string name;
  SharedShape shape;  ///< never null
};

/// The named poses, in the order of the user's list.
struct PoseLibrary {
  static constexpr double least_weight = -2, largest_weight = 3;
  static constexpr std::size_t most_poses = 1000, longest_name = 200;

  std::vector<NamedPose> poses;

  /// True if a weight is not 0.
  bool mixes() const;
  friend bool operator==(const PoseLibrary& a, const PoseLibrary& b) { return a.poses == b.poses; }
};

/// The source of the shown pose. A later edit of the pose does not change this value: see source_of().
struct PoseSource {
  enum class Kind {
    edited,  ///< edits of the cage, the probes or the shape
    frame,   ///< the keys of the timeline, at the current frame
    mix,     ///< `base` plus the weighted named poses; linearly if Timeline::linear, otherwise in log space
    pins,    ///< pin posing
    rest     ///< cage editing, which shows the cage at rest
  };
  Kind kind = Kind::edited;
  SharedPose pose{};                 ///< the pose that the source has computed; null for `edited`
  SharedPose base{};                 ///< of a mix or frame: the pose without the weights; null if unknown
  bool on_keys = false;              ///< of a mix: the base is the pose of the keys without the weights
  bool keyed = false;                ///< the keys give this pose at the current frame, too
  std::optional<pose::Pose> kept{};  ///< during cage editing, the cage's pose, which is not shown
};

/// A term of blended_probes(): the poses of all probes, and their factor. Missing probes are at rest.
struct ProbeTerm {
  const std::vector<pose::ProbePose>* poses;
  double factor;
};
std::vector<pose::ProbePose> blended_probes(std::span<const ProbeTerm> terms);

/// True if the pose is in the ranges of document/range.h and no coordinate is larger than `farthest`.
bool in_range(const WholePose& pose, double farthest = most_drawn);
/// True if the positions and the whole turns are equal.
bool same_pose(const pose::Pose& a, const pose::Pose& b);
/// True if cage, shape and probes are equal. Missing probes are at rest.
bool same_pose(const WholePose& a, const WholePose& b);

/// A loaded or generated surface.
struct OpenedSurface {
  std::filesystem::path path;  ///< empty if the surface does not come from a file
  std::string format;
  std::shared_ptr<const mesh::Surface> surface;
  std::shared_ptr<const formats::Attributes> attributes;  ///< null if the file has no attributes
  std::shared_ptr<const mesh::Splats> splats;             ///< null if the file is not a capture
  std::shared_ptr<const formats::Original> original;  ///< null if the file cannot be written again unchanged
  mesh::Summary summary;
  mesh::Bounds bounds;  ///< the bounding box of the vertices that polygons use
  std::vector<std::string> warnings;
  std::uint64_t content = 0;  ///< the value of mesh::content_key(); 0 if not computed
  std::string made;           ///< describes a surface without a file, such as "cage.obj, edited"
};

/// Returns the file name or, without a file, the description.
inline std::string name_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.filename().string();
}

/// Returns the path or, without a file, the description.
inline std::string place_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.string();
}

OpenedSurface generated_surface(mesh::Surface surface, std::string made);

/// Copies of a state share surfaces, named poses, keys and masks. Only pose and selection are duplicated.
struct DocumentState {
  std::shared_ptr<const pose::Cage> cage;  ///< null without a cage
  OpenedSurface cage_file;                 ///< its surface is null without a cage
  pose::Pose pose;
  SharedShape shape;  ///< the model's shape before cage and probes act; null at rest
  PoseSource source;
  pose::Deformer deformer = pose::default_deformer();
  weights::Mask mask;  ///< one value per model vertex; if null, every vertex follows the cage
  pose::Probes probes;
  Selection selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame = 1;  ///< the current frame
};

}  // namespace viete::document
