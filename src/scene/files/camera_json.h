// Where one looks from, as a part of a session.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/document/camera.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "target" [x, y, z] and "distance" in view units (model diagonal = 2), "yaw" and "pitch" in radians,
/// "orthographic", "up": "y" (also if missing) or "z".
nlohmann::ordered_json camera_json(const CameraPose& camera);

/// Ranges are those of scene/document/range.h. With turns, the yaw keeps its whole turns, up to a thousand.
CameraPose camera_of(const JsonReader& json, bool turns = false);

/// 0.3f as 0.3, not as 0.30000001192092896, where that gives the same float back.
double tidy(float value);

}  // namespace viete::scene
