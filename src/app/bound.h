// A model bound to a cage: what a deformer is made of.
#pragma once

#include <memory>

#include "base/progress.h"
#include "deform/binding.h"
#include "scene/document.h"

namespace viete::app {

struct Bound {
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const deform::Cage> cage;
  std::shared_ptr<const deform::Binding> binding;

  /// True if it binds the document's model to the document's cage, by whatever coordinates.
  bool binds(const scene::Document& document) const {
    return binding && model == document.model.surface && cage == document.cage;
  }
};

/// Uses a pool of its own for as long as it takes. Throws base::Error when it does not fit into memory, and
/// base::Cancelled. Thread-safe.
Bound bind(std::shared_ptr<const mesh::Surface> model, std::shared_ptr<const deform::Cage> cage,
           deform::Coordinates coordinates, base::Progress& progress);

}  // namespace viete::app
