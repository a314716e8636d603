#include "deform/engine_for.h"

namespace viete::deform {

EngineKind engine_for(const Scheme& scheme, sym3::Method method, bool same_path) {
  if (scheme.stitched()) return EngineKind::stitched;
  const bool fuses = !scheme.exponential() || (method == sym3::Method::fast && !same_path);
  return fuses ? EngineKind::fused : EngineKind::staged;
}

}  // namespace viete::deform
