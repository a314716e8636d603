// Document: model, cage, pose, selection, settings. Records and undoes edits. Revisions show changed parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "document/camera.h"
#include "document/document_state.h"
#include "document/files_in_use.h"
#include "document/history.h"
#include "document/selection.h"
#include "document/space.h"
#include "mesh/summary.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "pose/deformer.h"
#include "pose/probe.h"
#include "sym3/exp.h"
#include "sym3/rotation.h"
#include "weights/binding.h"

namespace viete::document {

using mesh::Summary;
using pose::Amounts, pose::Blend, pose::Holding, pose::most_iterations, pose::number, pose::Deformer,
    pose::text_of_percent, pose::Weighting;
using pose::chosen, pose::complete, pose::linear_part, pose::only, pose::preset_of;
using pose::Falloff, pose::Influence, pose::Probe, pose::ProbePose;

/// A counter of changes. Code stores it with computed data, to see later whether the data is up to date.
using Revision = unsigned long;

struct Revisions {
  Revision surfaces = 0;  ///< changes when a model or a cage is opened
  Revision cage = 0;      ///< changes when an edit replaces the cage
  Revision weights = 0;   ///< changes with the weights and their radius
  Revision pose = 0;      ///< changes with the cage's pose, the probes and the model's shape
  Revision method = 0;    ///< changes with the blend, its settings and Document::method
  Revision whole = 0;     ///< changes when the timeline, the pose list or undo sets a complete pose

  friend bool operator==(const Revisions&, const Revisions&) = default;
};

/// A probe after the cage moved it.
struct Carried {
  mesh::Point place;  ///< the new position of the probe
  sym3::Mat3<double> map{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// Only edits change a document: each setter increases the revision of what it changes. record_edit() makes
/// an edit undoable. The state is what undo restores.
class Document {
public:
  Document() = default;
  explicit Document(OpenedSurface model);

  const DocumentState& state() const { return state_; }
  const std::shared_ptr<const pose::Cage>& cage() const { return state_.cage; }
  const OpenedSurface& cage_file() const { return state_.cage_file; }
  const pose::Pose& pose() const { return state_.pose; }
  const SharedShape& shape() const { return state_.shape; }
  /// See source_of().
  const PoseSource& source() const { return state_.source; }
  const std::optional<pose::Pose>& kept_pose() const { return state_.source.kept; }
  const pose::Deformer& deformer() const { return state_.deformer; }
  const weights::Mask& mask() const { return state_.mask; }
  const pose::Probes& probes() const { return state_.probes; }
  const Selection& selection() const { return state_.selection; }
  const CageGroups& groups() const { return state_.groups; }
  const PoseLibrary& library() const { return state_.library; }
  const Timeline& timeline() const { return state_.timeline; }
  double frame() const { return state_.frame; }

  const OpenedSurface& model() const { return opened_.model; }
  /// A possible cage; see cage_beside() in document/cage_making.h.
  const std::filesystem::path& cage_beside() const { return opened_.cage_beside; }
  /// Files of poses, keys and replaced cages.
  const std::vector<FileInUse>& also_read() const { return opened_.also_read; }
  sym3::Method method() const { return opened_.method; }
  const Space& space() const { return opened_.space; }
  const History& history() const { return history_; }
  const Revisions& revisions() const { return revisions_; }
  /// One per probe, for the last drawn picture; missing probes are at rest.
  const std::vector<Carried>& carried() const { return carried_; }

  bool has_cage() const { return state_.cage != nullptr; }
  /// False for captures and point sets, and without a model.
  bool has_faces() const { return model().surface && !model().surface->triangles.empty(); }
  bool is_movable() const { return has_cage() || !probes().empty() || has_shapes(); }
  /// True if the model, a pose or a key has a shape.
  bool has_shapes() const;
  /// A copy for background work. The history can be large, so the copy has none.
  Document without_history() const;

  /// Marks everything as changed. Call this after this document replaced the open document `other`.
  void mark_replacing(const Document& other);

  /// Give write access. Each call increases the revision.
  pose::Pose& changed_pose() {
    ++revisions_.pose;
    return state_.pose;
  }
  pose::Probes& changed_probes() {
    ++revisions_.pose;
    return state_.probes;
  }
  /// Give write access to what no revision counts.
  PoseSource& changed_source() { return state_.source; }
  Selection& changed_selection() { return state_.selection; }
  CageGroups& changed_groups() { return state_.groups; }
  PoseLibrary& changed_library() { return state_.library; }
  Timeline& changed_timeline() { return state_.timeline; }
  History& changed_history() { return history_; }
  std::vector<FileInUse>& changed_also_read() { return opened_.also_read; }

  void put_frame(double frame) { state_.frame = frame; }
  void put_mask(weights::Mask mask) { state_.mask = std::move(mask); }
  /// Sets the shape from the timeline, the pose list or undo. Null is the rest shape.
  void put_shape(SharedShape other) {
    state_.shape = std::move(other);
    ++revisions_.pose;
    ++revisions_.whole;
  }
  /// Sets the shape from pin posing.
  void put_posed_shape(SharedShape other) {
    state_.shape = std::move(other);
    ++revisions_.pose;
  }
  /// Replaces the model. The cage stays.
  void put_model(OpenedSurface model);
  /// Replaces the cage and its pose. Clears selected cage elements, hidden vertices and named sets.
  void replace_cage(OpenedSurface file, std::shared_ptr<const pose::Cage> by, pose::Pose posed);
  /// Set the file of the cage or the model after it was saved.
  void put_saved_cage(const std::filesystem::path& file);
  void put_saved_model(const std::filesystem::path& file) { opened_.model.path = file; }
  void put_cage_beside(std::filesystem::path file) { opened_.cage_beside = std::move(file); }
  /// Change a setting without recording an edit.
  void put_deformer(const pose::Deformer& other);
  void put_method(sym3::Method other);
  void restore(DocumentState&& state);

  /// The frame reports what it has drawn: the whole turns of the pose, and the places of probes.
  void put_drawn_turns(std::vector<mesh::Vec3> turns) { state_.pose.turns = std::move(turns); }
  void put_carried(std::vector<Carried> carried) { carried_ = std::move(carried); }

private:
  // Undo does not change these members.
  struct Opened {
    OpenedSurface model;
    std::filesystem::path cage_beside;
    std::vector<FileInUse> also_read;
    sym3::Method method = sym3::Method::fast;
    Space space;
  };

  DocumentState state_;
  Opened opened_;
  History history_;
  std::vector<Carried> carried_;
  Revisions revisions_;
};

/// Reads and summarizes a surface. `progress` may be null. Throws base::Error and base::Cancelled.
OpenedSurface open_surface(const std::filesystem::path& path, base::Progress* progress = nullptr);

/// Throws base::Error if GPUs cannot draw the model, the cage or a pose with float numbers: if a size or a
/// coordinate is above 1e32, or a size is below 1e-32.
void check_drawable(const Document& document);
/// Throws base::Error if a size is above 1e60 or below 1e-60: the deformation would overflow or underflow.
/// Also for a capture; see formats::check_deformable().
void check_deformable(const Document& document);
/// Sets the cage at rest and clears the history. Throws base::Error or pose::FinError for invalid cages.
void set_cage(Document& document, OpenedSurface cage);

/// Reads a model and a cage into a new document. The path of the cage may be empty. Throws base::Error.
Document open_document(const std::filesystem::path& model, const std::filesystem::path& cage,
                       base::Progress* progress = nullptr);

/// The settings that were requested before a document is opened.
struct RequestedSettings : pose::AskedDeformer {
  std::optional<sym3::Method> method{};

  bool any() const { return method || AskedDeformer::any(); }
};
/// Applies the settings without recording an edit. pose::deformer_of() describes `chosen` and the errors.
void put_settings(Document& document, const RequestedSettings& asked, bool chosen = false);

/// True during cage editing (cage_editing.h). During cage editing, document.pose is the rest shape that the
/// user edits, and document.kept_pose() is the cage's pose.
inline bool is_editing_cage(const Document& document) {
  return document.kept_pose().has_value();
}

/// Returns the cage's pose, during cage editing too.
inline const pose::Pose& real_pose(const Document& document) {
  return document.kept_pose() ? *document.kept_pose() : document.pose();
}

/// Returns the position of a vertex in the model's shape.
mesh::Point shape_of_vertex(const Document& document, std::uint32_t vertex);
Carried carried_probe(const Document& document, std::size_t probe);
/// Returns the probe's current position. The cage and the probe's own pose have moved it.
mesh::Point probe_center(const Document& document, std::size_t probe);
std::vector<mesh::Point> probe_centers(const Document& document);
mesh::Point pinned_vertex(const Document& document, std::size_t probe);

/// Returns a message like "Binding 50,000 vertices to 148 triangles, 72 MB". Requires a cage.
std::string binding_plan(const Document& document, const pose::Weighting& weighting);

/// Returns the up axis of the file's format: Y for glTF, Z for STL (common for CAD and 3D printing). For
/// other formats, compares the bases on which the model stands with Y up and with Z up. Returns Z if the base
/// with Z up is much larger. Otherwise returns Y.
UpAxis guessed_up(const OpenedSurface& model);

// Records, cancels and undoes edits.

/// Records the current state for undo. Call this before each change of the document.
void record_edit(Document& document, const std::string& label, EditStep step = {});
/// Records one of the many small edits by a slider. If the last edit has an equal step and `merge` is true,
/// the edit becomes part of the last edit. Otherwise, it is a new edit.
void record_step(Document& document, const std::string& label, EditStep step, bool merge = true);

/// The state of a document before an action that the user can cancel.
struct EditMark {
  DocumentState state;
  unsigned long revision, recorded;  ///< see History
};
EditMark mark_of(const Document& document);
/// Restores the state and the history of the mark.
void take_back(Document& document, EditMark&& mark);

/// True if a cage vertex, a probe or the model's shape differs from the state `before`.
bool moved_since(const Document& document, const DocumentState& before);

/// Undoes the last edit. Requires History::can_undo().
void undo(Document& document);
/// Redoes the next edit. Requires History::can_redo().
void redo(Document& document);
/// Undoes or redoes edits until History::position() equals `edits`.
void go_to_edit(Document& document, std::size_t edits);

/// Records a change of the selection after it was made. `before` is the previous selection. If the selections
/// are equal or both are empty, does nothing.
void record_selection(Document& document, const Selection& before);

}  // namespace viete::document
