// How the hand moves what is selected: about what, along which axes, on both sides of a mirror, and how much
// of what is near goes along.
#pragma once

#include <array>
#include <optional>

#include "base/choice.h"
#include "mesh/surface.h"

namespace viete::scene {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

/// About what the selection turns and scales.
enum class Pivot { median, active, individual, joint, point };

/// Along what handles and typed axes point.
enum class Axes { world, view, selection, active, mirror };

/// Across what both sides of the cage are moved.
enum class MirrorPlane { none, x, y, z, fit };

/// How the share of the motion falls from the selection to the radius.
enum class SoftCurve { smooth, sharp, linear, constant };

/// How far away something is.
enum class SoftDistance { edges, space };

std::span<const Choice> choices(Pivot);
std::span<const Choice> choices(Axes);
std::span<const Choice> choices(MirrorPlane);
std::span<const Choice> choices(SoftCurve);
std::span<const Choice> choices(SoftDistance);

struct SoftSelection {
  static constexpr double least_radius = 0.005, largest_radius = 2;

  bool on = false;
  double radius = 0.35;  ///< where the share is 0, of the diagonal of the view's space; least to largest
  SoftCurve curve = SoftCurve::smooth;
  SoftDistance distance = SoftDistance::edges;

  friend bool operator==(const SoftSelection&, const SoftSelection&) = default;
};

struct Handling {
  Pivot pivot = Pivot::median;
  std::optional<mesh::Point> point{};  ///< of Pivot::point, in the file's coordinates; else the median
  Axes axes = Axes::world;
  MirrorPlane mirror = MirrorPlane::none;
  SoftSelection soft{};
  double freedom = 0.5;       ///< of pins: 0 as the poses of the list say, 1 as rigid as can be
  bool mix_selected = false;  ///< the slider of a pose moves what is selected when it leaves 0, and no more

  friend bool operator==(const Handling&, const Handling&) = default;
};

}  // namespace viete::scene
