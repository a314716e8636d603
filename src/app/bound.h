// A model bound to a cage: what a deformer is made of.
#pragma once

#include <memory>
#include <string>

#include "app/saved_bindings.h"
#include "base/progress.h"
#include "deform/binding.h"
#include "deform/stitching.h"
#include "scene/document/document.h"

namespace viete::app {

struct Bound {
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const deform::Cage> cage;
  std::shared_ptr<const deform::Binding> binding;
  std::shared_ptr<const deform::Stitching> stitching{};  ///< null until a stitched scheme asked for it
  double seconds = 0;     ///< that its tiles took to bind; 0 if they were there
  std::string problem{};  ///< of a saved binding that was named and could not be used

  /// True if its stitching holds the model as this scheme says.
  bool stitches(const deform::Scheme& scheme) const {
    return stitching && stitching->settings == deform::settings_of(scheme);
  }
  /// True if it binds the document's model to the document's cage, by whatever weights.
  bool binds(const scene::Document& document) const {
    return binding && model == document.model.surface && cage == document.cage;
  }
};

/// For the document's frames: the fused one, with a method that it does not run the staged one too, and the
/// stitched one where the scheme is. Of
/// `known`, if it binds the same by the same weights, what fits is shared, and what is saved is
/// read. Uses a pool of its own for as long as it takes. Throws base::Error when it does not fit into memory,
/// and base::Cancelled. Thread-safe.
Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           const deform::Scheme& scheme, sym3::Method method, const Bound& known, const SavedBindings& saved,
           base::Progress& progress);

}  // namespace viete::app
