// Estimates the size of a binding before binding starts.
#pragma once

#include <string>

#include "document/document.h"

namespace viete::document {

/// Returns a message like "Binding 50,000 vertices to 148 faces, 72 MB". Requires a cage.
std::string binding_plan(const Document& document, const deform::Weighting& weighting);

}  // namespace viete::document
