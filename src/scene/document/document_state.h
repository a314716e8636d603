// The state that edits change of a document: held whole by the document, its history, and what is known to be
// saved. Surfaces, and poses with names.
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
#include "mesh/formats/attributes.h"
#include "mesh/formats/original.h"
#include "mesh/summary.h"
#include "mesh/surface.h"
#include "scene/document/range.h"
#include "scene/document/selection.h"
#include "scene/document/timeline.h"

namespace viete::scene {

struct NamedPose {
  std::string name;
  SharedPose pose;
  double weight = 0;                  ///< in what is shown: 0 none of it, 1 all, also beyond and below
  std::vector<std::uint32_t> part{};  ///< vertices of the cage that it moves; empty: all

  friend bool operator==(const NamedPose&, const NamedPose&) = default;
};

struct NamedShape {
  std::string name;
  SharedShape shape;  ///< never null
};

/// In an order of the user's. The document's pose is `unmixed` and the weighted poses upon it, added in log
/// space or, as the timeline, in straight lines; a hand that moves the cage moves `unmixed` with it.
struct PoseLibrary {
  static constexpr double least_weight = -2, largest_weight = 3;
  static constexpr std::size_t most_poses = 1000, longest_name = 200;

  std::vector<NamedPose> poses;
  SharedPose unmixed{};  ///< what is there without the mix; null while nothing is mixed
  SharedPose mixed{};    ///< the pose with it: the document's, until something else has changed that

  bool mixes() const;
  friend bool operator==(const PoseLibrary& a, const PoseLibrary& b) { return a.poses == b.poses; }
};

/// A blend of probes' poses by their logs; those that are missing are at rest.
struct ProbeTerm {
  const std::vector<deform::ProbePose>* poses;
  double factor;
};
std::vector<deform::ProbePose> blended_probes(std::span<const ProbeTerm> terms);

/// True if it can be drawn, as far as such coordinates can, and kept in a session: the ranges of
/// scene/document/range.h. Sums of logs may leave them.
bool in_range(const WholePose& pose, double farthest = most_drawn);
/// The same places, to the last bit, and the same whole turns; of what each part is turned by, only these
/// tell poses apart.
bool same_pose(const deform::Pose& a, const deform::Pose& b);
/// Likewise with the same shape and probes, of which those that are missing are at rest.
bool same_pose(const WholePose& a, const WholePose& b);

/// A surface that was opened or made, and what was found in it.
struct OpenedSurface {
  std::filesystem::path path;  ///< empty: it is in no file as it is
  std::string format;
  std::shared_ptr<const mesh::Surface> surface;
  std::shared_ptr<const mesh::Attributes> attributes;  ///< null: none
  std::shared_ptr<const mesh::Original> original;      ///< null: it cannot be written again as it was
  mesh::Summary summary;
  mesh::Bounds bounds;  ///< of the vertices that a polygon uses
  std::vector<std::string> warnings;
  std::uint64_t content = 0;  ///< mesh::content_key(); 0: not known
  std::string made;           ///< of one that is in no file: what it is, "made here", "cage.obj, edited"
};

/// For people: of its file, or what was made.
inline std::string name_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.filename().string();
}

/// The same with the file's folder.
inline std::string place_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.string();
}

/// One that is in no file.
OpenedSurface made_surface(mesh::Surface surface, std::string made);

/// A copy costs the pose and what is selected: surfaces, poses with names, keys and masks are shared.
struct DocumentState {
  std::shared_ptr<const deform::Cage> cage;  ///< null when there is no cage
  OpenedSurface cage_file;                   ///< surface is null when there is no cage
  deform::Pose pose;
  SharedShape shape;  ///< of the model, which cage and probes act upon; null: at rest
  std::optional<deform::Pose>
      kept_pose;  ///< the real one while the cage itself is edited, see cage_editing.h
  deform::Scheme scheme = deform::default_scheme();
  deform::Mask mask;  ///< painted, of the model's vertices; null: every one follows the cage
  deform::Probes probes;
  Selection selection;
  CageGroups groups;
  PoseLibrary library;
  Timeline timeline;
  double frame = 1;  ///< of the timeline: where it is now
};

}  // namespace viete::scene
