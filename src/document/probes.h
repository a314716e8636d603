// Probes of a document: adding, moving and removing them. Each change is an undoable edit.
#pragma once

#include "document/brush.h"
#include "document/document.h"

namespace viete::document {

/// A limit for speed.
inline constexpr std::size_t most_probes = 256;

/// Adds and selects a probe with radii of a fifth of the model's diagonal. `at` is a point on the drawn
/// model; the probe's rest place is the corresponding rest point. False if there are most_probes.
bool add_probe(Document& document, const PosedModel& posed, const mesh::Point& at);

/// Adds and selects a pin at the vertex drawn nearest to `at`; if that vertex has a pin already, selects it.
/// False if there are most_probes.
bool add_pin(Document& document, const PosedModel& posed, const mesh::Point& at);
bool has_pins(const Document& document);
/// Sets Pin::pulls of the selected pins.
void set_pulls(Document& document, bool pulls);

/// Change the selected probes, which must exist; locked ones change only by set_locked().
void remove_probes(Document& document);
void rest_probes(Document& document);  ///< resets their motion
/// True if an unlocked probe is selected.
bool has_free_probes(const Document& document);
/// The axis (0 x, 1 y, 2 z) whose middle plane is the model's best mirror plane.
int symmetry_axis(const Document& document);
/// Adds copies mirrored across the model's middle plane of this axis and selects them. False if there would
/// be more than most_probes.
bool mirror_probes(Document& document, int axis);
void set_locked(Document& document, bool locked);

/// One part of a probe's motion, with its falloff.
using Part = deform::Influence deform::Probe::*;
/// Sets the falloff of all selected unlocked probes. Consecutive changes of the radius for the same part and
/// probes are one edit.
void set_falloff(Document& document, Part part, deform::Falloff falloff);
void set_radius(Document& document, Part part, double radius);
void set_mix(Document& document, deform::ProbeMix mix);

/// The user's range of radii, in the file's unit.
double least_probe_radius(const Document& document);
double largest_probe_radius(const Document& document);

}  // namespace viete::document
