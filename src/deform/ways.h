// The combinations of weights and blend that have names, and how choices that someone made become one scheme.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "deform/scheme.h"

namespace viete::deform {

enum class Way { smooth, paper, mean_value, rigid, arap, local };

struct WayEntry : ChoiceEntry {
  Way value;
  Scheme scheme;
};

std::span<const WayEntry> all_ways();
const WayEntry& entry(Way way);

/// The scheme of a way, with how much turns and stretches act as in `now`.
Scheme scheme_of(Way way, const Scheme& now = {});
/// The way that a scheme is, however much turns and stretches act, wherever weights end that have a radius,
/// and however often and firmly a stitched model is solved for. Nothing if it is none.
std::optional<Way> way_of(const Scheme& scheme);

/// What a model is moved by where nobody chose: Way::smooth, the one whose energy is the lowest over the
/// poses of many models without being high in any (the manual has the table). Weights that do not need a
/// surface where there is none.
Scheme default_scheme(bool has_triangles = true);

inline PartialChoice only(Weights weights) {
  return {.weights = weights};
}
inline PartialChoice only(Blend blend) {
  return {.blend = blend};
}

/// The scheme that has all that is chosen, otherwise as much as possible of `preferred`, its radius, its
/// amounts, and its stitching where that goes with the rest. Throws base::Error if the choices
/// do not go together, saying why.
Scheme complete(const PartialChoice& choice, const Scheme& preferred = {});

/// The scheme after a user picks this way, weights or blend: the other choices of `now` stay where they are
/// compatible with it.
inline Scheme chosen(Way way, const Scheme& now) {
  return scheme_of(way, now);
}
template <class Choice>
Scheme chosen(Choice choice, const Scheme& now) {
  return complete(only(choice), now);
}

}  // namespace viete::deform
