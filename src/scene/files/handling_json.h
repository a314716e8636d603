// How the hand moves, as a part of a session.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/document/handling.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "pivot", "axes", "mirror", "curve", "distance": words of scene/document/handling.h; "point": [x, y, z] in
/// the file's coordinates; "soft": true or missing; "radius": percent of the model's diagonal. What is as in
/// a new window is missing.
nlohmann::ordered_json handling_json(const Handling& handling);

/// What is damaged stays as in a new window, with a warning.
Handling handling_of(const JsonReader& json, std::vector<std::string>& warnings);

}  // namespace viete::scene
