// Parts of a session: how the hand moves, probes, and the scheme.
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
/// the file's coordinates; "soft": true or missing; "radius": percent of the model's diagonal. What is as in
/// a new window is missing.
nlohmann::ordered_json handling_json(const Handling& handling);

/// What is damaged stays as in a new window, with a warning.
Handling handling_of(const JsonReader& json, std::vector<std::string>& warnings);

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

/// The keys that session.h lists from "weights" to "hold".
nlohmann::ordered_json scheme_json(const deform::Scheme& scheme);

/// Weights and blend by their own keys, or all by the one word that older programs know. What is
/// damaged costs its own part, and a warning says what is taken instead.
deform::Scheme scheme_of(const JsonReader& json, std::vector<std::string>& warnings);

}  // namespace viete::scene
