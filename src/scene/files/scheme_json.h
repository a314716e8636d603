// A scheme as keys of a session.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "deform/scheme.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// The keys that session.h lists from "weights" to "hold".
nlohmann::ordered_json scheme_json(const deform::Scheme& scheme);

/// Weights and blend by their own keys, or all by the one word that older programs know. What is
/// damaged costs its own part, and a warning says what is taken instead.
deform::Scheme scheme_of(const JsonReader& json, std::vector<std::string>& warnings);

}  // namespace viete::scene
