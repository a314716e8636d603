// The cost of binding a model to a cage, known before binding starts.
#pragma once

#include <cstddef>
#include <string>

#include "deform/binding.h"
#include "scene/document/document.h"

namespace viete::scene {

struct BindingPlan {
  std::size_t vertices = 0, handles = 0;  ///< model vertices; cage faces or vertices
  std::size_t bytes = 0;
  deform::Elements elements = deform::Elements::face;
};

/// For the open model and cage; both are required.
BindingPlan binding_plan(const Document& document, const deform::Weighting& weighting);

std::string text(const BindingPlan& plan);

}  // namespace viete::scene
