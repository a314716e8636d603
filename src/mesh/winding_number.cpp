#include "mesh/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>

#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

// Points processed at a time, one per vector lane.
constexpr std::size_t lanes = 8;
using Lanes = std::array<double, lanes>;

// Unit directions from the points to one vertex; zero where a point lies on it.
struct Directions {
  Lanes x, y, z;

  void set(const Point& vertex, const Directions& points, double scale) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const double dx = (vertex[0] - points.x[l]) * scale, dy = (vertex[1] - points.y[l]) * scale,
                   dz = (vertex[2] - points.z[l]) * scale;
      const double squared = dx * dx + dy * dy + dz * dz;
      const double inverse = squared > 0 ? 1 / std::sqrt(squared) : 0;
      x[l] = dx * inverse;
      y[l] = dy * inverse;
      z[l] = dz * inverse;
    }
  }
};

struct Complex {
  Lanes re, im;
};

// Half the solid angle of a triangle is the argument of a complex number with im = a . (b x c), re = 1 + a.b
// + b.c + c.a for unit directions.
void half_solid_angle(const Directions& a, const Directions& b, const Directions& c, Complex& out) {
  for (std::size_t l = 0; l < lanes; ++l) {
    out.im[l] = a.x[l] * (b.y[l] * c.z[l] - b.z[l] * c.y[l]) + a.y[l] * (b.z[l] * c.x[l] - b.x[l] * c.z[l]) +
                a.z[l] * (b.x[l] * c.y[l] - b.y[l] * c.x[l]);
    out.re[l] = 1 + (a.x[l] * b.x[l] + a.y[l] * b.y[l] + a.z[l] * b.z[l]) +
                (b.x[l] * c.x[l] + b.y[l] * c.y[l] + b.z[l] * c.z[l]) +
                (c.x[l] * a.x[l] + c.y[l] * a.y[l] + c.z[l] * a.z[l]);
  }
}

// A sum of arguments in (-pi, pi], stored as the argument of the product plus full rotations: if both factors
// lie in the same half plane and the product does not, it crossed the negative real axis. Needs a single arc
// tangent at the end.
struct ArgumentSum {
  Complex product;
  Lanes turns;

  ArgumentSum() {
    product.re.fill(1);
    product.im.fill(0);
    turns.fill(0);
  }

  void add(const Complex& z) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const double a = product.re[l], b = product.im[l], c = z.re[l], d = z.im[l];
      const double re = a * c - b * d, im = a * d + b * c;
      const bool both_up = (b >= 0) & (d >= 0), both_down = (b < 0) & (d < 0);
      const bool up = both_up & ((im < 0) | ((im == 0) & (re > 0) & (a < 0)));
      const bool down = both_down & ((im > 0) | ((im == 0) & (re < 0)));
      turns[l] += (up ? 1.0 : 0.0) - (down ? 1.0 : 0.0);
      const double size = std::abs(re) + std::abs(im);
      const bool usable = size > 0;  // on an edge the argument is undefined and counts as 0
      const double inverse = 1 / size;
      product.re[l] = usable ? re * inverse : a;
      product.im[l] = usable ? im * inverse : b;
    }
  }

  // In full rotations.
  double value(std::size_t l) const {
    return turns[l] + std::atan2(product.im[l] + 0.0, product.re[l]) / (2 * std::numbers::pi);
  }
};

double inverse_size(const Surface& surface) {
  const double diagonal = used_bounds(surface).diagonal();
  return diagonal > 0 ? 1 / diagonal : 1;
}

class Winding {
public:
  explicit Winding(const Surface& surface, double scale)
      : surface_(surface), scale_(scale), directions_(surface.positions.size()) {}

  // Evaluates points[begin] and up to lanes - 1 following ones.
  void evaluate(std::span<const Point> points, std::size_t begin, std::span<double> numbers) {
    Directions at;
    for (std::size_t l = 0; l < lanes; ++l) {
      const Point& p = points[std::min(begin + l, points.size() - 1)];
      at.x[l] = p[0];
      at.y[l] = p[1];
      at.z[l] = p[2];
    }
    for (std::size_t v = 0; v < directions_.size(); ++v)
      directions_[v].set(surface_.positions[v], at, scale_);
    ArgumentSum sum;
    Complex z;
    for (const Triangle& t : surface_.triangles) {
      half_solid_angle(directions_[t[0]], directions_[t[1]], directions_[t[2]], z);
      sum.add(z);
    }
    for (std::size_t l = 0; l < lanes && begin + l < points.size(); ++l) numbers[begin + l] = sum.value(l);
  }

private:
  const Surface& surface_;
  double scale_;
  std::vector<Directions> directions_;
};

void for_blocks(std::size_t count, base::WorkerPool* pool,
                const std::function<void(std::size_t, std::size_t)>& body) {
  if (pool) {
    pool->for_blocks(count, 64 * lanes, body);
  } else if (count > 0) {
    body(0, count);
  }
}

double squared_distance_to(const Surface& surface, const Point& p, double scale) {
  double least = std::numeric_limits<double>::infinity();
  const auto scaled = [&](std::uint32_t v) { return scale * (surface.positions[v] - p); };
  for (const Triangle& t : surface.triangles) {
    const auto closest = closest_on_triangle({0, 0, 0}, scaled(t[0]), scaled(t[1]), scaled(t[2]));
    least = std::min(least, closest.squared_distance);
  }
  return least;
}

}  // namespace

void winding_numbers(const Surface& surface, std::span<const Point> points, std::span<double> numbers,
                     base::WorkerPool* pool) {
  const double scale = inverse_size(surface);
  for_blocks(points.size(), pool, [&](std::size_t begin, std::size_t end) {
    Winding winding(surface, scale);
    for (std::size_t i = begin; i < end; i += lanes) winding.evaluate(points.first(end), i, numbers);
  });
}

std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool) {
  std::vector<double> numbers(positions.size());
  winding_numbers(cage, positions, numbers, pool);
  const double scale = inverse_size(cage);
  std::vector<std::uint8_t> outside(positions.size(), 0);
  for_blocks(positions.size(), pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      outside[i] = std::abs(numbers[i]) < 0.5 && squared_distance_to(cage, positions[i], scale) > 1e-18;
    }
  });
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (outside[i]) found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

}  // namespace viete::mesh
