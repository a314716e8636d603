// What edits change of a document: held whole by the document, its history, and what is known to be saved.
#pragma once

#include <memory>
#include <optional>

#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/probe.h"
#include "deform/ways.h"
#include "scene/document/opened_surface.h"
#include "scene/document/pose_library.h"
#include "scene/document/selection.h"

namespace viete::scene {

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
