// How a model is moved, as far as someone asks for it before it is opened.
#pragma once

#include <optional>

#include "scene/document/document.h"

namespace viete::scene {

/// What is left open stays as the document has it, where that goes together with what is asked for.
struct AskedSettings {
  std::optional<sym3::Method> method{};
  std::optional<deform::Way> way{};  ///< all of it; what is asked for besides is changed in it
  deform::PartialChoice choice{};
  deform::AskedWeighting weighting{};
  std::optional<double> turn{}, stretch{};  ///< of deform::Amounts
  std::optional<int> iterations{};          ///< of stitching
  std::optional<double> pins{}, hold{};     ///< of deform::Holding

  bool any() const {
    return method || way || choice.any() || weighting.any() || turn || stretch || iterations || pins || hold;
  }
};

/// To a document that was just opened: no edit. Throws base::Error and changes nothing if the choices do not
/// go together, or a setting is asked for that weights do not have, or amounts or stitching where maps only
/// move.
///
/// A setting that the document's weights do not have chooses others that do, unless someone has chosen these:
/// by name here, or before (`chosen`), as in a session.
void put_settings(Document& document, const AskedSettings& asked, bool chosen = false);

}  // namespace viete::scene
