#include "scene/document/binding_plan.h"

#include "base/text.h"
#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/cage_state.h"

namespace viete::scene {

BindingPlan binding_plan(const Document& document, const deform::Weighting& weighting) {
  BindingPlan plan;
  plan.vertices = document.model.surface->positions.size();
  plan.handles = deform::handle_count(*document.cage, weighting.elements);
  plan.bytes = deform::binding_bytes(plan.vertices, plan.handles, deform::EngineKind::fused, weighting);
  plan.elements = weighting.elements;
  return plan;
}

std::string text(const BindingPlan& plan) {
  return "Binding " + base::with_thousands(plan.vertices) + " vertices to " +
         base::with_thousands(plan.handles) + ' ' + std::string(deform::name(plan.elements)) + ", " +
         base::memory_size(static_cast<double>(plan.bytes));
}

}  // namespace viete::scene
