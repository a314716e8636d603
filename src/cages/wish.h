// Parameters of cage making, and the named choices.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cages/subject.h"
#include "mesh/surface.h"

namespace viete::cages {

enum class Kind { automatic, box };

/// Plane of symmetry. automatic: the model's plane, if it has one; x, y, z: perpendicular to this axis,
/// through the centre of the model's box.
enum class Symmetry { automatic, none, x, y, z };

/// A preview simplifies the last triangles less carefully and checks the margin on a coarse grid only: about
/// four times as fast, and about as close.
enum class Effort { preview, full };

inline constexpr std::size_t least_triangles = 12, most_triangles = 20000;
inline constexpr double least_margin = 0.0005, most_margin = 0.2, most_gap = 0.2;
inline constexpr std::size_t most_cells = 32;

struct Wish {
  Kind kind = Kind::automatic;
  std::size_t triangles = 200;  ///< least_triangles to most_triangles; automatic cages only
  double margin = 0.0015;       ///< distance / model diagonal; least_margin to most_margin
  double gap = 0.005;           ///< closes gaps below twice this, in diagonals; 0 to most_gap
  Symmetry symmetry = Symmetry::automatic;
  bool quads = false;                         ///< pairs triangles into quads where suitable
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< boxes along each axis, 1 to most_cells; box cages only
  bool own_axes = false;  ///< box cages: along the model's axes of inertia, not the file's axes
  Effort effort = Effort::full;

  friend bool operator==(const Wish&, const Wish&) = default;
};

/// A choice by name.
template <class Value>
struct Entry {
  Value value;
  std::string_view name, sentence;
};
inline std::span<const Entry<Kind>> all_kinds() {
  static constexpr Entry<Kind> kinds[] = {
      {Kind::automatic, "automatic", "encloses the model with the given number of triangles"},
      {Kind::box, "box", "box of quads, divided into cells"},
  };
  return kinds;
}
inline std::span<const Entry<Symmetry>> all_symmetries() {
  static constexpr Entry<Symmetry> symmetries[] = {
      {Symmetry::automatic, "auto", "the model's plane of symmetry, if any"},
      {Symmetry::none, "none", "no plane"},
      {Symmetry::x, "x", "across x through the centre of the model's box"},
      {Symmetry::y, "y", "across y"},
      {Symmetry::z, "z", "across z"},
  };
  return symmetries;
}

struct Made {
  mesh::Surface surface;
  std::vector<std::string> notes;  ///< messages for the user, one line each
  std::optional<Plane> mirror;     ///< the cage's plane of symmetry
  double gap = 0;                  ///< gap actually closed; larger than requested if the size demanded it
};

}  // namespace viete::cages
