#include "scene/binding_plan.h"

#include "base/quantity.h"

namespace viete::scene {

BindingPlan binding_plan(const Document& document, deform::Coordinates coordinates) {
  BindingPlan plan;
  const bool faces = coordinates == deform::Coordinates::face;
  plan.vertices = document.model.surface->positions.size();
  plan.handles = faces ? document.cage->element_count() : document.cage->surface.positions.size();
  plan.bytes = deform::binding_bytes(plan.vertices, plan.handles, deform::Path::fused, coordinates);
  plan.coordinates = coordinates;
  return plan;
}

std::string text(const BindingPlan& plan) {
  const bool faces = plan.coordinates == deform::Coordinates::face;
  return "Binding " + base::with_thousands(plan.vertices) + " vertices to " +
         base::with_thousands(plan.handles) + (faces ? " faces, " : " vertices, ") +
         base::memory_size(static_cast<double>(plan.bytes));
}

}  // namespace viete::scene
