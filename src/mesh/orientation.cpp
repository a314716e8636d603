#include "mesh/orientation.h"

#include <cmath>
#include <cstddef>

namespace viete::mesh {

namespace {

constexpr double roundoff = 0x1p-53;  // half an ulp of 1

int sign(double x) {
  return (x > 0) - (x < 0);
}

// A sum without rounding: parts that do not overlap, in ascending size (Shewchuk's expansions).
class ExactSum {
public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i], rest = sum - x;
      const double lost = (x - (sum - rest)) + (parts_[i] - rest);
      if (lost != 0) parts_[kept++] = lost;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }

  // A product of two is a head and a tail; each of them times the third again.
  void add_product(double x, double y, double z) {
    const double head = x * y, tail = std::fma(x, y, -head);
    for (const double part : {tail, head}) {
      const double product = part * z;
      add(std::fma(part, z, -product));
      add(product);
    }
  }

  void add_determinant(const Point& p, const Point& q, const Point& r, double factor) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      add_product(factor * p[i], q[j], r[k]);
      add_product(-factor * p[i], q[k], r[j]);
    }
  }

  int sign() const { return size_ == 0 ? 0 : mesh::sign(parts_[size_ - 1]); }

private:
  std::array<double, 128> parts_;  // each add() makes at most one more; a determinant adds 96
  std::size_t size_ = 0;
};

// Of det(u, v, w), whose entries are rounded once; exact() where its rounding leaves the sign open.
template <class Exact>
int sign_of(const Vec3& u, const Vec3& v, const Vec3& w, const Exact& exact) {
  double determinant = 0, permanent = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += w[i] * (u[j] * v[k] - u[k] * v[j]);
    permanent += std::abs(w[i]) * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
  }
  if (permanent == 0) return 0;
  if (std::abs(determinant) > (7 + 56 * roundoff) * roundoff * permanent) return sign(determinant);
  return exact().sign();
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  return sign_of(b - a, c - a, d - a, [&] {
    ExactSum sum;
    sum.add_determinant(b, c, d, 1);
    sum.add_determinant(a, c, d, -1);
    sum.add_determinant(a, b, d, 1);
    sum.add_determinant(a, b, c, -1);
    return sum;
  });
}

int orientation_along(const Vec3& normal, const Point& a, const Point& b, const Point& c) {
  return sign_of(b - a, c - a, normal, [&] {
    ExactSum sum;
    for (const auto& [p, q] : {std::array{&a, &b}, std::array{&b, &c}, std::array{&c, &a}})
      sum.add_determinant(*p, *q, normal, 1);
    return sum;
  });
}

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  if (std::abs(left - right) > (3 + 16 * roundoff) * roundoff * (std::abs(left) + std::abs(right))) {
    return sign(left - right);
  }
  ExactSum sum;
  for (const auto& [p, q] : {std::array{&a, &b}, std::array{&b, &c}, std::array{&c, &a}}) {
    sum.add_product((*p)[0], (*q)[1], 1);
    sum.add_product(-(*p)[1], (*q)[0], 1);
  }
  return sum.sign();
}

}  // namespace viete::mesh
