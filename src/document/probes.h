// Edits of probes and pins. Each change is undoable.
#pragma once

#include "document/brush.h"
#include "document/document.h"

namespace viete::document {

inline constexpr std::size_t most_probes = 256;

/// Adds and selects a probe at the rest position of the point `at` on the displayed model. The radii of the
/// probe are a fifth of the model's diagonal. If the document already has most_probes, returns false.
bool add_probe(Document& document, const PosedModel& posed, const mesh::Point& at);

/// Adds and selects a pin at the displayed vertex nearest to `at`. If the vertex already has a pin, selects
/// this pin. If the document already has most_probes, returns false.
bool add_pin(Document& document, const PosedModel& posed, const mesh::Point& at);
bool has_pins(const Document& document);
/// Sets Pin::pulls of the selected pins.
void set_pulls(Document& document, bool pulls);

// The functions from here to set_radius() act on the selected probes. Only set_locked() and mirror_probes()
// also act on locked probes.

void remove_probes(Document& document);
/// Resets the probes' own poses to rest. The probes still follow the cage.
void rest_probes(Document& document);
/// True if an unlocked probe is selected.
bool has_free_probes(const Document& document);
/// Adds mirrored copies and selects them. The mirror plane is perpendicular to the axis, in the middle of the
/// model. If the document would have more than most_probes, changes nothing and returns false.
bool mirror_probes(Document& document, int axis);
void set_locked(Document& document, bool locked);

using Part = pose::Influence pose::Probe::*;  ///< the rotation, the stretch or the translation
void set_falloff(Document& document, Part part, pose::Falloff falloff);
/// Sets the radius of a part. Consecutive changes for one part and selection form one edit.
void set_radius(Document& document, Part part, double radius);

void set_mix(Document& document, pose::ProbeMix mix);

/// Returns the axis (0 x, 1 y, 2 z) across which the model is most symmetric.
int symmetry_axis(const Document& document);

/// Return the smallest and the largest allowed radius, in the file's units.
double least_probe_radius(const Document& document);
double largest_probe_radius(const Document& document);

}  // namespace viete::document
