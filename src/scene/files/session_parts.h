// JSON of parts of a session: transform settings, probes, and the deformer's scheme.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "deform/probe.h"
#include "deform/scheme.h"
#include "scene/document/camera.h"
#include "scene/document/handling.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "pivot", "axes", "mirror", "curve", "distance": words of scene/document/handling.h; "point": [x, y, z] in
/// file coordinates; "soft": true or missing; "radius": percent of the model's diagonal. Defaults are
/// omitted.
nlohmann::ordered_json handling_json(const Handling& handling);

/// Damaged values keep their default, with a warning.
Handling handling_of(const JsonReader& json, std::vector<std::string>& warnings);

/// "mix": "added", "partial", "whole" or "softmax"; missing: "added";
/// "all": [{"place": [x, y, z],
///          "turn", "stretch", "move": {"falloff": a name of deform/probe.h, "radius"}, its influence,
///          "locked": true, or missing,
///          "pin": "holds" or "pulls", and "vertex": the pinned vertex of the model; or missing,
///          "turned": [x, y, z], rotation vector in radians,
///          "stretched": [xx, xy, xz, yy, yz, zz], log of the stretch,
///          "moved": [x, y, z]; these three: its motion, missing where 0}, ...]
nlohmann::ordered_json probes_json(const deform::Probes& probes);

/// Ranges: scene/document/range.h and most_probes. A damaged probe is skipped with a warning.
deform::Probes probes_of(const JsonReader& json, std::vector<std::string>& warnings);

/// The keys that session.h lists from "weights" to "hold".
nlohmann::ordered_json scheme_json(const deform::Scheme& scheme);

/// Weights and blend by their own keys, or all by the single word of older programs. Damaged values are
/// replaced, with a warning.
deform::Scheme scheme_of(const JsonReader& json, std::vector<std::string>& warnings);

}  // namespace viete::scene
