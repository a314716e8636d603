// The one home of state: model, cage, pose, selection and settings, with a revision of each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/probe.h"
#include "deform/scheme.h"
#include "mesh/summary.h"
#include "mesh/surface.h"
#include "scene/document/document_state.h"
#include "scene/document/files_in_use.h"
#include "scene/document/history.h"
#include "scene/document/selection.h"
#include "scene/document/space.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::scene {

using deform::all_blends, deform::all_ways, deform::all_weights, deform::chosen, deform::complete,
    deform::entry, deform::only, deform::way_of;
using deform::all_falloffs, deform::all_probe_mixes, deform::linear_part;
using deform::Amounts, deform::Blend, deform::Holding, deform::largest_amount, deform::largest_pin_radius,
    deform::most_iterations, deform::Scheme, deform::text_of_percent, deform::Weighting;
using deform::Falloff, deform::Influence, deform::Probe, deform::ProbePose;
using mesh::Summary;

/// Grows by one with each change; whoever derives something from a part remembers the number it was derived
/// from.
using Revision = unsigned long;

/// Of a document, which alone counts them.
struct Revisions {
  Revision surfaces = 0;  ///< another document: model or cage were opened
  Revision cage = 0;      ///< another cage around the same model, by an edit
  Revision weights = 0;   ///< weights or radius
  Revision pose = 0;      ///< positions of the cage, or its turns
  Revision method = 0;    ///< blend, or how exp is computed
  Revision whole = 0;     ///< the pose, as time, a pose of the list or undo has put it there: by no hand

  friend bool operator==(const Revisions&, const Revisions&) = default;
};

/// Where a probe's place is brought, and the map by which its own motion is seen there.
struct Carried {
  mesh::Point place;
  sym3::Mat3<double> map{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

struct Document : DocumentState {
  OpenedSurface model;
  std::filesystem::path cage_beside;  ///< a file that looks like a cage of the model, which has none
  std::vector<FileInUse> also_read;   ///< poses and keys that came into it, and cages that it had
  /// What the cage has done to the probes in the last frame; shorter where that is not known: there they are
  /// as at rest.
  std::vector<Carried> carried;
  History history;
  sym3::Method method = sym3::Method::fast;
  Space space;

  bool has_cage() const { return cage != nullptr; }
  /// Something moves the model, or may.
  bool is_movable() const { return has_cage() || !probes.empty() || has_shapes(); }
  /// The model has a shape, or poses or keys with shapes.
  bool has_shapes() const;

  const Revisions& revisions() const { return revisions_; }
  /// It is open now in place of the other one: all is another.
  void take_place_of(const Document& other);

  /// To be changed: what follows the pose is then made anew.
  deform::Pose& changed_pose() { return ++revisions_.pose, pose; }
  deform::Probes& changed_probes() { return ++revisions_.pose, probes; }
  /// Of the model, or null: as time, a pose of the list or undo has it.
  void put_shape(SharedShape other) { shape = std::move(other), ++revisions_.pose, ++revisions_.whole; }
  /// As pins ask for it.
  void put_posed_shape(SharedShape other) { shape = std::move(other), ++revisions_.pose; }
  /// Another cage around the same model, with its pose. What was selected of the old one is not.
  void replace_cage(OpenedSurface file, std::shared_ptr<const deform::Cage> by, deform::Pose posed);
  /// Settings, by no edit: pose and history are untouched.
  void put_scheme(const deform::Scheme& other);
  void put_method(sym3::Method other);
  /// All that edits change, as it was.
  void restore(DocumentState&& state);

private:
  Revisions revisions_;
};

/// Reads a surface and says what is in it. progress may be null. Throws base::Error and base::Cancelled.
OpenedSurface open_surface(const std::filesystem::path& path, base::Progress* progress = nullptr);

/// A new document of surfaces that were read. Throws base::Error if the cage is none.
Document document_of(OpenedSurface model);
/// Throws base::Error if the model, its cage or its pose is too large or too small for graphics cards, which
/// compute in float: larger or farther from 0 than 1e32, or smaller than 1e-32.
void check_drawable(const Document& document);
/// The same for deforming in double, up to 1e60 and down to 1e-60.
void check_deformable(const Document& document);
/// Fin of a cage: an odd number of triangles, three or more, at an edge.
struct FinError : base::Error {
  using base::Error::Error;
};
/// Treatment of fins: patches of faces that end in an edge of three or more, the smallest first, until no
/// edge has an odd number of them. What is left without them is in no file.
enum class Fins { refused, removed };
/// Throws base::Error if it is no cage, and FinError.
void set_cage(Document& document, OpenedSurface cage, Fins fins = Fins::refused);

/// Reads a model and, if the path is not empty, a cage, into a new document. Throws base::Error; the caller's
/// open document is untouched until it takes the new one.
Document open_document(const std::filesystem::path& model, const std::filesystem::path& cage,
                       base::Progress* progress = nullptr, Fins fins = Fins::refused);

/// What an edit may change, as it is now.
DocumentState state_of(const Document& document);

/// True while the cage itself is edited (cage_editing.h): the document's pose is the rest of the cage, and
/// the real one is kept beside it.
inline bool is_editing_cage(const Document& document) {
  return document.kept_pose.has_value();
}

/// The pose as files have it, in whatever mode.
inline const deform::Pose& real_pose(const Document& document) {
  return document.kept_pose ? *document.kept_pose : document.pose;
}

/// Where the model's shape has that vertex.
mesh::Point shape_of_vertex(const Document& document, std::uint32_t vertex);
Carried carried_probe(const Document& document, std::size_t probe);
/// Where a probe is now: carried by the cage, then moved by hand.
mesh::Point probe_center(const Document& document, std::size_t probe);
std::vector<mesh::Point> probe_centers(const Document& document);
/// Where the vertex of a pin is now.
mesh::Point pinned_vertex(const Document& document, std::size_t probe);

}  // namespace viete::scene
