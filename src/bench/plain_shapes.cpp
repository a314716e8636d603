#include "bench/plain_shapes.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include "deform/branches.h"
#include "deform/dual_graph.h"
#include "deform/example_posing.h"
#include "deform/laplacian.h"
#include "mesh/adjacency.h"
#include "mesh/normals.h"

namespace viete::bench {

namespace {

using deform::LogTerm, deform::LogVector, deform::Vec3;
using Eigen::Matrix3d, Eigen::Vector3d;

Vector3d eigens(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Vec3 ours(const Vector3d& v) {
  return {v[0], v[1], v[2]};
}

Matrix3d rotation(const Vector3d& v) {
  const double angle = v.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Vector3d turn_of(const Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// Eigenvalues and vectors by QR.
using Spectrum = Eigen::SelfAdjointEigenSolver<Matrix3d>;

struct Log {
  Matrix3d stretch = Matrix3d::Zero();
  Vector3d turn{0, 0, 0};

  void add(const std::array<double, 9>& log, double factor) {
    Matrix3d x;
    x << log[0], log[1], log[2], log[1], log[3], log[4], log[2], log[4], log[5];
    stretch += factor * x;
    turn += factor * Vector3d(log[6], log[7], log[8]);
  }
};

Log summed(std::span<const LogTerm> terms, std::uint32_t triangle) {
  Log sum;
  for (const auto& [vector, factor] : terms) sum.add(vector->logs[triangle], factor);
  return sum;
}

Matrix3d with_eigenvalues(const Spectrum& of, const Vector3d& values) {
  return of.eigenvectors() * values.asDiagonal() * of.eigenvectors().transpose();
}

Matrix3d stretch_of(const Log& log) {
  const Spectrum spectrum(log.stretch);
  return with_eigenvalues(spectrum, spectrum.eigenvalues().array().exp());
}

struct Polar {
  Matrix3d rotation, log_stretch;
};
Polar polar(const Matrix3d& map) {
  const Eigen::JacobiSVD<Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs{1, 1, (svd.matrixU() * svd.matrixV()).determinant() < 0 ? -1.0 : 1.0};
  const Vector3d values = svd.singularValues().array().log();
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(),
          svd.matrixV() * values.asDiagonal() * svd.matrixV().transpose()};
}

// Two edges, and a normal as long as the side of a square of their area.
Matrix3d basis(std::span<const mesh::Point> p, const mesh::Triangle& t) {
  Matrix3d m;
  m.col(0) = eigens(p[t[1]] - p[t[0]]), m.col(1) = eigens(p[t[2]] - p[t[0]]);
  const Vector3d across = m.col(0).cross(m.col(1));
  m.col(2) = across / std::sqrt(across.norm());
  return m;
}

}  // namespace

class PlainShapes::Loops {
public:
  Loops(const deform::ShapeSpace& space, const mesh::Surface& rest);

  void shape(std::span<const LogTerm> terms, const deform::Held& held);
  LogVector vector(std::span<const mesh::Point> positions);

  // What follows a sum's logs, from rest, as deform::LogSpace::follow().
  const std::vector<Vec3>& follow(std::span<const LogTerm> terms, const Vec3* whole = nullptr);
  // Ways that pull a vertex of a part against the one that stays.
  std::vector<double> column(std::uint32_t vertex);

  const deform::LogSpace& logs() const { return logs_; }
  const std::vector<mesh::Point>& positions() const { return positions_; }

private:
  void add(std::size_t i, const Matrix3d& map, double share);
  void fit_doubtful(std::span<const LogTerm> terms, const Matrix3d& whole);
  void solve();
  std::vector<Vector3d> coherent(std::span<const Matrix3d> rotations) const;

  const deform::LogSpace& logs_;
  const mesh::Surface& rest_;
  mesh::Adjacency around_, neighbours_;
  std::vector<bool> free_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  Eigen::MatrixXd right_, solution_;
  std::vector<Vec3> ways_, straight_;
  std::vector<mesh::Point> positions_, normals_;
};

PlainShapes::Loops::Loops(const deform::ShapeSpace& space, const mesh::Surface& rest)
    : logs_(space.logs()),
      rest_(rest),
      around_(mesh::vertex_triangles(rest.positions.size(), rest.triangles)),
      free_(rest.positions.size()),
      right_(Eigen::Index(rest.positions.size()), 3),
      ways_(rest.positions.size()),
      straight_(rest.positions.size()),
      positions_(rest.positions.size()),
      normals_(rest.positions.size()) {
  const auto& parts = logs_.parts();
  for (std::size_t part = 0; part < parts.count(); ++part)
    for (const auto v : parts.vertices.of(part).subspan(1)) free_[v] = logs_.place(v) == v;
  std::vector<mesh::Triangle> placed;
  for (const auto& [a, b, c] : logs_.corners())
    placed.push_back({logs_.place(a), logs_.place(b), logs_.place(c)});
  const deform::SparseMatrix k = deform::grounded(deform::stiffness_matrix(rest.positions, placed), free_);
  const auto n = static_cast<int>(k.size());
  factors_.compute(Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, k.starts.back(), k.starts.data(),
                                                                 k.rows.data(), k.values.data()));
  std::vector<std::uint8_t> flat(rest.triangles.size(), 1);
  for (const auto t : logs_.triangles()) flat[t] = 0;
  const auto pairs = deform::dual_graph(rest, flat).edges;
  neighbours_ = mesh::make_adjacency(rest.triangles.size(), [&](const auto& join) {
    for (const auto& [a, b] : pairs) join(a, b), join(b, a);
  });
}

void PlainShapes::Loops::add(std::size_t i, const Matrix3d& map, double share) {
  const auto& corners = logs_.corners()[i];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
    const Vector3d pull =
        share * logs_.cotangents()[i][k] * (map * eigens(rest_.positions[a] - rest_.positions[b]));
    right_.row(logs_.place(a)) += pull.transpose();
    right_.row(logs_.place(b)) -= pull.transpose();
  }
}

void PlainShapes::Loops::solve() {
  Eigen::MatrixXd right = right_;
  for (std::size_t v = 0; v < free_.size(); ++v)
    if (!free_[v]) right.row(Eigen::Index(v)).setZero();
  solution_.resize(right.rows(), 3);
  for (int c = 0; c < 3; ++c) solution_.col(c) = factors_.solve(right.col(c));
  for (std::size_t v = 0; v < ways_.size(); ++v)
    ways_[v] = ours(solution_.row(logs_.place(static_cast<std::uint32_t>(v))).transpose());
}

const std::vector<Vec3>& PlainShapes::Loops::follow(std::span<const LogTerm> terms, const Vec3* whole) {
  Vector3d turn{0, 0, 0};
  for (const auto& [vector, factor] : terms) turn += factor * eigens(vector->wholes[0]);
  const Matrix3d turned = rotation(whole ? eigens(*whole) : turn);
  right_.setZero();
  for (std::size_t i = 0; i < logs_.triangles().size(); ++i) {
    const Log log = summed(terms, logs_.triangles()[i]);
    add(i, turned * rotation(log.turn) * stretch_of(log) - Matrix3d::Identity(), 1);
  }
  solve();
  fit_doubtful(terms, turned);
  return ways_;
}

// Rotations by a share those nearest to sum_k c_k e'_k (S e_k)^T, and solved for again: see deform::LogSpace.
void PlainShapes::Loops::fit_doubtful(std::span<const LogTerm> terms, const Matrix3d& whole) {
  std::vector<double> shares(rest_.triangles.size());
  for (const auto& [vector, factor] : terms)
    for (const auto& [triangle, share] : vector->doubts) shares[triangle] += std::abs(factor) * share;
  bool fits = false;
  for (std::size_t i = 0; i < logs_.triangles().size(); ++i) {
    const double share = std::min(1.0, shares[logs_.triangles()[i]]);
    if (share == 0) continue;
    const Log log = summed(terms, logs_.triangles()[i]);
    const Matrix3d stretch = stretch_of(log);
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = logs_.corners()[i][(k + 1) % 3], b = logs_.corners()[i][(k + 2) % 3];
      const Vector3d side = eigens(rest_.positions[a] - rest_.positions[b]);
      sum += logs_.cotangents()[i][k] * (side + eigens(ways_[a] - ways_[b])) * side.transpose();
    }
    add(i, (polar(sum * stretch).rotation - whole * rotation(log.turn)) * stretch, share);
    fits = true;
  }
  if (fits) solve();
}

void PlainShapes::Loops::shape(std::span<const LogTerm> terms, const deform::Held& held) {
  follow(terms);
  for (std::size_t v = 0; v < ways_.size(); ++v) {
    straight_[v] = {0, 0, 0};
    for (const auto& [vector, factor] : terms) {
      straight_[v] = straight_[v] + factor * vector->ways[v];
      ways_[v] = ways_[v] + factor * vector->leftovers[v];
    }
    if (logs_.parts().loose[v]) ways_[v] = straight_[v];
  }
  deform::hold(logs_.parts(), held, straight_, ways_);
  for (std::size_t v = 0; v < ways_.size(); ++v) positions_[v] = rest_.positions[v] + ways_[v];
  mesh::vertex_normals(positions_, rest_.triangles, around_, 0, positions_.size(), normals_);
}

std::vector<double> PlainShapes::Loops::column(std::uint32_t vertex) {
  right_.setZero();
  right_(logs_.place(vertex), 0) = 1;
  solve();
  std::vector<double> column;
  for (const Vec3& way : ways_) column.push_back(way[0]);
  return column;
}

std::vector<Vector3d> PlainShapes::Loops::coherent(std::span<const Matrix3d> rotations) const {
  struct Step {
    double difference;
    std::uint32_t from, to;
    bool operator<(const Step& s) const { return difference > s.difference; }
  };
  std::vector<Vector3d> logs;
  for (const Matrix3d& r : rotations) logs.push_back(turn_of(r));
  std::vector<bool> reached(rotations.size());
  std::priority_queue<Step> steps;
  for (std::uint32_t root = 0; root < rotations.size(); ++root) {
    if (reached[root]) continue;
    for (steps.push({0, root, root}); !steps.empty();) {
      const auto [difference, from, to] = steps.top();
      steps.pop();
      if (reached[to]) continue;
      reached[to] = true;
      logs[to] = eigens(deform::nearest_branch(ours(logs[to]), ours(logs[from])));
      for (const auto next : neighbours_.of(to))
        if (!reached[next]) steps.push({3 - rotations[to].cwiseProduct(rotations[next]).sum(), to, next});
    }
  }
  return logs;
}

LogVector PlainShapes::Loops::vector(std::span<const mesh::Point> positions) {
  LogVector vector = logs_.at_rest();
  std::vector<Matrix3d> maps(rest_.triangles.size(), Matrix3d::Identity());
  Matrix3d mean = Matrix3d::Zero();
  for (const auto t : logs_.triangles()) {
    const Matrix3d rest = basis(rest_.positions, rest_.triangles[t]);
    maps[t] = basis(positions, rest_.triangles[t]) * rest.inverse();
    mean += rest.col(2).squaredNorm() * maps[t];
  }
  const Matrix3d whole = polar(mean).rotation;
  vector.wholes[0] = ours(turn_of(whole));
  std::vector<Matrix3d> rotations(maps.size(), Matrix3d::Identity());
  for (const auto t : logs_.triangles()) {
    const Polar split = polar(whole.transpose() * maps[t]);
    rotations[t] = split.rotation;
    const Matrix3d& x = split.log_stretch;
    vector.logs[t] = {x(0, 0), x(0, 1), x(0, 2), x(1, 1), x(1, 2), x(2, 2), 0, 0, 0};
  }
  const std::vector<Vector3d> turns = coherent(rotations);
  for (std::size_t t = 0; t < turns.size(); ++t) std::copy_n(turns[t].data(), 3, vector.logs[t].data() + 6);
  const LogTerm term{&vector, 1};
  follow({&term, 1});
  for (std::size_t v = 0; v < ways_.size(); ++v) {
    vector.ways[v] = positions[v] - rest_.positions[v];
    vector.leftovers[v] = vector.ways[v] - ways_[v];
  }
  deform::center(logs_.parts(), vector.leftovers);
  return vector;
}

// Of examples, and the columns of the inverse Laplacian that belong to the vertices.
class PlainPosing::Steps {
public:
  Steps(PlainShapes::Loops& shapes, std::vector<const LogVector*> examples,
        std::vector<std::uint32_t> vertices);

  void step(std::span<const mesh::Point> targets);

  const std::vector<mesh::Point>& positions() const { return positions_; }

private:
  void add_triangle(std::size_t i);
  void show(std::span<const mesh::Point> targets);

  PlainShapes::Loops& shapes_;
  std::vector<const LogVector*> examples_;
  std::vector<std::vector<Vec3>> leftovers_;  // of the examples, before their whole turns
  std::vector<std::uint32_t> vertices_;
  std::vector<std::vector<double>> columns_;
  std::vector<std::vector<Vector3d>> gradients_;  // [vertex][triangle]
  Eigen::MatrixXd forces_;
  double area_ = 0;
  std::vector<double> weights_;
  Vec3 turn_{0, 0, 0};
  Eigen::MatrixXd places_, changes_;  // of the vertices, without the turn
  std::vector<mesh::Point> positions_;
};

PlainPosing::Steps::Steps(PlainShapes::Loops& shapes, std::vector<const LogVector*> examples,
                          std::vector<std::uint32_t> vertices)
    : shapes_(shapes),
      examples_(std::move(examples)),
      vertices_(std::move(vertices)),
      weights_(examples_.size()) {
  const deform::LogSpace& logs = shapes_.logs();
  const auto& rest = logs.rest();
  positions_ = rest;
  for (const LogVector* example : examples_) {
    const Matrix3d back = rotation(-eigens(example->wholes[0]));
    auto& own = leftovers_.emplace_back();
    for (const Vec3& leftover : example->leftovers) own.push_back(ours(back * eigens(leftover)));
  }
  for (const auto v : vertices_) {
    const auto& z = columns_.emplace_back(shapes_.column(v));
    auto& gradients = gradients_.emplace_back();
    for (std::size_t i = 0; i < logs.corners().size(); ++i) {
      Vector3d& q = gradients.emplace_back(0, 0, 0);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = logs.corners()[i][(k + 1) % 3], b = logs.corners()[i][(k + 2) % 3];
        q += logs.cotangents()[i][k] * (z[a] - z[b]) * eigens(rest[a] - rest[b]);
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(vertices_.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) system(i, j) = columns_[std::size_t(j)][vertices_[std::size_t(i)]];
    system(i, n) = system(n, i) = 1;
  }
  forces_ = system.fullPivLu().inverse().leftCols(n);
  for (const auto& t : logs.corners()) area_ += basis(rest, t).col(2).squaredNorm() / 2;
}

void PlainPosing::Steps::add_triangle(std::size_t i) {
  const std::uint32_t t = shapes_.logs().triangles()[i];
  Log sum;
  for (std::size_t e = 0; e < examples_.size(); ++e) sum.add(examples_[e]->logs[t], weights_[e]);
  const Spectrum spectrum(sum.stretch);
  const Vector3d& x = spectrum.eigenvalues();
  const Vector3d exponentials = x.array().exp();
  Matrix3d quotients;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const double h = (x[a] - x[b]) / 2;
      quotients(a, b) = std::exp((x[a] + x[b]) / 2) * (std::abs(h) < 1e-4 ? 1 + h * h / 6 : std::sinh(h) / h);
    }
  const Matrix3d r = rotation(sum.turn), map = r * with_eigenvalues(spectrum, exponentials);
  const double angle = sum.turn.norm(), square = angle * angle;
  const bool small = angle < 1e-4;
  const double first = small ? 0.5 : (1 - std::cos(angle)) / square,
               second = small ? 1.0 / 6 : (angle - std::sin(angle)) / (square * angle);
  for (std::size_t k = 0; k < vertices_.size(); ++k) places_.col(Eigen::Index(k)) += map * gradients_[k][i];
  for (std::size_t e = 0; e < examples_.size(); ++e) {
    Log change;
    change.add(examples_[e]->logs[t], 1);
    const Matrix3d own = spectrum.eigenvectors().transpose() * change.stretch * spectrum.eigenvectors();
    const Matrix3d stretch =
        spectrum.eigenvectors() * quotients.cwiseProduct(own) * spectrum.eigenvectors().transpose();
    const Vector3d across = sum.turn.cross(change.turn);
    const Vector3d turning = change.turn + first * across + second * sum.turn.cross(across);
    Matrix3d changed = r * stretch;
    for (int c = 0; c < 3; ++c) changed.col(c) += turning.cross(map.col(c));
    for (std::size_t k = 0; k < vertices_.size(); ++k)
      changes_.col(Eigen::Index(e)).segment<3>(Eigen::Index(3 * k)) += changed * gradients_[k][i];
  }
}

void PlainPosing::Steps::step(std::span<const mesh::Point> targets) {
  const auto n = static_cast<Eigen::Index>(vertices_.size()), m = static_cast<Eigen::Index>(weights_.size());
  places_ = Eigen::MatrixXd::Zero(3, n), changes_ = Eigen::MatrixXd::Zero(3 * n, m + 3);
  for (std::size_t i = 0; i < shapes_.logs().triangles().size(); ++i) add_triangle(i);
  const Matrix3d turn = rotation(eigens(turn_));
  Eigen::MatrixXd off(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto v = vertices_[std::size_t(k)];
    Vector3d place = places_.col(k);
    for (Eigen::Index e = 0; e < m; ++e) {
      const Vector3d left = eigens(leftovers_[std::size_t(e)][v]);
      place += weights_[std::size_t(e)] * left;
      auto change = changes_.col(e).segment<3>(3 * k);
      change = (turn * (change + left)).eval();
    }
    place = turn * place;
    for (int axis = 0; axis < 3; ++axis)
      changes_.col(m + axis).segment<3>(3 * k) = Vector3d::Unit(axis).cross(place);
    off.row(k) = (eigens(targets[std::size_t(k)]) - place).transpose();
  }
  Eigen::MatrixXd pulled(3 * n, m + 3);
  for (Eigen::Index c = 0; c < m + 3; ++c) {
    const Eigen::MatrixXd column = changes_.col(c).reshaped(3, n).transpose();
    pulled.col(c) = (forces_.topRows(n) * column).transpose().reshaped();
  }
  const double held = deform::PosingSettings{}.restraint * area_;
  Eigen::MatrixXd normal = changes_.transpose() * pulled;
  Eigen::VectorXd right = pulled.transpose() * off.transpose().reshaped();
  normal.topLeftCorner(m, m).diagonal().array() += held;
  right.head(m) -= held * Eigen::Map<const Eigen::VectorXd>(weights_.data(), m);
  normal.diagonal() *= 1 + 1e-6;
  Eigen::VectorXd step = normal.ldlt().solve(right);
  const double length = step.cwiseAbs().maxCoeff();
  if (length > 0.7) step *= 0.7 / length;
  for (Eigen::Index e = 0; e < m; ++e) weights_[std::size_t(e)] += step[e];
  turn_ = ours(turn_of(rotation(step.tail<3>()) * turn));
  show(targets);
}

void PlainPosing::Steps::show(std::span<const mesh::Point> targets) {
  std::vector<LogTerm> terms;
  for (std::size_t e = 0; e < examples_.size(); ++e) terms.push_back({examples_[e], weights_[e]});
  const std::vector<Vec3>& ways = shapes_.follow(terms, &turn_);
  const Matrix3d turn = rotation(eigens(turn_));
  for (std::size_t v = 0; v < positions_.size(); ++v) {
    Vec3 left{0, 0, 0};
    for (std::size_t e = 0; e < examples_.size(); ++e) left = left + weights_[e] * leftovers_[e][v];
    positions_[v] = shapes_.logs().rest()[v] + ways[v] + ours(turn * eigens(left));
  }
  Eigen::MatrixXd off(vertices_.size(), 3);
  for (std::size_t k = 0; k < vertices_.size(); ++k)
    off.row(Eigen::Index(k)) = eigens(targets[k] - positions_[vertices_[k]]).transpose();
  const Eigen::MatrixXd forces = forces_ * off;
  const Vec3 way = ours(forces.row(forces.rows() - 1).transpose());
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    const Vec3 force = ours(forces.row(Eigen::Index(k)).transpose());
    for (std::size_t v = 0; v < positions_.size(); ++v)
      positions_[v] = positions_[v] + columns_[k][v] * force;
  }
  for (mesh::Point& p : positions_) p = p + way;
}

PlainShapes::PlainShapes(const deform::ShapeSpace& space, const mesh::Surface& rest)
    : loops_(std::make_unique<Loops>(space, rest)) {}

PlainShapes::~PlainShapes() = default;

void PlainShapes::shape(std::span<const LogTerm> terms, const deform::Held& held) {
  loops_->shape(terms, held);
}

const std::vector<mesh::Point>& PlainShapes::positions() const {
  return loops_->positions();
}

LogVector PlainShapes::vector(std::span<const mesh::Point> positions) {
  return loops_->vector(positions);
}

PlainPosing::PlainPosing(PlainShapes& shapes, std::vector<const LogVector*> examples,
                         std::vector<std::uint32_t> vertices)
    : steps_(std::make_unique<Steps>(*shapes.loops_, std::move(examples), std::move(vertices))) {}

PlainPosing::~PlainPosing() = default;

void PlainPosing::step(std::span<const mesh::Point> targets) {
  steps_->step(targets);
}

const std::vector<mesh::Point>& PlainPosing::positions() const {
  return steps_->positions();
}

}  // namespace viete::bench
