#include "deform/integrated_distance.h"

#include <algorithm>
#include <cmath>

namespace viete::deform {

namespace {

constexpr double series_limit = 1.0 / 16;  // largest k sin^2 t for which J is taken as a series
constexpr int series_terms = 14;

// The letters are the header's; squares of lengths contain that of the softening.
struct Edge {
  double length, moment;  // m L
  double m, q, c, b;
  double k, squared_sine, steepest;  // of b; k sin^2 t at its largest

  // From begin to end, as x sees it. Their difference is not that of u and v, which far away have lost it.
  Edge(const Vec3& begin, const Vec3& end, const Vec3& x, const Vec3& n, double h2, double soft2)
      : length(norm(end - begin)),
        moment(dot(n, cross(begin - x, end - begin))),
        m(moment / length),
        q(std::sqrt(h2 + m * m)) {
    const Vec3 u = begin - x, v = end - x;
    c = dot(u, v) + soft2;
    b = std::atan2(q * length, c);
    k = h2 / (q * q);
    const double ratio = q * length / (squared_norm(u) + soft2);
    squared_sine = ratio * (q * length / (squared_norm(v) + soft2));
    steepest = c < 0 ? k : k * squared_sine;
  }
};
using Edges = std::array<Edge, 3>;

// Integrals S_n of sin^(2n+2) t go up and down by (2n+2) S_n = (2n+1) S_n-1 - sin^(2n+1) b cos b. Down for
// small angles, where going up would leave rounding: in units of sin^(2n+3) b.
double small_angle_series(const Edge& e) {
  const double s2 = e.squared_sine, cosine = std::sqrt(1 - s2), x = e.k * s2;
  double unit = 0, sum = 0;
  for (int n = 2 + static_cast<int>(40 / -std::log(s2)); n > 0; --n) {
    unit = ((2 * n + 2) * s2 * unit + cosine) / (2 * n + 1);
    sum = unit + x * sum;
  }
  return s2 * std::sqrt(s2) * sum;
}

double large_angle_series(const Edge& e) {
  const double s2 = e.squared_sine, sine_cosine = std::sin(e.b) * std::cos(e.b);
  double integral = (e.b - sine_cosine) / 2, power = 1, sum = integral;
  double boundary = sine_cosine;
  for (int n = 1; n < series_terms; ++n) {
    boundary *= s2;
    power *= e.k;
    integral = ((2 * n + 1) * integral - boundary) / (2 * n + 2);
    sum += power * integral;
  }
  return sum;
}

double j(const Edge& e) {
  return e.c > 0 && e.squared_sine < 0.5 ? small_angle_series(e) : large_angle_series(e);
}

// Formula (1).
double sum_of_angles(const Edges& edges, double h2) {
  double sum = 0;
  for (const Edge& e : edges) sum += e.m / e.q * e.b;
  return sum / (2 * h2);
}

// T P, by the longest edge, whose opposite angle has the smallest cotangent.
double area_times_power(const std::array<Vec3, 3>& corners, const Edges& edges, double twice_area) {
  const auto longest = std::ranges::max_element(edges, {}, &Edge::length) - edges.begin();
  const Vec3 &u = corners[longest], &v = corners[(longest + 1) % 3], &opposite = corners[(longest + 2) % 3];
  return twice_area * edges[longest].c - dot(u - opposite, v - opposite) * edges[longest].moment;
}

// Formula (2).
double area_after_inversion(const std::array<Vec3, 3>& corners, const Edges& edges, double h2,
                            double twice_area) {
  const auto& [e, f, g] = edges;
  const double real =
      e.c * f.c * g.c - e.c * f.moment * g.moment - f.c * g.moment * e.moment - g.c * e.moment * f.moment;
  const double x = area_times_power(corners, edges, twice_area) / real, argument = h2 * x;
  double area = argument != 0 ? std::atan(argument) / argument * x : x;
  for (const Edge& edge : edges) area -= edge.m / (edge.q * edge.q * edge.q) * j(edge);
  return area / 2;
}

}  // namespace

double inverse_fourth_power_integral(const std::array<Vec3, 3>& corners, const Vec3& x, double softening) {
  const auto& [a, b, c] = corners;
  const Vec3 across = cross(b - a, c - a);
  const double twice_area = norm(across);
  const Vec3 n = (1 / twice_area) * across;
  const auto squared_distance = [&](const Vec3& corner) { return squared_norm(corner - x); };
  const Vec3& nearest = std::ranges::min(corners, {}, squared_distance);
  const double soft2 = softening * softening, h = dot(n, nearest - x), h2 = h * h + soft2;
  const Edges edges = {Edge(a, b, x, n, h2, soft2), Edge(b, c, x, n, h2, soft2), Edge(c, a, x, n, h2, soft2)};
  const auto largest = [&](auto member) { return std::ranges::max(edges, {}, member).*member; };
  const bool outside = std::ranges::any_of(edges, [](const Edge& e) { return e.moment < 0; });
  const bool far_above = h2 > largest(&Edge::length) * largest(&Edge::length);
  return (outside || far_above) && largest(&Edge::steepest) < series_limit
             ? area_after_inversion(corners, edges, h2, twice_area)
             : sum_of_angles(edges, h2);
}

double softening(const Cage& cage) {
  return std::max(1e-8 * cage.diagonal, cage.contact);
}

void integrated_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& positions = cage.surface.positions;
  const double unit = 1 / cage.diagonal, soft = unit * softening(cage);
  const Vec3 origin = positions[cage.surface.triangles[0][0]], from_cage = unit * (p - origin);
  const Vec3 x = std::min(1.0, farthest_weighed / norm(from_cage)) * from_cage;
  double sum = 0;
  for (std::size_t e = 0; e < weights.size(); ++e) {
    weights[e] = 0;
    if (cage.degenerate[e]) continue;
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = unit * (positions[cage.surface.triangles[e][i]] - origin);
    weights[e] =
        std::max(0.0, inverse_fourth_power_integral(corners, x, soft));  // a needle's may be rounding
    sum += weights[e];
  }
  for (double& w : weights) w /= sum;
}

}  // namespace viete::deform
