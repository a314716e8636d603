// Probes as a part of a session.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "deform/probe.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "mix": "added", "partial", "whole" or "softmax"; missing: "added";
/// "all": [{"place": [x, y, z],
///          "turn", "stretch", "move": {"falloff": a name of deform/probe.h, "radius"}, where it acts,
///          "locked": true, or missing,
///          "pin": "holds" or "pulls", and "vertex": of the model, which it brings to its place; or missing,
///          "turned": [x, y, z], rotation vector in radians,
///          "stretched": [xx, xy, xz, yy, yz, zz], log of the stretch,
///          "moved": [x, y, z]; these three: what it has done, each missing where it is 0}, ...]
nlohmann::ordered_json probes_json(const deform::Probes& probes);

/// Ranges are those of scene/document/range.h and most_probes. A probe that is damaged is left out, and a
/// warning says so.
deform::Probes probes_of(const JsonReader& json, std::vector<std::string>& warnings);

}  // namespace viete::scene
