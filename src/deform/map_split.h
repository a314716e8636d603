// Each map's own part of its log: polar split, log of the stretch, principal log of the rotation.
#pragma once

#include <cstdint>
#include <span>

#include "deform/face_maps.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// linear = rotation * exp(stretch), rotation = exp(turn). What no other element has a say in.
struct MapSplit {
  sym3::Mat3<double> rotation;  ///< the nearest one
  sym3::Sym3<double> stretch;   ///< X = log S; usable where `least` is positive and no tiny part of `largest`
  Vec3 turn;                    ///< |turn| <= pi
  double least, largest;        ///< stretches; least < 0 where the map mirrors, NaN where it is not finite
};

/// Of these elements' maps, in double vector code; splits of the others stay as they are. Each depends on its
/// own map alone, to the last bit. Error of rotation and stretch: sym3/polar.h, sym3/log.h.
void split_maps(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                std::span<MapSplit> splits);

}  // namespace viete::deform
