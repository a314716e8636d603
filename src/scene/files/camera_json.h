// The camera as a part of a session.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "scene/document/camera.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "target" [x, y, z] and "distance" in view units (model diagonal = 2), "yaw" and "pitch" in radians,
/// "orthographic", "up": "y" (the default) or "z".
nlohmann::ordered_json camera_json(const CameraPose& camera);

/// Ranges: scene/document/range.h. With `turns` the yaw keeps its whole turns, up to a thousand.
CameraPose camera_of(const JsonReader& json, bool turns = false);

/// 0.3f as 0.3 instead of 0.30000001192092896, if that reads back as the same float.
double tidy(float value);

}  // namespace viete::scene
