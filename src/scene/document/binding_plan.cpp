#include "scene/document/binding_plan.h"

#include "base/text.h"
#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/tiled_binding.h"

namespace viete::scene {

std::string binding_plan(const Document& document, const deform::Weighting& weighting) {
  const std::size_t vertices = document.model.surface->positions.size();
  const std::size_t handles = deform::handle_count(*document.cage, weighting.elements);
  const std::size_t bytes = deform::binding_bytes(vertices, handles, deform::EngineKind::fused, weighting);
  return "Binding " + base::with_thousands(vertices) + " vertices to " + base::with_thousands(handles) + ' ' +
         std::string(deform::name(weighting.elements)) + ", " + base::memory_size(static_cast<double>(bytes));
}

}  // namespace viete::scene
