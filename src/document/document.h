// The application's data: model, cage, pose, selection and settings, with a revision of each.
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
#include "document/document_state.h"
#include "document/files_in_use.h"
#include "document/history.h"
#include "document/selection.h"
#include "document/space.h"
#include "mesh/summary.h"
#include "mesh/surface.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"

namespace viete::document {

using deform::all_blends, deform::all_ways, deform::all_weights, deform::chosen, deform::complete,
    deform::entry, deform::only, deform::way_of;
using deform::all_falloffs, deform::all_probe_mixes, deform::linear_part;
using deform::Amounts, deform::Blend, deform::Holding, deform::most_iterations, deform::number,
    deform::Scheme, deform::text_of_percent, deform::Weighting;
using deform::Falloff, deform::Influence, deform::Probe, deform::ProbePose;
using mesh::Summary;

/// Increases with each change; data derived from a part stores the revision it was derived from.
using Revision = unsigned long;

/// Revisions of a document, incremented only by the document.
struct Revisions {
  Revision surfaces = 0;  ///< a different document: model or cage opened
  Revision cage = 0;      ///< a different cage around the same model, by an edit
  Revision weights = 0;   ///< weights or radius
  Revision pose = 0;      ///< positions or turns of the cage
  Revision method = 0;    ///< blend, or the method of computing exp
  Revision whole = 0;     ///< a complete pose, set by the timeline, the pose list or undo, not by a drag

  friend bool operator==(const Revisions&, const Revisions&) = default;
};

/// A probe's carried position, and the linear map of the cage's motion there.
struct Carried {
  mesh::Point place;
  sym3::Mat3<double> map{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

struct Document : DocumentState {
  OpenedSurface model;
  std::filesystem::path cage_beside;  ///< a file that looks like a cage of the model, which has no cage
  std::vector<FileInUse> also_read;   ///< files of poses, keys and replaced cages
  /// The cage's effect on the probes in the last frame; probes beyond its size count as at rest.
  std::vector<Carried> carried;
  History history;
  sym3::Method method = sym3::Method::fast;
  Space space;

  bool has_cage() const { return cage != nullptr; }
  /// True if anything can move the model.
  bool is_movable() const { return has_cage() || !probes.empty() || has_shapes(); }
  /// True if the model, a pose or a key has a shape.
  bool has_shapes() const;

  const Revisions& revisions() const { return revisions_; }
  /// Marks everything as changed, after replacing an open document.
  void mark_replacing(const Document& other);

  /// Mutable access; increases the revision, so that derived data is updated.
  deform::Pose& changed_pose() { return ++revisions_.pose, pose; }
  deform::Probes& changed_probes() { return ++revisions_.pose, probes; }
  /// Sets the shape (null: none) from the timeline, the pose list or undo.
  void put_shape(SharedShape other) { shape = std::move(other), ++revisions_.pose, ++revisions_.whole; }
  /// Sets the shape from pin posing.
  void put_posed_shape(SharedShape other) { shape = std::move(other), ++revisions_.pose; }
  /// Replaces the cage of the same model, with its pose. Clears the selection of the old cage.
  void replace_cage(OpenedSurface file, std::shared_ptr<const deform::Cage> by, deform::Pose posed);
  /// Change settings without recording an edit: pose and history are unchanged.
  void put_scheme(const deform::Scheme& other);
  void put_method(sym3::Method other);
  /// Restores everything that edits change.
  void restore(DocumentState&& state);

private:
  Revisions revisions_;
};

/// Reads and summarizes a surface. progress may be null. Throws base::Error and base::Cancelled.
OpenedSurface open_surface(const std::filesystem::path& path, base::Progress* progress = nullptr);

/// A new document of loaded surfaces. Throws base::Error if the cage is not valid.
Document document_of(OpenedSurface model);
/// Throws base::Error if the model, its cage or its pose exceeds the float range of GPUs: larger or farther
/// from 0 than 1e32, or smaller than 1e-32.
void check_drawable(const Document& document);
/// As above for deforming in double: up to 1e60 and down to 1e-60.
void check_deformable(const Document& document);
/// Throws base::Error if the cage is not valid, or deform::FinError.
void set_cage(Document& document, OpenedSurface cage);

/// Reads a model and, unless the path is empty, a cage into a new document. Throws base::Error; the caller's
/// open document is not affected.
Document open_document(const std::filesystem::path& model, const std::filesystem::path& cage,
                       base::Progress* progress = nullptr);

/// Settings requested before a document is opened.
struct RequestedSettings : deform::AskedScheme {
  std::optional<sym3::Method> method{};

  bool any() const { return method || AskedScheme::any(); }
};
/// Applies the settings to a newly opened document; not an edit. Throws like deform::scheme_of(), without a
/// change.
void put_settings(Document& document, const RequestedSettings& asked, bool chosen = false);

/// The current state of everything that edits can change.
DocumentState state_of(const Document& document);

/// True while the cage itself is edited (cage_editing.h): document.pose is the rest shape of the cage, and
/// document.kept_pose the real pose.
inline bool is_editing_cage(const Document& document) {
  return document.kept_pose.has_value();
}

/// The pose as saved to files, in any mode.
inline const deform::Pose& real_pose(const Document& document) {
  return document.kept_pose ? *document.kept_pose : document.pose;
}

/// The position of a vertex in the model's shape.
mesh::Point shape_of_vertex(const Document& document, std::uint32_t vertex);
Carried carried_probe(const Document& document, std::size_t probe);
/// A probe's current position: carried by the cage, then moved by its own pose.
mesh::Point probe_center(const Document& document, std::size_t probe);
std::vector<mesh::Point> probe_centers(const Document& document);
/// The current position of a pin's vertex.
mesh::Point pinned_vertex(const Document& document, std::size_t probe);

}  // namespace viete::document
