// A model bound to a cage: what a deformer is made of.
#pragma once

#include <memory>

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

  /// True if its stitching holds the model as this scheme says.
  bool stitches(const deform::Scheme& scheme) const {
    return stitching && stitching->settings == deform::settings_of(scheme);
  }
  /// True if it binds the document's model to the document's cage, by whatever weights.
  bool binds(const scene::Document& document) const {
    return binding && model == document.model.surface && cage == document.cage;
  }
};

/// Binds for the document's frames: for the fused engine, for the staged one too where the method needs it,
/// and for the stitched one where the scheme does. Shares what fits of `known`. Uses a pool of its own for as
/// long as it takes. Throws base::Error when it does not fit into memory, and base::Cancelled. Thread-safe.
Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           const deform::Scheme& scheme, sym3::Method method, const Bound& known, base::Progress& progress);

}  // namespace viete::app
