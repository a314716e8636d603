// The maps of any elements.
#pragma once

#include <memory>

#include "deform/element_maps.h"
#include "deform/scheme.h"

namespace viete::deform {

/// Of elements that have affine maps.
std::unique_ptr<const ElementMaps> element_maps(const Cage& cage, Elements elements, bool as_before = false);

}  // namespace viete::deform
