// The cost of binding a model to a cage, known before binding starts.
#pragma once

#include <string>

#include "document/document.h"

namespace viete::document {

/// "Binding 50,000 vertices to 148 faces, 72 MB", for the open model and cage; both are required.
std::string binding_plan(const Document& document, const deform::Weighting& weighting);

}  // namespace viete::document
