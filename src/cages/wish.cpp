#include "cages/wish.h"

namespace viete::cages {

namespace {

constexpr KindEntry kinds[] = {
    {Kind::automatic, "automatic", "encloses the model with the given number of triangles"},
    {Kind::box, "box", "box of quads, divided into cells"},
};

constexpr SymmetryEntry symmetries[] = {
    {Symmetry::automatic, "auto", "the model's plane of symmetry, if any"},
    {Symmetry::none, "none", "no plane"},
    {Symmetry::x, "x", "across x through the centre of the model's box"},
    {Symmetry::y, "y", "across y"},
    {Symmetry::z, "z", "across z"},
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
