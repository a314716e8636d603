#include "bench/reference_frame.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "sym3/exp.h"

namespace viete::bench {

using namespace deform;

namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double t = dot(p - a, edge) / dot(edge, edge);
  if (t <= 0) return norm(p - a);
  if (t >= 1) return norm(p - b);
  return norm(p - a - t * edge);
}

// p = a + x (b - a) + y (c - a) + z n, by Cramer's rule.
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, w = p - a, normal = cross(u, v);
  const Vec3 n = (1 / norm(normal)) * normal;
  const double determinant = dot(u, cross(v, n));
  const double x = dot(w, cross(v, n)) / determinant, y = dot(u, cross(w, n)) / determinant;
  const double edges =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const bool inside = x > 0 && y > 0 && x + y < 1;
  return inside ? std::min(edges, std::abs(dot(w, n))) : edges;
}

}  // namespace

void PlainWeights::compute(std::span<const mesh::Point> positions, const Cage& cage, double exponent) {
  const std::size_t k = cage.element_count();
  const auto& corners = cage.surface.positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto& t = cage.surface.triangles[j];
      distances_[i * k + j] = distance_to_triangle(positions[i], corners[t[0]], corners[t[1]], corners[t[2]]);
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j) {
      weights_[i * k + j] = std::pow(distances_[i * k + j], -exponent);
      sum += weights_[i * k + j];
    }
    for (std::size_t j = 0; j < k; ++j) weights_[i * k + j] /= sum;
  }
}

namespace {

using Rows3 = std::array<std::array<double, 3>, 3>;

Rows3 product(const Rows3& a, const Rows3& b) {
  Rows3 c{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Rows3 exp_stretch(const Rows3& m) {
  const auto e = sym3::exp(sym3::Sym3<double>{m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]},
                           sym3::Method::improved_sd);
  return {{{e.xx, e.xy, e.xz}, {e.xy, e.yy, e.yz}, {e.xz, e.yz, e.zz}}};
}

Eigen::Vector3d vector(const deform::Vec3& v) {
  return {v[0], v[1], v[2]};
}

std::array<Eigen::Vector3d, 3> corners(const mesh::Triangle& t, std::span<const mesh::Point> positions) {
  return {vector(positions[t[0]]), vector(positions[t[1]]), vector(positions[t[2]])};
}

// Two edges and a normal scaled to the square root of their cross product's length.
Eigen::Matrix3d frame_of(const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d u = t[1] - t[0], v = t[2] - t[0], n = u.cross(v);
  Eigen::Matrix3d frame;
  frame << u, v, n / std::sqrt(n.norm());
  return frame;
}

Rows3 rows_of(const Eigen::Matrix3d& m) {
  Rows3 rows;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) rows[r][c] = m(r, c);
  }
  return rows;
}

// I + sin t / t Y + (1 - cos t) / t^2 Y^2.
Rows3 exp_rodrigues(const Rows3& y) {
  const double square = y[2][1] * y[2][1] + y[0][2] * y[0][2] + y[1][0] * y[1][0], angle = std::sqrt(square);
  const double a = angle > 1e-8 ? std::sin(angle) / angle : 1.0;
  const double b = angle > 1e-8 ? (1 - std::cos(angle)) / square : 0.5;
  const Rows3 squared = product(y, y);
  Rows3 r{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r[i][j] = (i == j ? 1 : 0) + a * y[i][j] + b * squared[i][j];
  }
  return r;
}

}  // namespace

ReferenceFrame::ReferenceFrame(const deform::Cage& cage, const deform::Binding& binding)
    : cage_(cage),
      binding_(binding),
      handles_(binding.handles),
      positions_(binding.vertices),
      normals_(binding.vertices) {}

void ReferenceFrame::deform(const deform::Pose& pose) {
  log_cage(pose);
  for (std::size_t v = 0; v < positions_.size(); ++v) positions_[v] = place(v);
  scatter_normals();
}

void ReferenceFrame::log_cage(const deform::Pose& pose) {
  for (std::size_t j = 0; j < handles_.size(); ++j) {
    const auto& t = cage_.surface.triangles[j];
    const auto posed = corners(t, pose.positions);
    const Eigen::Matrix3d map = frame_of(posed) * frame_of(corners(t, cage_.surface.positions)).inverse();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d& v = svd.matrixV();
    const Eigen::Matrix3d stretch =
        v * svd.singularValues().array().log().matrix().asDiagonal() * v.transpose();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * v.transpose()));
    const Eigen::Vector3d y = turn.angle() * turn.axis(), c = (posed[0] + posed[1] + posed[2]) / 3;
    handles_[j] = {
        rows_of(stretch), {{{0, -y[2], y[1]}, {y[2], 0, -y[0]}, {-y[1], y[0], 0}}}, {c[0], c[1], c[2]}};
  }
}

mesh::Point ReferenceFrame::place(std::size_t vertex) const {
  const double* weights = binding_.weights.data() + vertex * binding_.handles;
  Rows3 stretch{}, rotation{};
  mesh::Point sum{0, 0, 0};
  for (std::size_t j = 0; j < handles_.size(); ++j) {
    const Handle& h = handles_[j];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) stretch[r][c] += weights[j] * h.stretch[r][c];
      for (int c = 0; c < 3; ++c) rotation[r][c] += weights[j] * h.rotation[r][c];
      sum[r] += weights[j] * h.center[r];
    }
  }
  const Rows3 affine = product(exp_rodrigues(rotation), exp_stretch(stretch));
  const mesh::Point& x = binding_.offsets[vertex];
  mesh::Point p;
  for (int r = 0; r < 3; ++r) {
    p[r] = affine[r][0] * x[0] + affine[r][1] * x[1] + affine[r][2] * x[2] + sum[r];
  }
  return p;
}

void ReferenceFrame::scatter_normals() {
  for (auto& n : normals_) n = {0, 0, 0};
  for (const auto& t : binding_.triangles) {
    const mesh::Point &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                 v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (const auto corner : t) {
      for (int i = 0; i < 3; ++i) normals_[corner][i] += n[i];
    }
  }
  for (auto& n : normals_) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 0) n = {n[0] / length, n[1] / length, n[2] / length};
  }
}

}  // namespace viete::bench
