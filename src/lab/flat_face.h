// What a deformation does to the plane of one triangle.
#pragma once

#include <optional>
#include <span>

#include "mesh/surface.h"

namespace viete::lab {

/// A triangle with area, and its sides u = (length, 0) and v = (along, across) at rest, in axes of its plane.
struct FlatFace {
  mesh::Triangle corners;
  double length, along, across;

  double area() const { return length * across / 2; }
};

/// Nothing where the triangle has no area.
std::optional<FlatFace> flat_face(std::span<const mesh::Point> rest, const mesh::Triangle& triangle);

/// Where the axes of the plane have gone: columns of the map from the plane into space.
struct PlaneMap {
  mesh::Vec3 x, y;
};
PlaneMap plane_map(const FlatFace& face, std::span<const mesh::Point> positions);

/// Singular values of such a map: how long the most and the least stretched unit vector has become.
struct Stretches {
  double larger, smaller;
};
Stretches stretches(const PlaneMap& map);

}  // namespace viete::lab
