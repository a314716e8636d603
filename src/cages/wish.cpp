#include "cages/wish.h"

namespace viete::cages {

namespace {

constexpr KindEntry kinds[] = {
    {Kind::automatic, "automatic", "follows the model with as many triangles as asked for"},
    {Kind::box, "box", "a box of quads, cut into cells"},
};

constexpr SymmetryEntry symmetries[] = {
    {Symmetry::automatic, "auto", "about the model's plane of symmetry, if it has one"},
    {Symmetry::none, "none", "no plane"},
    {Symmetry::x, "x", "across x, through the middle of the model's box"},
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
