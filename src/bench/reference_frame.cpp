#include "bench/reference_frame.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "sym3/eigen.h"
#include "sym3/exp.h"

namespace viete::bench {

using namespace pose;

namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double t = dot(p - a, edge) / dot(edge, edge);
  if (t <= 0) return norm(p - a);
  if (t >= 1) return norm(p - b);
  return norm(p - a - t * edge);
}

// Solves p = a + x * (b - a) + y * (c - a) + z * n by Cramer's rule. x and y tell whether the plane's
// point nearest to p is inside the triangle.
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

Eigen::Matrix3d exp_stretch(const Eigen::Matrix3d& m) {
  return sym3::to_eigen(sym3::exp(sym3::from_eigen<double>(m), sym3::Method::improved_sd));
}

Eigen::Vector3d vector(const mesh::Vec3& v) {
  return {v[0], v[1], v[2]};
}

std::array<Eigen::Vector3d, 3> corners(const mesh::Triangle& t, std::span<const mesh::Point> positions) {
  return {vector(positions[t[0]]), vector(positions[t[1]]), vector(positions[t[2]])};
}

// Returns the matrix with the columns u, v and n / sqrt(|n|). u and v are edges, and n = u x v.
Eigen::Matrix3d frame_of(const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d u = t[1] - t[0], v = t[2] - t[0], n = u.cross(v);
  Eigen::Matrix3d frame;
  frame << u, v, n / std::sqrt(n.norm());
  return frame;
}

// Returns I + (sin t / t) * Y + ((1 - cos t) / t^2) * Y^2 for a rotation by t radians.
Eigen::Matrix3d exp_rodrigues(const Eigen::Matrix3d& y) {
  const double square = 0.5 * y.squaredNorm(), angle = std::sqrt(square);
  const double a = angle > 1e-8 ? std::sin(angle) / angle : 1.0;
  const double b = angle > 1e-8 ? (1 - std::cos(angle)) / square : 0.5;
  return Eigen::Matrix3d::Identity() + a * y + b * y * y;
}

}  // namespace

void PlainWeights::compute(std::span<const mesh::Point> positions, const Cage& cage) {
  const std::size_t k = cage.element_count();
  const auto& corners = cage.elements.positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = 0; j < k; ++j) {
      const auto& t = cage.elements.triangles[j];
      distances_[i * k + j] = distance_to_triangle(positions[i], corners[t[0]], corners[t[1]], corners[t[2]]);
    }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j) {
      weights_[i * k + j] = std::pow(distances_[i * k + j], -2.0);
      sum += weights_[i * k + j];
    }
    for (std::size_t j = 0; j < k; ++j) weights_[i * k + j] /= sum;
  }
}

struct ReferenceFrame::Handle {
  Eigen::Matrix3d stretch, rotation;  // logarithms
  Eigen::Vector3d center;
};

ReferenceFrame::ReferenceFrame(const pose::Cage& cage, const weights::Binding& binding)
    : cage_(cage),
      binding_(binding),
      handles_(binding.handles),
      positions_(binding.vertices),
      normals_(binding.vertices) {}

ReferenceFrame::~ReferenceFrame() = default;

void ReferenceFrame::deform(const pose::Pose& pose) {
  log_cage(pose);
  for (std::size_t v = 0; v < positions_.size(); ++v) positions_[v] = place(v);
  scatter_normals();
}

void ReferenceFrame::log_cage(const pose::Pose& pose) {
  for (std::size_t j = 0; j < handles_.size(); ++j) {
    const auto& t = cage_.elements.triangles[j];
    const auto posed = corners(t, pose::with_centers(cage_, pose.positions));
    const Eigen::Matrix3d map = frame_of(posed) * frame_of(corners(t, cage_.elements.positions)).inverse();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d& v = svd.matrixV();
    const Eigen::Matrix3d stretch =
        v * svd.singularValues().array().log().matrix().asDiagonal() * v.transpose();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * v.transpose()));
    const Eigen::Vector3d y = turn.angle() * turn.axis();
    Handle& h = handles_[j];
    h.stretch = stretch;
    h.rotation << 0, -y[2], y[1], y[2], 0, -y[0], -y[1], y[0], 0;
    h.center = (posed[0] + posed[1] + posed[2]) / 3;
  }
}

mesh::Point ReferenceFrame::place(std::size_t vertex) const {
  const double* weights = binding_.weights.data() + vertex * binding_.handles;
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Zero(), rotation = stretch;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (std::size_t j = 0; j < handles_.size(); ++j) {
    stretch += weights[j] * handles_[j].stretch;
    rotation += weights[j] * handles_[j].rotation;
    center += weights[j] * handles_[j].center;
  }
  const Eigen::Vector3d p =
      exp_rodrigues(rotation) * exp_stretch(stretch) * vector(binding_.offsets[vertex]) + center;
  return {p[0], p[1], p[2]};
}

void ReferenceFrame::scatter_normals() {
  for (auto& n : normals_) n = {0, 0, 0};
  for (const auto& t : binding_.model->triangles) {
    const mesh::Point& a = positions_[t[0]];
    const mesh::Point n = cross(positions_[t[1]] - a, positions_[t[2]] - a);
    for (const auto corner : t) normals_[corner] = normals_[corner] + n;
  }
  for (auto& n : normals_)
    if (const double length = norm(n); length > 0) n = (1 / length) * n;
}

}  // namespace viete::bench
