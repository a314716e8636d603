#include "cages/wish.h"

namespace viete::cages {

namespace {

constexpr KindEntry kinds[] = {
    {Kind::automatic, "automatic", "follows the model, with the given number of triangles"},
    {Kind::box, "box", "a box of quads, divided into cells"},
};

constexpr SymmetryEntry symmetries[] = {
    {Symmetry::automatic, "auto", "the model's plane of symmetry, if any"},
    {Symmetry::none, "none", "not symmetric"},
    {Symmetry::x, "x", "perpendicular to x, through the centre of the model's box"},
    {Symmetry::y, "y", "perpendicular to y"},
    {Symmetry::z, "z", "perpendicular to z"},
};

}  // namespace

std::span<const KindEntry> all_kinds() {
  return kinds;
}

std::span<const SymmetryEntry> all_symmetries() {
  return symmetries;
}

const KindEntry& entry(Kind kind) {
  return kinds[static_cast<std::size_t>(kind)];
}

const SymmetryEntry& entry(Symmetry symmetry) {
  return symmetries[static_cast<std::size_t>(symmetry)];
}

}  // namespace viete::cages
