// Settings for dragging the selection: pivot, axes, mirror, and soft selection.
#pragma once

#include <optional>

#include "base/choice.h"
#include "mesh/surface.h"

namespace viete::document {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

/// The center of rotations and scalings.
enum class Pivot { median, active, joint, point };

/// The axes of the gizmo. During a drag, the keys X, Y and Z also use these axes.
enum class Axes { world, view, selection };

enum class MirrorPlane { none, x, y, z, fit };

/// The falloff of soft selection.
enum class SoftCurve { smooth, sharp, linear, constant };

/// The distance that soft selection measures: along edges or in space.
enum class SoftDistance { edges, space };

std::span<const Choice> choices(Pivot);
std::span<const Choice> choices(Axes);
std::span<const Choice> choices(MirrorPlane);
std::span<const Choice> choices(SoftCurve);
std::span<const Choice> choices(SoftDistance);

struct SoftSelection {
  static constexpr double least_radius = 0.005, largest_radius = 2;

  bool on = false;
  double radius = 0.35;  ///< the distance at which the falloff reaches 0, relative to the model's diagonal
  SoftCurve curve = SoftCurve::smooth;
  SoftDistance distance = SoftDistance::edges;

  friend bool operator==(const SoftSelection&, const SoftSelection&) = default;
};

struct Handling {
  Pivot pivot = Pivot::median;
  std::optional<mesh::Point> point{};  ///< for Pivot::point, in file coordinates; nullopt means the median
  Axes axes = Axes::world;
  MirrorPlane mirror = MirrorPlane::none;
  SoftSelection soft{};
  double freedom = 0.5;  ///< for pins: 0 only blends poses of the list, 1 deforms as rigidly as possible

  friend bool operator==(const Handling&, const Handling&) = default;
};

}  // namespace viete::document
