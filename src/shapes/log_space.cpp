#include "shapes/log_space.h"

#include <algorithm>
#include <cmath>

#include "mesh/point_index.h"
#include "mesh/union_find.h"
#include "shapes/plane_kernel.h"
#include "sym3/kernel.h"
#include "sym3/polar.h"
#include "weights/laplacian.h"

namespace viete::shapes {

namespace {

constexpr std::uint32_t no_part = 0xFFFFFFFF;
constexpr std::size_t places_per_block = 1024;

}  // namespace

Vec3 summed(std::span<const LogTerm> terms, std::vector<Vec3> LogVector::*member, std::size_t i) {
  Vec3 sum{0, 0, 0};
  for (const auto& [vector, factor] : terms) {
    const auto& of = vector->*member;
    if (i < of.size()) sum = sum + factor * of[i];
  }
  return sum;
}

// The maps of a block of triangles, see PlaneKernel.
class LogSpace::Block {
public:
  static constexpr std::size_t size = plane_size;

  Block(const LogSpace& space, const Work& work, std::span<const LogTerm> terms)
      : space_(space), work_(work), terms_(terms), kernel_(plane_kernel(sym3::kernel())) {}

  // Computes the pulls of `count` triangles, beginning with triangles_[first]. A triangle has one pull for
  // each of its sides. The equations' right-hand side contains the pull at the first end of the side, and the
  // negative pull at the second end.
  void pull_by_logs(std::size_t first, std::size_t count) {
    sides_ = space_.sides_of(first);
    next_sides_ = sides_ + 12;
    pull_by_logs_of(count, [first](std::size_t i) { return first + i; });
  }
  // Does the same for a list of indices into triangles_.
  void pull_by_logs(std::span<const std::uint32_t> places) {
    const auto at = [places](std::size_t i) { return places[i]; };
    gather(places.size(), at);
    sides_ = next_sides_ = gathered_;
    pull_by_logs_of(places.size(), at);
  }

  // Computes the pulls for the rotations that best fit the displacements. Call pull_by_logs() for these
  // triangles first. The best rotation is nearest to the matrix sum_k c_k * e'_k * (S * e_k)^T. e_k are the
  // sides at rest, e'_k the displaced sides, c_k the half cotangents, and S is the stretch.
  template <class At>
  void pull_by_fit(std::size_t count, const At& at) {
    // A line does not determine a rotation: a coupling takes the rotation of the triangle beside it.
    const auto fitted = [&](std::size_t i) { return space_.index_of_[space_.triangles_[at(i)]]; };
    const Plane* sides = sides_;
    if (fitted(count - 1) != at(count - 1)) {
      gather(count, fitted);
      sides = gathered_;
    }
    for (std::size_t k = 0; k < 3; ++k) read_posed_side(count, fitted, sides, k);
    kernel_.spread(posed_, sides, sides + 9, maps_);
    kernel_.times_symmetric(maps_, stretches_, rotations_);
    const sym3::MatView<double> rotations(rotations_[0], plane_stride);
    sym3::polar(rotations, rotations, count);
    kernel_.times_symmetric(rotations_, stretches_, maps_);
    kernel_.pull(maps_, sides_, sides_ + 9, fitted_);
  }

  Vec3 pulled(std::size_t triangle, std::size_t side) const { return of(pulls_, triangle, side); }
  // Returns the change of a pull that the fitted rotation causes.
  Vec3 fit(std::size_t triangle, std::size_t side) const {
    return of(fitted_, triangle, side) - of(pulls_, triangle, side);
  }

private:
  template <class At>
  void pull_by_logs_of(std::size_t count, const At& at) {
    if (count < size) fill_up();
    sum_logs(count, at);
    kernel_.map(logs_, work_.turned.size() == 1 ? work_.turned[0].data() : nullptr, next_sides_, stretches_,
                maps_);
    if (work_.turned.size() > 1) turn(count, at);
    kernel_.pull(maps_, sides_, sides_ + 9, pulls_);
  }

  static Vec3 of(const Plane* pulls, std::size_t triangle, std::size_t side) {
    return {pulls[3 * side][triangle], pulls[3 * side + 1][triangle], pulls[3 * side + 2][triangle]};
  }

  // Sets all lanes to 0, so that lanes without triangles have finite numbers.
  void fill_up() {
    for (Plane* planes : {logs_, rotations_, posed_}) std::fill_n(planes[0], 9 * plane_stride, 0.0);
    std::fill_n(stretches_[0], 6 * plane_stride, 0.0);
  }

  template <class At>
  void gather(std::size_t count, const At& at) {
    if (count < size) std::fill_n(gathered_[0], 12 * plane_stride, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const Plane* of = space_.sides_of(at(i));
      for (std::size_t n = 0; n < 12; ++n) gathered_[n][i] = of[n][at(i) % size];
    }
  }

  template <class At>
  void read_posed_side(std::size_t count, const At& at, const Plane* sides, std::size_t k) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto& corners = space_.placed_[at(i)];
      const Vec3 change =
          work_.displacements[corners[(k + 1) % 3]] - work_.displacements[corners[(k + 2) % 3]];
      for (std::size_t j = 0; j < 3; ++j) posed_[3 * k + j][i] = sides[3 * k + j][i] + change[j];
    }
  }

  // Adds the sum of factor * logs over all terms to `sums`, for consecutive triangles.
  void add_logs(std::uint32_t first, std::size_t count, double* sums) const {
    constexpr std::size_t at_once = 8;
    ScaledRows rows[at_once];
    for (std::size_t begin = 0; begin < terms_.size(); begin += at_once) {
      const auto some = terms_.subspan(begin, std::min(at_once, terms_.size() - begin));
      for (std::size_t k = 0; k < some.size(); ++k)
        rows[k] = {some[k].vector->logs[first].data(), some[k].factor};
      kernel_.add_rows(rows, some.size(), 9 * count, sums);
    }
  }

  template <class At>
  void sum_logs(std::size_t count, const At& at) {
    std::array<double, 9> sums[size] = {};
    const auto triangle = [&](std::size_t i) { return space_.triangles_[at(i)]; };
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      const auto first = triangle(begin);
      while (end < count && triangle(end) - first == end - begin) ++end;
      add_logs(first, end - begin, sums[begin].data());
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 9; ++k) logs_[k][i] = sums[i][k];
  }

  template <class At>
  void turn(std::size_t count, const At& at) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto part = space_.part_of_[at(i)];
      if (work_.wholes[part] == Vec3{0, 0, 0}) continue;
      const sym3::Mat3<double>& r = work_.turned[part];
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = maps_[k][i], y = maps_[3 + k][i], z = maps_[6 + k][i];
        for (std::size_t j = 0; j < 3; ++j)
          maps_[3 * j + k][i] = r[3 * j] * x + r[3 * j + 1] * y + r[3 * j + 2] * z;
      }
    }
  }

  const LogSpace& space_;
  const Work& work_;
  std::span<const LogTerm> terms_;
  const PlaneKernel& kernel_;
  const Plane *sides_ = nullptr, *next_sides_ = nullptr;
  alignas(64) Plane logs_[9], stretches_[6], rotations_[9], posed_[9], maps_[9], gathered_[12];
  alignas(64) Plane pulls_[9], fitted_[9];
};

LogSpace::LogSpace(const Mesh& mesh, base::WorkerPool& pool, base::Progress* progress)
    : rest_(mesh.positions.begin(), mesh.positions.end()),
      part_count_(mesh.part_count),
      places_(mesh::lowest_in_place(rest_)),
      factors_(add_triangles(mesh), pool, sparse::told(progress, 0, 1)) {}

// Fills the data of triangles. Returns the stiffness matrix of places_, with one fixed place per part.
sparse::SparseMatrix LogSpace::add_triangles(const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  index_of_.resize(count);
  corners_.reserve(count);
  triangles_.reserve(count);
  part_of_.reserve(count);
  placed_.reserve(count);
  cotangents_.reserve(count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.degenerate[t]) continue;
    const auto& [a, b, c] = corners_.emplace_back(mesh.triangles[t]);
    index_of_[t] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    part_of_.push_back(mesh.parts[t]);
    placed_.push_back({places_[a], places_[b], places_[c]});
    cotangents_.push_back(weights::half_cotangents(rest_[a], rest_[b], rest_[c]));
  }
  const std::vector<weights::Coupling> couplings = add_couplings(mesh.couplings);
  fill_sides();
  around_ = mesh::make_adjacency(rest_.size(), [&](const auto& add) {
    for (std::uint32_t i = 0; i < placed_.size(); ++i)
      for (std::uint32_t k = 0; k < 3; ++k) add(placed_[i][k], 3 * i + k);
  });
  const sparse::SparseMatrix stiffness = with_couplings(weights::stiffness_matrix(rest_, placed_), couplings);
  find_parts(connected(stiffness));
  add_masses();
  std::vector<bool> free(rest_.size());
  for (std::uint32_t v = 0; v < rest_.size(); ++v) free[v] = !parts_.loose[v] && places_[v] == v;
  for (const auto v : grounded_) free[v] = false;
  return grounded(stiffness, free);
}

// Adds the couplings of different parts as triangles. Returns them, between places.
std::vector<weights::Coupling> LogSpace::add_couplings(std::span<const weights::Coupling> couplings) {
  std::vector<weights::Coupling> added;
  if (couplings.empty()) return added;
  auto parts = mesh::parts_by_triangles(rest_.size(), placed_);
  std::vector<std::uint32_t> beside(rest_.size(), mesh::none);
  for (std::uint32_t i = 0; i < placed_.size(); ++i)
    for (const auto v : placed_[i]) beside[v] = i;
  for (const weights::Coupling& coupling : couplings) {
    const auto a = places_[coupling.vertex], b = places_[coupling.triangle[0]], i = beside[a];
    if (i == mesh::none || beside[b] == mesh::none || parts.find(a) == parts.find(b)) continue;
    added.push_back({a, {b, b, b}, {1, 0, 0}, coupling.strength});
    triangles_.push_back(triangles_[i]);
    part_of_.push_back(part_of_[i]);
    corners_.push_back({a, b, b});
    placed_.push_back({a, b, b});
    cotangents_.push_back({0, 0, coupling.strength});
  }
  return added;
}

void LogSpace::add_masses() {
  parts_.masses.assign(rest_.size(), 0);
  const double unit = mesh::bounds(rest_).diagonal();
  for (const auto& t : corners_) {
    const Vec3 across =
        cross((1 / unit) * (rest_[t[1]] - rest_[t[0]]), (1 / unit) * (rest_[t[2]] - rest_[t[0]]));
    for (const auto v : t) parts_.masses[v] += norm(across);
  }
}

void LogSpace::fill_sides() {
  sides_.resize((corners_.size() / plane_size + 2) * 12 * plane_stride);
  std::ranges::fill(sides_, 0.0);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    Plane* planes = reinterpret_cast<Plane*>(sides_.data()) + i / plane_size * 12;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = rest_[corners_[i][(k + 1) % 3]] - rest_[corners_[i][(k + 2) % 3]];
      for (std::size_t j = 0; j < 3; ++j) planes[3 * k + j][i % plane_size] = side[j];
      planes[9 + k][i % plane_size] = cotangents_[i][k];
    }
  }
}

void LogSpace::find_parts(mesh::UnionFind sets) {
  std::vector<std::uint32_t> part_of_set(rest_.size(), no_part), part_of(rest_.size(), no_part);
  std::uint32_t count = 0;
  parts_.loose.resize(rest_.size());
  for (std::uint32_t v = 0; v < rest_.size(); ++v) {
    if (places_[v] != v) copies_.push_back(v);
    parts_.loose[v] = around_.of(places_[v]).empty();
    if (parts_.loose[v]) continue;
    std::uint32_t& part = part_of_set[sets.find(places_[v])];
    if (part == no_part) {
      part = count++;
      grounded_.push_back(v);
    }
    part_of[v] = part;
  }
  parts_.vertices = mesh::make_adjacency(count, [&](const auto& add) {
    for (std::uint32_t v = 0; v < rest_.size(); ++v)
      if (!parts_.loose[v]) add(part_of[v], v);
  });
}

LogVector LogSpace::at_rest() const {
  LogVector vector;
  vector.logs.resize(index_of_.size());
  vector.leftovers.resize(rest_.size());
  vector.displacements.resize(rest_.size());
  vector.wholes.resize(part_count_);
  return vector;
}

void LogSpace::turn_by(std::span<const LogTerm> terms, const Vec3* whole, Work& work) const {
  work.right.resize(rest_.size());
  work.displacements.resize(rest_.size());
  work.wholes.resize(part_count_);
  work.turned.clear();
  for (std::size_t part = 0; part < part_count_; ++part)
    work.wholes[part] = whole ? *whole : summed(terms, &LogVector::wholes, part);
  const auto turns = [](const Vec3& w) { return w != Vec3{0, 0, 0}; };
  if (std::ranges::any_of(work.wholes, turns))
    for (const Vec3& w : work.wholes) work.turned.push_back(sym3::exp_rotation(w));
}

void LogSpace::follow(std::span<const LogTerm> terms, base::WorkerPool& pool, Work& work,
                      const Vec3* whole) const {
  turn_by(terms, whole, work);
  load(terms, 0, pool, work);
  sum_doubts(terms, work);
  if (work.doubtful.empty()) return solve(work);
  work.doubted.clear();
  for (const auto i : work.doubtful)
    work.doubted.insert(work.doubted.end(), placed_[i].begin(), placed_[i].end());
  ground(work);
  factors_.solve_corrected(
      work.right, work.displacements, work.doubted,
      [&] {
        fit_doubtful(terms, work);
        ground(work);
      },
      work.solve);
  spread_places(work);
}

void LogSpace::follow_fitted(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work,
                             const Vec3* whole) const {
  turn_by(terms, whole, work);
  load(terms, share, pool, work);
  solve(work);
}

// Computes work.right. If `share` is positive, moves rotations by this factor towards fitted rotations.
void LogSpace::load(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work) const {
  add_pulls(
      [&](std::size_t first, std::size_t count, const auto& take) {
        Block block(*this, work, terms);
        block.pull_by_logs(first, count);
        if (share == 0) return take([&](std::size_t i, std::size_t k) { return block.pulled(i, k); });
        block.pull_by_fit(count, [first](std::size_t i) { return first + i; });
        take([&](std::size_t i, std::size_t k) { return block.pulled(i, k) + share * block.fit(i, k); });
      },
      pool, work);
}

template <class Pull>
void LogSpace::add_pulls_of(std::size_t i, const Pull& pull, std::span<Vec3> right) const {
  const Vec3 p0 = pull(0), p1 = pull(1), p2 = pull(2);
  Vec3 &a = right[placed_[i][0]], &b = right[placed_[i][1]], &c = right[placed_[i][2]];
  a = (a - p1) + p2;
  b = (b + p0) - p2;
  c = (c - p0) + p1;
}

// Sums the pulls at each place in a fixed order, so that results do not depend on the number of threads.
template <class Make>
void LogSpace::add_pulls(const Make& make, base::WorkerPool& pool, Work& work) const {
  work.pulls.resize(3 * triangles_.size());
  pool.for_blocks(triangles_.size(), Block::size, [&](std::size_t begin, std::size_t end) {
    make(begin, end - begin, [&](const auto& pull) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t k = 0; k < 3; ++k) work.pulls[3 * i + k] = pull(i - begin, k);
    });
  });
  pool.for_blocks(rest_.size(), places_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) work.right[v] = pulled(work.pulls, v);
  });
}

Vec3 LogSpace::pulled(std::span<const Vec3> pulls, std::size_t place) const {
  Vec3 sum{0, 0, 0};
  for (const std::uint32_t corner : around_.of(place)) {
    const Vec3* of = pulls.data() + corner / 3 * 3;
    switch (corner % 3) {
      case 0: sum = (sum - of[1]) + of[2]; break;
      case 1: sum = (sum + of[0]) - of[2]; break;
      default: sum = (sum - of[0]) + of[1];
    }
  }
  return sum;
}

void LogSpace::solve(Work& work) const {
  ground(work);
  factors_.solve(work.right, work.displacements, work.solve);
  spread_places(work);
}

void LogSpace::ground(Work& work) const {
  for (const auto v : grounded_) work.right[v] = {0, 0, 0};
}

void LogSpace::spread_places(Work& work) const {
  for (const auto v : copies_) work.displacements[v] = work.displacements[places_[v]];
}

// Moves rotations of doubtful triangles towards fitted rotations: adds changes of pulls to work.right.
void LogSpace::fit_doubtful(std::span<const LogTerm> terms, Work& work) const {
  Block block(*this, work, terms);
  for (std::size_t first = 0; first < work.doubtful.size(); first += Block::size) {
    const std::size_t count = std::min(Block::size, work.doubtful.size() - first);
    const auto places = std::span(work.doubtful).subspan(first, count);
    const auto at = [places](std::size_t i) { return places[i]; };
    block.pull_by_logs(places);
    block.pull_by_fit(count, at);
    for (std::size_t i = 0; i < count; ++i) {
      const double share = std::min(1.0, work.doubts[at(i)]);
      add_pulls_of(
          at(i), [&](std::size_t k) { return share * block.fit(i, k); }, work.right);
    }
  }
}

void LogSpace::sum_doubts(std::span<const LogTerm> terms, Work& work) const {
  for (const auto i : work.doubtful) work.doubts[i] = 0;
  work.doubtful.clear();
  work.doubts.resize(triangles_.size());
  for (const auto& [vector, factor] : terms) {
    if (factor == 0) continue;
    for (const auto& [triangle, share] : vector->doubts) {
      const std::uint32_t i = index_of_[triangle];
      if (work.doubts[i] == 0) work.doubtful.push_back(i);
      work.doubts[i] += std::abs(factor) * share;
    }
  }
  std::ranges::sort(work.doubtful);
}

void LogSpace::complete(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                        LogVector& vector) const {
  const LogTerm term{&vector, 1};
  Work work;
  vector.displacements.resize(rest_.size());
  vector.leftovers.resize(rest_.size());
  follow({&term, 1}, pool, work);
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    vector.displacements[v] = positions[v] - rest_[v];
    vector.leftovers[v] = vector.displacements[v] - work.displacements[v];
  }
  center(parts_, vector.leftovers);  // anchors determine the translations
}

void LogSpace::linear(std::span<const LogTerm> terms, std::span<mesh::Point> positions) const {
  for (std::size_t v = 0; v < rest_.size(); ++v)
    positions[v] = rest_[v] + summed(terms, &LogVector::displacements, v);
}

void LogSpace::shape(std::span<const LogTerm> terms, const AnchorWeights& anchors, base::WorkerPool& pool,
                     Work& work, std::span<mesh::Point> positions) const {
  follow(terms, pool, work);
  work.straight.resize(rest_.size());
  pool.for_blocks(rest_.size(), places_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      work.straight[v] = summed(terms, &LogVector::displacements, v);
      work.displacements[v] = parts_.loose[v]
                                  ? work.straight[v]
                                  : work.displacements[v] + summed(terms, &LogVector::leftovers, v);
    }
  });
  keep_anchors(parts_, anchors, work.straight, work.displacements);
  for (std::size_t v = 0; v < rest_.size(); ++v) positions[v] = work.displacements[v] + rest_[v];
}

AnchorWeights LogSpace::anchors_from(const LogVector& from, std::span<const LogTerm> terms) const {
  std::vector<Vec3> displacements(rest_.size());
  std::vector<double> squares(rest_.size());
  for (std::size_t v = 0; v < displacements.size(); ++v) {
    displacements[v] = summed(terms, &LogVector::displacements, v);
    for (const auto& [vector, factor] : terms)
      squares[v] += std::abs(factor) * squared_norm(vector->displacements[v]);
  }
  return anchors_along(from, displacements, squares);
}

AnchorWeights LogSpace::anchors_between(const LogVector& from, const LogVector& to) const {
  std::vector<Vec3> displacements(rest_.size());
  std::vector<double> squares(rest_.size());
  for (std::size_t v = 0; v < rest_.size(); ++v) {
    displacements[v] = to.displacements[v] - from.displacements[v];
    squares[v] = squared_norm(displacements[v]);
  }
  return anchors_along(from, displacements, squares);
}

AnchorWeights LogSpace::anchors_along(const LogVector& from, std::span<const Vec3> displacements,
                                      std::span<const double> squares) const {
  std::vector<mesh::Point> start(rest_.size());
  const LogTerm whole{&from, 1};
  linear({&whole, 1}, start);
  return anchor_weights(parts_, start, displacements, squares);
}

}  // namespace viete::shapes
