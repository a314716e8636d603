#include "dragon/cage.h"

#include <utility>

#include "dragon/wings.h"

namespace viete::dragon {
namespace {

class Builder {
public:
  Ring add(const std::vector<Vec3>& points);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.triangles.push_back({a, b, c}); }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  void cap(const Ring& ring);
  /// Joins two rings of one size; next lies further along the limb.
  void bridge(const Ring& ring, const Ring& next);
  /// The sides of a bridge between rings a and b that are not drawn out into a limb.
  Ring side(const Ring& ring, const Ring& next, std::size_t i) const;

  Mesh mesh;
};

Ring Builder::add(const std::vector<Vec3>& points) {
  Ring ring;
  for (const Vec3& p : points) {
    ring.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(p);
  }
  return ring;
}

/// Cut along the shorter diagonal, so that both halves of the body are cut alike.
void Builder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto& p = mesh.positions;
  if (length(p[a] - p[c]) < length(p[b] - p[d]) + 1e-9) {
    triangle(a, b, c), triangle(a, c, d);
  } else {
    triangle(b, c, d), triangle(b, d, a);
  }
}

void Builder::cap(const Ring& ring) {
  if (ring.size() == 4)
    quad(ring[0], ring[1], ring[2], ring[3]);
  else
    triangle(ring[0], ring[1], ring[2]);
}

Ring Builder::side(const Ring& ring, const Ring& next, std::size_t i) const {
  const std::size_t j = (i + 1) % ring.size();
  return {ring[i], ring[j], next[j], next[i]};
}

void Builder::bridge(const Ring& ring, const Ring& next) {
  for (std::size_t i = 0; i < ring.size(); ++i) cap(side(ring, next, i));
}

/// A ring across the given direction: a triangle with its tip up, or a box.
std::vector<Vec3> across(Vec3 center, Vec3 forward, double up, double down, double sideways, bool box) {
  const Vec3 f = normalized(forward);
  const Vec3 left = normalized(Vec3{0, 0, 1} - f * f.z);
  const Vec3 above = cross(left, f);
  const Vec3 low = center - above * down, high = center + above * up;
  if (!box) return {high, low + left * sideways, low - left * sideways};
  return {high + left * sideways, low + left * sideways, low - left * sideways, high - left * sideways};
}

/// Top, left side, left below, right below, right side.
std::vector<Vec3> trunk_ring(Vec3 top, Vec3 side, Vec3 below) {
  return {top, side, below, mirrored(below), mirrored(side)};
}

void add_tail(Builder& builder, Cage& cage) {
  cage.tail = {builder.add(across({-1.71, 0.64, -0.12}, {0.37, -0.74, 0.56}, 0.21, 0.12, 0.24, false)),
               builder.add(across({-1.47, 0.26, 0.125}, {0.55, -0.65, 0.5}, 0.27, 0.13, 0.21, false)),
               builder.add(across({-1.16, 0.15, 0.215}, {1, 0.05, -0.1}, 0.25, 0.16, 0.23, false)),
               builder.add(across({-0.80, 0.25, 0.13}, {0.82, 0.48, -0.38}, 0.21, 0.16, 0.20, true))};
  const Ring &end = cage.tail[0], &root = cage.tail[3];
  builder.triangle(end[0], end[2], end[1]);
  builder.bridge(cage.tail[0], cage.tail[1]);
  builder.bridge(cage.tail[1], cage.tail[2]);
  const Ring& last = cage.tail[2];
  builder.quad(last[0], last[1], root[1], root[0]);
  builder.quad(last[1], last[2], root[2], root[1]);
  builder.quad(last[2], last[0], root[3], root[2]);
  builder.triangle(last[0], root[0], root[3]);
}

void add_trunk(Builder& builder, Cage& cage) {
  cage.trunk = {builder.add(trunk_ring({-0.54, 0.82, 0}, {-0.56, 0.57, 0.34}, {-0.68, 0.11, 0.12})),
                builder.add(trunk_ring({-0.30, 0.95, 0}, {-0.10, 0.63, 0.38}, {0.02, 0.30, 0.06})),
                builder.add(trunk_ring({0.28, 1.02, 0}, {0.47, 0.66, 0.31}, {0.52, 0.33, 0.06}))};
  const Ring &rump = cage.trunk[0], &middle = cage.trunk[1], &root = cage.tail[3];
  builder.triangle(root[3], root[0], rump[0]);
  builder.triangle(root[0], rump[1], rump[0]);
  builder.triangle(root[3], rump[0], rump[4]);
  builder.quad(root[0], root[1], rump[2], rump[1]);
  builder.quad(root[1], root[2], rump[3], rump[2]);
  builder.quad(root[2], root[3], rump[4], rump[3]);
  for (std::size_t i : {0, 2, 4}) builder.cap(builder.side(rump, middle, i));
  builder.cap(builder.side(middle, cage.trunk[2], 2));
}

void add_neck(Builder& builder, Cage& cage) {
  cage.neck = {builder.add(across({0.53, 0.975, 0}, {0.5, 0.87, 0}, 0.22, 0.195, 0.17, true)),
               builder.add(across({0.52, 1.15, 0}, {0.0, 1, 0}, 0.20, 0.17, 0.15, true))};
  const Ring &chest = cage.trunk[2], &base = cage.neck[0];
  builder.triangle(chest[0], base[0], base[3]);
  builder.triangle(chest[0], chest[1], base[0]);
  builder.quad(chest[1], chest[2], base[1], base[0]);
  builder.quad(chest[2], chest[3], base[2], base[1]);
  builder.quad(chest[3], chest[4], base[3], base[2]);
  builder.triangle(chest[4], chest[0], base[3]);
  builder.bridge(base, cage.neck[1]);
}

void add_head(Builder& builder, Cage& cage) {
  cage.crown =
      builder.add({{0.17, 1.88, 0.27}, {0.72, 1.08, 0.26}, {0.74, 1.08, -0.22}, {0.11, 1.92, -0.455}});
  cage.muzzle =
      builder.add({{1.12, 1.42, 0.29}, {1.06, 1.06, 0.26}, {1.08, 1.06, -0.01}, {1.14, 1.42, 0.01}});
  builder.bridge(cage.neck[1], cage.crown);
  builder.bridge(cage.crown, cage.muzzle);
  builder.cap(cage.muzzle);
}

/// The foot under a side of the trunk: back and front ends along x, outer and inner ones along z.
Ring add_leg(Builder& builder, const Ring& hip, double back, double front, double inner, double outer) {
  constexpr double kBelow = -0.07;
  const bool left = outer > 0;
  const double first = left ? outer : inner, second = left ? inner : outer;
  const Ring foot = builder.add(
      {{back, kBelow, first}, {back, kBelow, second}, {front, kBelow, second}, {front, kBelow, first}});
  builder.bridge(hip, foot);
  builder.cap(foot);
  return foot;
}

void add_legs(Builder& builder, Cage& cage) {
  const Ring &rump = cage.trunk[0], &middle = cage.trunk[1], &chest = cage.trunk[2];
  cage.feet[0] = add_leg(builder, builder.side(rump, middle, 1), -0.54, -0.03, 0.06, 0.40);
  cage.feet[1] = add_leg(builder, builder.side(rump, middle, 3), -0.50, 0.04, -0.06, -0.40);
  cage.feet[2] = add_leg(builder, builder.side(middle, chest, 1), 0.14, 0.64, 0.06, 0.39);
  cage.feet[3] = add_leg(builder, builder.side(middle, chest, 3), 0.09, 0.57, -0.06, -0.39);
}

/// Two corners of the wing's plane, behind and before, each doubled to both faces of the wing.
Ring wing_ring(Builder& builder, const WingFrame& frame, bool left, PlanePoint behind, PlanePoint before) {
  constexpr double kAbove = 0.17, kBelow = -0.11;  // more above, where the skin sags and bends towards
  const auto at = [&](PlanePoint p, double height) { return frame.place(p) + frame.normal * height; };
  const double first = left ? kAbove : kBelow, second = left ? kBelow : kAbove;
  return builder.add({at(behind, first), at(behind, second), at(before, second), at(before, first)});
}

void add_wing(Builder& builder, Cage& cage, bool left) {
  const WingFrame frame = wing_frame(left ? 1 : -1);
  const Ring root = builder.side(cage.trunk[1], cage.trunk[2], left ? 0 : 4);
  const Ring hand = wing_ring(builder, frame, left, {1.02, 0.25}, {-0.20, 0.84});
  const Ring tips = wing_ring(builder, frame, left, {1.24, 0.88}, {0.43, 1.44});
  builder.bridge(root, hand);
  builder.bridge(hand, tips);
  builder.cap(tips);
  cage.wing_hands[left ? 0 : 1] = hand;
  cage.wing_tips[left ? 0 : 1] = tips;
}

}  // namespace

Cage dragon_cage() {
  Builder builder;
  Cage cage;
  add_tail(builder, cage);
  add_trunk(builder, cage);
  add_neck(builder, cage);
  add_head(builder, cage);
  add_legs(builder, cage);
  add_wing(builder, cage, true);
  add_wing(builder, cage, false);
  cage.mesh = std::move(builder.mesh);
  return cage;
}

}  // namespace viete::dragon
