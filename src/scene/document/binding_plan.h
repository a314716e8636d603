// What binding a model to a cage takes, known before it is begun.
#pragma once

#include <cstddef>
#include <string>

#include "deform/binding.h"
#include "scene/document/document.h"

namespace viete::scene {

struct BindingPlan {
  std::size_t vertices = 0, handles = 0;  ///< of the model; faces or vertices of the cage
  std::size_t bytes = 0;
  deform::Elements elements = deform::Elements::face;
};

/// Of an open model and cage. Requires both.
BindingPlan binding_plan(const Document& document, const deform::Weighting& weighting);

/// "Binding 50,000 vertices to 148 faces, 72 MB".
std::string text(const BindingPlan& plan);

}  // namespace viete::scene
