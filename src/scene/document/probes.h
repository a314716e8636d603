// Probes of a document: placed, moved by hand, and taken away again. Each change is an edit that can be
// undone.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/document/brush.h"
#include "scene/document/document.h"

namespace viete::scene {

/// More is slow, and nothing that a hand would place.
inline constexpr std::size_t most_probes = 256;

/// With radii of a fifth of the model's diagonal; it is selected. `at` is where the model is drawn: the probe
/// is placed where that is at rest. False if there are most_probes.
bool add_probe(Document& document, const PosedModel& posed, const mesh::Point& at);

/// A pin of the vertex that is drawn nearest to `at`, where the shape has it; it is selected. One that pins
/// it already is selected instead. False if there are most_probes.
bool add_pin(Document& document, const PosedModel& posed, const mesh::Point& at);
bool has_pins(const Document& document);
/// Of the selected pins.
void set_pulls(Document& document, bool pulls);

/// Of the selected probes, which the caller sees to; locked ones stay as they are but for set_locked().
void remove_probes(Document& document);
void rest_probes(Document& document);  ///< they have done nothing
/// Their places at rest are as far away as they have moved, and they have done nothing.
void replace_probes(Document& document);
/// True if a probe is selected that is not locked.
bool has_free_probes(const Document& document);
/// The axis of the file (0 x, 1 y, 2 z) across whose middle the model is most nearly its own mirror image.
int symmetry_axis(const Document& document);
/// Copies on the other side of the model's middle, across this axis of the file; these are selected. False if
/// there would be more than most_probes.
bool mirror_probes(Document& document, int axis);
void set_locked(Document& document, bool locked);

/// A part of a probe's motion, and what decides where it acts.
using Part = deform::Influence deform::Probe::*;
/// Of the selected probes that are not locked. Radii that are chosen one after the other are one edit, of the
/// same part and the same probes.
void set_falloff(Document& document, Part part, deform::Falloff falloff);
void set_radius(Document& document, Part part, double radius);
void set_mix(Document& document, deform::ProbeMix mix);

/// The range of radii that a person chooses from, in the file's unit.
double least_probe_radius(const Document& document);
double largest_probe_radius(const Document& document);

}  // namespace viete::scene
