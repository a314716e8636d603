#include "shapes/example_posing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "mesh/triangle.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "shapes/plane_kernel.h"
#include "sym3/eigenvalues.h"
#include "sym3/kernel.h"
#include "sym3/polar.h"

namespace viete::shapes {

namespace {

using Mat = sym3::Mat3<double>;

constexpr std::size_t blocks_at_once = 128;  // fixed, so that sums do not depend on the number of threads
constexpr double longest_step = 0.7;  // limit of the change of a weight, and of the rotation in radians
constexpr double least_damping = 1e-9, most_damping = 1e3;
constexpr double at_rest = 1e-5;  // solve() ends after a step below this size

// Returns true if the rotation nearest to `m` is unique.
bool tells_rotation(const Mat& m) {
  const auto singular = sym3::eigenvalues(sym3::polar(m).stretch);
  return singular[0] + singular[1] > 1e-6 * singular[2];
}

using MatrixByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Vector3d column(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Vec3 vec(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}

// Unit vectors: two orthogonal directions u and v in the plane of a triangle, and the normal n. In a
// coupling, u is the direction of the line.
struct Axes {
  Vec3 u, v, n;
};
Axes axes_of(std::span<const mesh::Point> p, const mesh::Triangle& t) {
  const Vec3 side = p[t[1]] - p[t[0]];
  Vec3 across = cross(side, p[t[2]] - p[t[0]]);
  if (t[1] == t[2])
    across = cross(side, std::abs(side[0]) < std::abs(side[1]) ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 u = (1 / norm(side)) * side, n = (1 / norm(across)) * across;
  return {u, cross(n, u), n};
}

}  // namespace

// `places`: positions of the pinned vertices in the blend of examples, without the translations of the parts.
// `changes`: derivatives of `places`. One column per example's weight, then three columns for the rotation.
struct ExamplePosing::Reach {
  Eigen::MatrixXd places, changes;
};

ExamplePosing::ExamplePosing(const ShapeSpace& space, std::vector<const LogVector*> examples,
                             base::WorkerPool& pool)
    : joined_(space.joined(pool)),
      space_(joined_ ? *joined_ : space),
      examples_(std::move(examples)),
      pool_(pool) {
  if (joined_) {
    for (const LogVector* example : examples_) {
      std::vector<mesh::Point> shape = space_.rest();
      for (std::size_t v = 0; v < shape.size(); ++v) shape[v] = shape[v] + space.displacements(*example)[v];
      vectors_.push_back(space_.vector(shape, pool));
    }
    for (std::size_t e = 0; e < vectors_.size(); ++e) examples_[e] = &vectors_[e];
  }
  const auto& rest = space_.logs().rest();
  for (const LogVector* example : examples_) {
    const Vec3 back = -1.0 * example->wholes[0];
    const Mat turn = sym3::exp_rotation(back);
    std::vector<Vec3> own;
    for (const Vec3& leftover : example->leftovers) own.push_back(pose::times(turn, leftover));
    leftovers_.push_back(std::move(own));
  }
  for (const auto& t : space_.logs().corners()) area_ += mesh::area(rest, t);
  fill_groups();
  restart();
}

void ExamplePosing::restart() {
  weights_.assign(examples_.size(), 0);
  usual_weights_ = weights_;
  turn_ = {0, 0, 0};
  turns_ = false;
  damping_ = 1e-3;
  energy_ = std::numeric_limits<double>::infinity();
  positions_ = space_.logs().rest();
  posed_.clear();
  if (space_.coarse()) model_positions_ = space_.rest();
}

void ExamplePosing::begin(std::vector<double> weights, std::span<const mesh::Point> shape) {
  restart();
  weights_ = usual_weights_ = std::move(weights);
  turns_ = true;
  if (space_.coarse()) model_positions_.assign(shape.begin(), shape.end());
  positions_ = space_.solved(shape, pool_);
  work_.displacements.resize(positions_.size());  // makes show() fit rotations to positions_
}

// Returns the vertex as a weighted sum of the vertices of the log space.
std::vector<ExamplePosing::Share> ExamplePosing::shares_of(std::uint32_t vertex) const {
  if (!space_.coarse()) return {{vertex, 1}};
  std::vector<Share> shares;
  double sum = 0;
  for (const auto& [cluster, factor] : space_.coarse()->terms(vertex)) {
    shares.push_back({cluster, factor});
    sum += shares.back().factor;
  }
  for (Share& share : shares) share.factor /= sum;
  return shares;
}

Vec3 ExamplePosing::at_pin(std::size_t pin, std::span<const Vec3> values) const {
  Vec3 sum{0, 0, 0};
  for (const auto& [v, factor] : shares_[pin]) sum = sum + factor * values[v];
  return sum;
}

std::size_t ExamplePosing::blocks() const {
  return (space_.logs().corners().size() + plane_size - 1) / plane_size;
}

void ExamplePosing::fill_groups() {
  const LogSpace& logs = space_.logs();
  const std::size_t numbers = numbers_of_group();
  groups_.assign(blocks() * plane_size * numbers, 0);
  for (std::size_t t = 0; t < logs.corners().size(); ++t) {
    double* to = groups_.data() + t / group_size * group_size * numbers + t % group_size;
    const auto put = [&](double x) { *std::exchange(to, to + group_size) = x; };
    const Axes axes = axes_of(logs.rest(), logs.corners()[t]);
    for (const Vec3& axis : {axes.u, axes.v}) std::ranges::for_each(axis, put);
    for (const LogVector* example : examples_) {
      const auto& [xx, xy, xz, yy, yz, zz, x, y, z] = example->logs[logs.triangles()[t]];
      const sym3::Sym3<double> stretch{xx, xy, xz, yy, yz, zz};
      const Vec3 u = pose::times(stretch, axes.u), v = pose::times(stretch, axes.v),
                 n = pose::times(stretch, axes.n);
      for (const double number : {dot(axes.u, u), dot(axes.u, v), dot(axes.u, n), dot(axes.v, v),
                                  dot(axes.v, n), dot(axes.n, n), x, y, z})
        put(number);
    }
  }
}

void ExamplePosing::set_pins(std::vector<PosingPin> pins) {
  const LogSpace& logs = space_.logs();
  const auto& rest = logs.rest();
  if (pins.size() > most_pins)
    throw base::Error(
        "",
        base::with_thousands(pins.size()) + " pins exceed the limit of " + base::with_thousands(most_pins),
        "pin fewer vertices");
  std::vector<std::vector<Share>> shares;
  for (const PosingPin& pin : pins) {
    shares.push_back(shares_of(pin.vertex));
    if (shares.back().empty() || logs.parts().loose[shares.back()[0].vertex])
      throw base::Error(
          "",
          "vertex " + std::to_string(pin.vertex) + " (numbered from 0) belongs to no triangle with an area",
          "pin another vertex");
  }
  base::require_memory(
      {static_cast<double>(pins.size()) *
           (8.0 * static_cast<double>(rest.size()) + 24.0 * static_cast<double>(logs.corners().size())),
       base::counted(pins.size(), "pin") + " on this model take", "pin fewer vertices", ""});
  pins_ = std::move(pins);
  shares_ = std::move(shares);
  energy_ = std::numeric_limits<double>::infinity();
  columns_.clear();
  part_of_pin_.clear();
  LogSpace::Work work;
  work.displacements.resize(rest.size());
  for (std::size_t first = 0; first < pins_.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, pins_.size() - first);
    work.right.assign(rest.size(), Vec3{0, 0, 0});
    for (std::size_t j = 0; j < count; ++j)
      for (const auto& [v, factor] : shares_[first + j]) work.right[logs.place(v)][j] += factor;
    logs.solve(work);
    for (std::size_t j = 0; j < count; ++j) {
      auto& column = columns_.emplace_back();
      for (const Vec3& w : work.displacements) column.push_back(w[j]);
    }
  }
  std::vector<std::uint32_t> part_of(rest.size());
  for (std::uint32_t part = 0; part < logs.parts().count(); ++part)
    for (const auto v : logs.parts().vertices.of(part)) part_of[v] = part;
  for (const auto& of_pin : shares_) part_of_pin_.push_back(part_of[of_pin[0].vertex]);
  fill_gradients();
  fill_stiffness();
}

// Computes q = triangle area * gradient of z, for each triangle and each column z of columns_. The formula is
// q = sum_k c_k * e_k * (z_a - z_b), where edge e_k runs from vertex b to vertex a, and c_k is half the
// cotangent of the angle opposite to e_k.
void ExamplePosing::fill_gradients() {
  const LogSpace& logs = space_.logs();
  const auto& rest = logs.rest();
  const std::size_t count = logs.corners().size(), pins = pins_.size();
  gradients_.assign(blocks() * plane_size * 2 * pins, 0);
  for (std::size_t t = 0; t < count; ++t) {
    const auto& corners = logs.corners()[t];
    const Axes axes = axes_of(rest, corners);
    for (std::size_t pin = 0; pin < pins; ++pin) {
      Vec3 q{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        q = q + logs.cotangents()[t][k] * (columns_[pin][a] - columns_[pin][b]) * (rest[a] - rest[b]);
      }
      double* of = gradients_.data() + (t / plane_size * pins + pin) * 2 * plane_size + t % plane_size;
      of[0] = dot(q, axes.u);
      of[plane_size] = dot(q, axes.v);
    }
  }
}

// Computes forces_, the pseudoinverse of linear equations for the forces f at the pins and the translations t
// of the parts. For pin i at vertex v with firmness c, and for each part:
//     f_i / c + (sum over pins k of columns_[k][v] * f_k) + t = (target) - (position in the blend)
//     sum of f = 0
// If hard constraints contradict each other, this gives the least squares solution.
void ExamplePosing::fill_stiffness() {
  std::vector<std::uint32_t> parts = part_of_pin_;
  std::ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  const auto n = static_cast<Eigen::Index>(pins_.size()), all = n + static_cast<Eigen::Index>(parts.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(all, all);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      for (const auto& [v, factor] : shares_[std::size_t(i)])
        system(i, j) += factor * columns_[std::size_t(j)][v];
    system(i, i) += 1 / pins_[std::size_t(i)].firmness;
    const auto part = std::ranges::lower_bound(parts, part_of_pin_[std::size_t(i)]) - parts.begin();
    system(i, n + part) = system(n + part, i) = 1;
  }
  forces_.resize(std::size_t(all * n));
  Eigen::Map<MatrixByRows>(forces_.data(), all, n) =
      system.completeOrthogonalDecomposition().pseudoInverse().leftCols(n);
  pinned_parts_ = std::move(parts);
}

std::vector<double> ExamplePosing::reach(std::span<const std::size_t> moved) const {
  const std::size_t n = pins_.size();
  std::vector<double> forces(n + pinned_parts_.size()), reach(positions_.size());
  for (std::size_t i = 0; i < forces.size(); ++i)
    for (const std::size_t k : moved) forces[i] += forces_[i * n + k];
  for (std::size_t i = 0; i < pinned_parts_.size(); ++i)
    for (const auto v : space_.logs().parts().vertices.of(pinned_parts_[i])) {
      reach[v] = forces[n + i];
      for (std::size_t k = 0; k < n; ++k)
        if (part_of_pin_[k] == pinned_parts_[i]) reach[v] += columns_[k][v] * forces[k];
    }
  if (!space_.coarse()) return reach;
  std::vector<double> of_model(space_.rest().size());
  for (std::uint32_t v = 0; v < of_model.size(); ++v)
    for (const auto& [cluster, factor] : space_.coarse()->terms(v)) of_model[v] += factor * reach[cluster];
  return of_model;
}

// Returns the sums in reach_of_pins(), but only over the blocks [begin, end).
std::vector<double> ExamplePosing::sums_of_blocks(std::size_t begin, std::size_t end) const {
  const PlaneKernel& kernel = plane_kernel(sym3::kernel());
  const std::size_t numbers = numbers_of_group(), pins = pins_.size(), maps = examples_.size() + 1;
  base::AlignedVector<double> changes(6 * maps * plane_stride), lanes(3 * pins * maps * group_size, 0.0);
  for (std::size_t block = begin; block < end; ++block) {
    const double* groups = groups_.data() + block * plane_size * numbers;
    for (std::size_t i = 0; i < plane_size; i += group_size)
      kernel.derive(groups + i * numbers, weights_.data(), maps - 1, changes.data() + i);
    kernel.add_products(changes.data(), maps, gradients_.data() + block * plane_size * 2 * pins, pins,
                        lanes.data());
  }
  std::vector<double> sums(3 * pins * maps);
  for (std::size_t i = 0; i < lanes.size(); ++i) sums[i / group_size] += lanes[i];
  return sums;
}

std::vector<LogTerm> ExamplePosing::terms() const {
  std::vector<LogTerm> terms;
  for (std::size_t e = 0; e < examples_.size(); ++e)
    if (weights_[e] != 0) terms.push_back({examples_[e], weights_[e]});
  return terms;
}

ExamplePosing::Reach ExamplePosing::reach_of_pins() const {
  const std::size_t n = pins_.size(), m = examples_.size();
  // Sums over all triangles, [example][pin][3]: derivatives of the pins' positions by the examples' weights.
  // The entry after the last example contains the positions.
  std::vector<double> sums(3 * n * (m + 1));
  std::vector<std::vector<double>> parts((blocks() + blocks_at_once - 1) / blocks_at_once);
  pool_.for_blocks(blocks(), blocks_at_once, [&](std::size_t begin, std::size_t end) {
    parts[begin / blocks_at_once] = sums_of_blocks(begin, end);
  });
  for (const auto& part : parts)
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += part[i];
  const Mat g = sym3::exp_rotation(turn_);
  Reach reach{Eigen::MatrixXd(n, 3), Eigen::MatrixXd(3 * n, m + 3)};
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = [&](std::size_t e) {
      const double* s = sums.data() + 3 * (n * e + k);
      return Vec3{s[0], s[1], s[2]};
    };
    Vec3 place = at(m);
    for (std::size_t e = 0; e < m; ++e) place = place + weights_[e] * at_pin(k, leftovers_[e]);
    place = pose::times(g, place);
    reach.places.row(Eigen::Index(k)) = column(place).transpose();
    for (std::size_t e = 0; e < m; ++e)
      reach.changes.block<3, 1>(Eigen::Index(3 * k), Eigen::Index(e)) =
          column(pose::times(g, at(e) + at_pin(k, leftovers_[e])));
    Eigen::Matrix3d about;  // derivative by the rotation, as matrix of a cross product
    about << 0, place[2], -place[1], -place[2], 0, place[0], place[1], -place[0], 0;
    reach.changes.block<3, 3>(Eigen::Index(3 * k), Eigen::Index(m)) = about;
  }
  return reach;
}

// Sets turn_ to the rotation that best moves the pins from rest to their targets, if this rotation is unique.
void ExamplePosing::begin_turn() {
  turns_ = true;
  const auto& rest = space_.logs().rest();
  const double share = 1 / static_cast<double>(pins_.size());
  Vec3 from{0, 0, 0}, to{0, 0, 0};
  for (std::size_t k = 0; k < pins_.size(); ++k) {
    from = from + share * at_pin(k, rest);
    to = to + share * targets_[k];
  }
  Mat sum{};
  for (std::size_t k = 0; k < pins_.size(); ++k) {
    const Vec3 a = targets_[k] - to, b = at_pin(k, rest) - from;
    for (std::size_t n = 0; n < 9; ++n) sum[n] += a[n / 3] * b[n % 3];
  }
  if (tells_rotation(sum)) turn_ = sym3::log_rotation(sym3::polar(sum).rotation);
}

double ExamplePosing::step(std::span<const mesh::Point> targets, const PosingSettings& settings) {
  const double size = advance(targets, settings);
  move_model();
  return size;
}

// Makes a step. If there is a coarse model, moves only the pinned vertices of the model.
double ExamplePosing::advance(std::span<const mesh::Point> targets, const PosingSettings& settings) {
  if (!std::ranges::equal(targets, given_)) energy_ = std::numeric_limits<double>::infinity();
  given_.assign(targets.begin(), targets.end());
  aim();
  if (!turns_) begin_turn();
  const Reach reach = reach_of_pins();
  const auto n = static_cast<Eigen::Index>(pins_.size()), m = static_cast<Eigen::Index>(examples_.size());
  Eigen::MatrixXd off(n, 3);
  for (Eigen::Index k = 0; k < n; ++k)
    off.row(k) = column(targets_[std::size_t(k)]).transpose() - reach.places.row(k);
  const Eigen::Map<const MatrixByRows> stiffness(forces_.data(), n, n);
  const Eigen::MatrixXd forces = stiffness * off;
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(weights_.data(), m) -
                                  Eigen::Map<const Eigen::VectorXd>(usual_weights_.data(), m);
  const double pull = settings.restraint * area_;
  const double energy = off.cwiseProduct(forces).sum() + pull * weights.squaredNorm();
  if (energy > energy_) {  // the last step was too long, so undo the step and increase the damping
    weights_ = last_weights_;
    turn_ = last_turn_;
    damping_ = std::min(10 * damping_, most_damping);
    energy_ = std::numeric_limits<double>::infinity();
    return advance(targets, settings);
  }
  damping_ = std::max(damping_ / 3, least_damping);
  energy_ = energy;
  last_weights_ = weights_;
  last_turn_ = turn_;

  Eigen::MatrixXd pulled(3 * n, m + 3);  // the stiffness times the derivatives
  for (Eigen::Index c = 0; c < m + 3; ++c) {
    const Eigen::MatrixXd column = reach.changes.col(c).reshaped(3, n).transpose();
    pulled.col(c) = (stiffness * column).transpose().reshaped();
  }
  Eigen::MatrixXd normal = reach.changes.transpose() * pulled;
  Eigen::VectorXd right = pulled.transpose() * off.transpose().reshaped();
  normal.topLeftCorner(m, m).diagonal().array() += pull;
  right.head(m) -= pull * weights;
  normal.diagonal() += damping_ * normal.diagonal() +
                       Eigen::VectorXd::Constant(m + 3, least_damping * (normal.trace() + 1e-300));
  Eigen::VectorXd step = normal.ldlt().solve(right);
  if (!step.allFinite()) step.setZero();
  const double length = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0;
  if (length > longest_step) step *= longest_step / length;
  for (Eigen::Index e = 0; e < m; ++e) weights_[std::size_t(e)] += step[e];
  turn_ = sym3::log_rotation(pose::times(sym3::exp_rotation(vec(step.tail<3>())), sym3::exp_rotation(turn_)));
  return std::max(std::min(length, longest_step), show(settings));
}

int ExamplePosing::solve(std::span<const mesh::Point> targets, const PosingSettings& settings, int most,
                         base::Progress* progress) {
  int steps = 0;
  for (bool moves = true; moves && steps < most;) {
    ++steps;
    if (progress) progress->report(static_cast<double>(steps) / most);
    moves = advance(targets, settings) >= at_rest;
  }
  move_model();
  return steps;
}

// Computes positions_. If settings.freedom is positive and there are previous positions, fits rotations to
// the previous positions, and returns the largest change of a position in units of sqrt(area_). Otherwise
// returns 0.
double ExamplePosing::show(const PosingSettings& settings) {
  const LogSpace& logs = space_.logs();
  const auto& rest = logs.rest();
  const std::vector<LogTerm> sum = terms();
  const Mat g = sym3::exp_rotation(turn_);
  left_.assign(rest.size(), Vec3{0, 0, 0});
  std::vector<ScaledRows> rows;
  for (std::size_t e = 0; e < examples_.size(); ++e) rows.push_back({leftovers_[e][0].data(), weights_[e]});
  plane_kernel(sym3::kernel()).add_rows(rows.data(), rows.size(), 3 * rest.size(), left_[0].data());
  for (Vec3& left : left_) left = pose::times(g, left);
  const bool fits = settings.freedom > 0 && !work_.displacements.empty();
  before_.clear();
  if (fits) {
    before_ = positions_;
    for (std::size_t v = 0; v < rest.size(); ++v) work_.displacements[v] = positions_[v] - rest[v] - left_[v];
    logs.follow_fitted(sum, settings.freedom, pool_, work_, &turn_);
  } else {
    logs.follow(sum, pool_, work_, &turn_);
  }
  for (std::size_t v = 0; v < rest.size(); ++v) positions_[v] = rest[v] + work_.displacements[v] + left_[v];
  reach_targets();
  place_other_parts();
  if (space_.coarse()) follow_clusters(sum);
  double farthest = 0;
  for (std::size_t v = 0; v < before_.size(); ++v)
    farthest = std::max(farthest, squared_norm(positions_[v] - before_[v]));
  return std::sqrt(farthest / std::max(area_, 1e-300));
}

// Sets targets_ so that the pinned vertices reach given_ if they keep their places relative to the clusters.
void ExamplePosing::aim() {
  targets_.clear();
  for (std::size_t k = 0; k < pins_.size(); ++k)
    targets_.push_back(given_[k] - (positions()[pins_[k].vertex] - at_pin(k, positions_)));
}

void ExamplePosing::follow_clusters(std::span<const LogTerm> sum) {
  std::vector<std::uint32_t> pinned;
  for (const PosingPin& pin : pins_) pinned.push_back(pin.vertex);
  space_.follow(sum, positions_, pool_, model_positions_, pinned);
  posed_ = moves_ = positions_;
  aim();
  reach_targets();
  for (std::size_t c = 0; c < moves_.size(); ++c) moves_[c] = positions_[c] - posed_[c];
  for (const auto v : pinned) model_positions_[v] = model_positions_[v] + space_.coarse()->blended(moves_, v);
}

// Moves all vertices of the model with the clusters.
void ExamplePosing::move_model() {
  if (posed_.empty()) return;
  space_.follow(terms(), posed_, pool_, model_positions_, mesh::first_numbers(model_positions_.size()));
  space_.coarse()->move(moves_, nullptr, model_positions_, pool_);
}

// Moves the pins towards the targets. All other vertices of the pinned parts follow.
void ExamplePosing::reach_targets() {
  Eigen::MatrixXd off(pins_.size(), 3);
  for (std::size_t k = 0; k < pins_.size(); ++k)
    off.row(Eigen::Index(k)) = column(targets_[k] - at_pin(k, positions_)).transpose();
  const auto n = static_cast<Eigen::Index>(pins_.size());
  const Eigen::MatrixXd forces =
      Eigen::Map<const MatrixByRows>(forces_.data(), n + static_cast<Eigen::Index>(pinned_parts_.size()), n) *
      off;
  struct Pull {
    const double* column;
    Vec3 force;
  };
  for (std::size_t i = 0; i < pinned_parts_.size(); ++i) {
    std::vector<Pull> pulls;
    for (std::size_t k = 0; k < pins_.size(); ++k)
      if (part_of_pin_[k] == pinned_parts_[i])
        pulls.push_back({columns_[k].data(), vec(forces.row(Eigen::Index(k)).transpose())});
    const Vec3 offset = vec(forces.row(Eigen::Index(pins_.size() + i)).transpose());
    for (const auto v : space_.logs().parts().vertices.of(pinned_parts_[i])) {
      Vec3 place = positions_[v] + offset;
      for (const auto& [column, force] : pulls) place = place + column[v] * force;
      positions_[v] = place;
    }
  }
}

// Translates each part without pins to the part's mean position in the linear blend. Loose vertices get their
// positions in the linear blend.
void ExamplePosing::place_other_parts() {
  const LogSpace& logs = space_.logs();
  const auto straight = [&](std::size_t v) {
    Vec3 place = logs.rest()[v];
    for (std::size_t e = 0; e < examples_.size(); ++e)
      place = place + weights_[e] * examples_[e]->displacements[v];
    return place;
  };
  for (std::uint32_t part = 0; part < logs.parts().count(); ++part) {
    if (std::ranges::binary_search(pinned_parts_, part)) continue;
    const auto vertices = logs.parts().vertices.of(part);
    Vec3 missing{0, 0, 0};
    for (const auto v : vertices) missing = missing + (straight(v) - positions_[v]);
    for (const auto v : vertices)
      positions_[v] = positions_[v] + (1 / static_cast<double>(vertices.size())) * missing;
  }
  for (std::size_t v = 0; v < positions_.size(); ++v)
    if (logs.parts().loose[v]) positions_[v] = straight(v);
}

}  // namespace viete::shapes
