// How a model is moved, as far as someone asks for it before it is opened.
#pragma once

#include <optional>

#include "deform/asked_scheme.h"
#include "scene/document/document.h"

namespace viete::scene {

struct AskedSettings : deform::AskedScheme {
  std::optional<sym3::Method> method{};

  bool any() const { return method || AskedScheme::any(); }
};

/// To a document that was just opened: no edit. Throws what deform::scheme_of() throws, and changes nothing
/// then.
void put_settings(Document& document, const AskedSettings& asked, bool chosen = false);

}  // namespace viete::scene
