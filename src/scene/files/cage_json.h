// A cage that is in no file of its own, as a session holds it; see session.h.
#pragma once

#include "scene/document/opened_surface.h"
#include "scene/files/json_file.h"

namespace viete::scene {

nlohmann::ordered_json cage_json(const OpenedSurface& cage);
/// Throws base::Error naming file and key.
OpenedSurface made_cage_of(const JsonReader& json);

}  // namespace viete::scene
