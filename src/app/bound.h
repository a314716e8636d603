// A model bound to a cage: the input of a deformer.
#pragma once

#include <memory>

#include "base/progress.h"
#include "deform/stitching.h"
#include "document/document.h"
#include "mesh/drawing.h"
#include "weights/binding.h"

namespace viete::app {

struct Bound {
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const pose::Cage> cage;
  std::shared_ptr<const weights::Binding> binding;
  std::shared_ptr<const deform::Stitching> stitching{};  ///< null until a stitched deformer is bound
  std::shared_ptr<const weights::Binding> draft{};       ///< binding of the model's draft, or null

  bool stitches(const pose::Deformer& deformer) const { return stitching && stitching->serves(deformer); }
  /// True if this is a binding of the document's model to the document's cage, with any weights.
  bool binds(const document::Document& document) const {
    return binding && model == document.model().surface && cage == document.cage();
  }
};

/// Binds the model for the engines of this deformer and method. Reuses parts of `known` with the same input.
/// Also binds the draft if there is one. Throws base::Error if memory is insufficient, base::Cancelled if
/// cancelled. Thread-safe.
Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const pose::Cage> cage,
           const pose::Deformer& deformer, sym3::Method method, const Bound& known, base::Progress& progress,
           const std::shared_ptr<const mesh::Draft>& draft = nullptr);

}  // namespace viete::app
