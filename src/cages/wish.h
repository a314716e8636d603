// What cage is wanted, and the choices there are, with their names and sentences.
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

/// About which plane the cage is symmetric: that of the model, if it has one; none; or across an axis through
/// the middle of the model's box.
enum class Symmetry { automatic, none, x, y, z };

/// Of a preview the last triangles are taken with less care, and the margin is kept as far as a coarse grid
/// tells: some four times as fast, and about as close.
enum class Effort { preview, full };

inline constexpr std::size_t least_triangles = 12, most_triangles = 20000;
inline constexpr double least_margin = 0.0005, most_margin = 0.2, most_gap = 0.2;
inline constexpr std::size_t most_cells = 32;

struct Wish {
  Kind kind = Kind::automatic;
  std::size_t triangles = 200;  ///< least_triangles to most_triangles; not of boxes
  double margin = 0.0015;       ///< distance to the model, of its diagonal; least_margin to most_margin
  double gap = 0.005;           ///< gaps narrower than twice this, of the diagonal, are closed; 0 to most_gap
  Symmetry symmetry = Symmetry::automatic;
  bool quads = false;                         ///< triangles are paired where two make a good quad
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< of boxes, along each axis; 1 to most_cells
  bool own_axes = false;  ///< of boxes: along the model's longest extents, not the file's axes
  Effort effort = Effort::full;

  friend bool operator==(const Wish&, const Wish&) = default;
};

struct KindEntry {
  Kind value;
  std::string_view name, sentence;
};
struct SymmetryEntry {
  Symmetry value;
  std::string_view name, sentence;
};
std::span<const KindEntry> all_kinds();
std::span<const SymmetryEntry> all_symmetries();
const KindEntry& entry(Kind kind);
const SymmetryEntry& entry(Symmetry symmetry);

struct Made {
  mesh::Surface surface;
  std::vector<std::string> notes;  ///< what a person should know, one line each
  std::optional<Plane> mirror;     ///< the cage is symmetric about it
  double gap = 0;                  ///< that was closed in the end: larger than wished if the size demanded it
};

}  // namespace viete::cages
