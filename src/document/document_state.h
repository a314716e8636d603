// The part of a document that edits change, stored by the document, by each history entry and as the saved
// state; with its surfaces and named poses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/probe.h"
#include "deform/scheme.h"
#include "document/range.h"
#include "document/selection.h"
#include "document/timeline.h"
#include "formats/attributes.h"
#include "formats/original.h"
#include "mesh/summary.h"
#include "mesh/surface.h"

namespace viete::document {

struct NamedPose {
  std::string name;
  SharedPose pose;
  double weight = 0;  ///< in the mix: 0 none, 1 full; may be negative or above 1

  friend bool operator==(const NamedPose&, const NamedPose&) = default;
};

struct NamedShape {
  std::string name;
  SharedShape shape;  ///< never null
};

/// In user-defined order. The document's pose is `unmixed` plus the weighted poses, added in log space or,
/// like the timeline, linearly; dragging the cage changes `unmixed` as well.
struct PoseLibrary {
  static constexpr double least_weight = -2, largest_weight = 3;
  static constexpr std::size_t most_poses = 1000, longest_name = 200;

  std::vector<NamedPose> poses;
  SharedPose unmixed{};  ///< the pose without the mix; null while nothing is mixed
  SharedPose mixed{};    ///< the pose with the mix: the document's pose until another edit changes that

  bool mixes() const;
  friend bool operator==(const PoseLibrary& a, const PoseLibrary& b) { return a.poses == b.poses; }
};

/// A term of a blend of probe poses by their logs; missing probes are at rest.
struct ProbeTerm {
  const std::vector<deform::ProbePose>* poses;
  double factor;
};
std::vector<deform::ProbePose> blended_probes(std::span<const ProbeTerm> terms);

/// True if the pose is within the ranges of scene/document/range.h, for drawing and for sessions. Sums of
/// logs may exceed them.
bool in_range(const WholePose& pose, double farthest = most_drawn);
/// Equal positions, bit for bit, and equal whole turns; the parts' other rotations follow from the positions.
bool same_pose(const deform::Pose& a, const deform::Pose& b);
/// As above, with equal shape and probes; missing probes are at rest.
bool same_pose(const WholePose& a, const WholePose& b);

/// A loaded or generated surface and its summary.
struct OpenedSurface {
  std::filesystem::path path;  ///< empty: not stored in any file
  std::string format;
  std::shared_ptr<const mesh::Surface> surface;
  std::shared_ptr<const formats::Attributes> attributes;  ///< null: none
  std::shared_ptr<const formats::Original> original;      ///< null: cannot be written back unchanged
  mesh::Summary summary;
  mesh::Bounds bounds;  ///< bounds of the vertices used by polygons
  std::vector<std::string> warnings;
  std::uint64_t content = 0;  ///< mesh::content_key(); 0: unknown
  std::string made;  ///< description of a surface that is in no file: "made here", "cage.obj, edited"
};

/// Display name: the file name, or the description.
inline std::string name_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.filename().string();
}

/// As name_of(), with the file's folder.
inline std::string place_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.string();
}

/// A surface that is in no file.
OpenedSurface generated_surface(mesh::Surface surface, std::string made);

/// Copying duplicates only pose and selection: surfaces, named poses, keys and masks are shared.
struct DocumentState {
  std::shared_ptr<const deform::Cage> cage;  ///< null when there is no cage
  OpenedSurface cage_file;                   ///< surface is null when there is no cage
  deform::Pose pose;
  SharedShape shape;  ///< the model's shape before cage and probes act; null: at rest
  std::optional<deform::Pose>
      kept_pose;  ///< the real pose while the cage itself is edited, see cage_editing.h
  deform::Scheme scheme = deform::default_scheme();
  deform::Mask mask;  ///< one value per model vertex; null: every vertex follows the cage
  deform::Probes probes;
  Selection selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame = 1;  ///< current frame of the timeline
};

}  // namespace viete::document
