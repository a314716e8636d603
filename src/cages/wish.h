// The settings for making a cage, and its result.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/choice.h"
#include "cages/subject.h"
#include "mesh/surface.h"

namespace viete::cages {

enum class Kind { automatic, box };
inline std::span<const base::Choice> choices(Kind) {
  static constexpr base::Choice kinds[] = {
      {"automatic", "automatic", "a cage that follows the model, with the given number of triangles"},
      {"box", "box", "a box of quads, divided into cells"},
  };
  return kinds;
}

/// The plane of symmetry. `automatic` searches for the model's plane. `x`, `y` and `z` are the planes that
/// are perpendicular to this axis and contain the center of the model's bounding box.
enum class Symmetry { automatic, none, x, y, z };
inline std::span<const base::Choice> choices(Symmetry) {
  static constexpr base::Choice symmetries[] = {
      {"auto", "auto", "the model's own plane of symmetry, if it has one"},
      {"none", "none", "no plane of symmetry"},
      {"x", "x", "the plane perpendicular to x through the model's centre"},
      {"y", "y", "the plane perpendicular to y through the model's centre"},
      {"z", "z", "the plane perpendicular to z through the model's centre"},
  };
  return symmetries;
}

/// A preview is made about four times as fast, with a simpler method and a less exact margin.
enum class Effort { preview, full };

inline constexpr std::size_t least_triangles = 12, most_triangles = 20000;
inline constexpr double least_margin = 0.0005, most_margin = 0.2, most_gap = 0.2;
inline constexpr std::size_t most_cells = 32;

struct Wish {
  Kind kind = Kind::automatic;
  std::size_t triangles = 200;  ///< only for Kind::automatic
  double margin = 0.0015;       ///< relative to the model's diagonal
  double gap = 0.005;  ///< closes gaps narrower than twice this value; relative to the model's diagonal
  Symmetry symmetry = Symmetry::automatic;
  bool quads = false;                         ///< joins pairs of triangles to quads
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< the number of cells along each axis; only for Kind::box
  bool own_axes = false;                      ///< uses the model's axes of inertia; only for Kind::box
  Effort effort = Effort::full;

  friend bool operator==(const Wish&, const Wish&) = default;
};

struct Made {
  mesh::Surface surface;
  std::vector<std::string> notes;  ///< messages for the user
  std::optional<Plane> mirror;     ///< the cage's plane of symmetry
  double gap = 0;                  ///< the gap that was closed; may be larger than requested
};

}  // namespace viete::cages
