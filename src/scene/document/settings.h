// Deformation settings requested before a model is opened.
#pragma once

#include <optional>

#include "deform/scheme.h"
#include "scene/document/document.h"

namespace viete::scene {

struct RequestedSettings : deform::AskedScheme {
  std::optional<sym3::Method> method{};

  bool any() const { return method || AskedScheme::any(); }
};

/// Applies the settings to a newly opened document; not an edit. Throws like deform::scheme_of(), without a
/// change.
void put_settings(Document& document, const RequestedSettings& asked, bool chosen = false);

}  // namespace viete::scene
