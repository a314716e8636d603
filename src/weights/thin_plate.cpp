#include "weights/thin_plate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/memory.h"
#include "sparse/sparse_kernel.h"

namespace viete::weights {

namespace {

constexpr double factored = 0.4;  // fraction of the time that factoring takes
// Conditions for factoring the whole matrix of the problem, see ThinPlate.
constexpr std::size_t most_vertices_per_spring = 32, most_entries_per_vertex = 100;
constexpr double least_precision = 1e-11;  // rounding error of an entry, relative to the weakest spring

using Columns = std::array<double, sparse::solved_columns>;

// Returns for each vertex whether it is in a part with springs and is not the part's fixed vertex.
std::vector<bool> free_vertices(const HeldParts& parts) {
  std::vector<bool> free(parts.of_vertex.size());
  for (std::uint32_t v = 0; v < free.size(); ++v) free[v] = parts.holds(v);
  for (const auto v : parts.grounds) free[v] = false;
  return free;
}

std::vector<double> masses_of_parts(const HeldParts& parts, const std::vector<double>& masses) {
  std::vector<double> sums(parts.grounds.size(), 0);
  for (std::uint32_t v = 0; v < masses.size(); ++v) {
    if (parts.holds(v)) sums[parts.of_vertex[v]] += masses[v];
  }
  return sums;
}

// Returns the lower triangle of L * M^-1 * L + S, with 1 in the diagonal for parts without springs. Returns
// nothing if few vertices have springs, or if the matrix has many entries or large rounding errors.
std::optional<sparse::SparseMatrix> whole_matrix(const IntrinsicLaplacian& laplacian, const HeldParts& parts,
                                                 const std::vector<bool>& has_spring,
                                                 const std::vector<double>& springs) {
  const std::size_t n = has_spring.size();
  if (most_vertices_per_spring * static_cast<std::size_t>(std::ranges::count(has_spring, true)) <= n)
    return {};
  std::vector<sparse::MatrixEntry> entries;
  double largest = 0, weakest = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < n && entries.size() <= most_entries_per_vertex * n; ++v) {
    if (has_spring[v]) weakest = std::min(weakest, springs[v]);
    entries.push_back({v, v, has_spring[v] ? springs[v] : parts.holds(v) ? 0.0 : 1.0});
    for_column(laplacian.stiffness, v, [&](std::uint32_t column, double value) {
      if (value == 0) return;
      const double share = value / laplacian.masses[v];
      largest = std::max(largest, share * value);
      for_column(laplacian.stiffness, v, [&](std::uint32_t row, double other) {
        if (row >= column) entries.push_back({row, column, share * other});
      });
    });
  }
  const bool precise = std::numeric_limits<double>::epsilon() * largest < least_precision * weakest;
  if (!precise || entries.size() > most_entries_per_vertex * n) return {};
  return sparse_matrix(n, entries);
}

}  // namespace

HeldParts held_parts(const sparse::SparseMatrix& stiffness, const std::vector<bool>& has_spring) {
  const auto n = static_cast<std::uint32_t>(stiffness.size());
  mesh::UnionFind sets = connected(stiffness);
  HeldParts parts;
  std::vector<std::uint32_t> part_of_set(n, HeldParts::none);
  for (std::uint32_t v = 0; v < n; ++v) {
    auto& part = part_of_set[sets.find(v)];
    if (!has_spring[v] || part != HeldParts::none) continue;
    part = static_cast<std::uint32_t>(parts.grounds.size());
    parts.grounds.push_back(v);
  }
  for (std::uint32_t v = 0; v < n; ++v) parts.of_vertex.push_back(part_of_set[sets.find(v)]);
  return parts;
}

ThinPlate::ThinPlate(const IntrinsicLaplacian& laplacian, const HeldParts& parts,
                     const std::vector<bool>& has_spring, std::vector<double> springs,
                     std::vector<Load> loads, base::WorkerPool& pool, base::Progress* progress)
    : masses_(laplacian.masses),
      parts_(parts),
      part_masses_(masses_of_parts(parts, masses_)),
      strengths_(std::move(springs)),
      loads_(std::move(loads)),
      solver_([&] {
        const auto whole = whole_matrix(laplacian, parts, has_spring, strengths_);
        whole_ = whole.has_value();
        return sparse::BlockSolver(whole ? *whole : grounded(laplacian.stiffness, free_vertices(parts)), pool,
                                   sparse::told(progress, 0, factored));
      }()) {
  if (whole_) return;
  for (std::uint32_t v = 0; v < has_spring.size(); ++v) {
    if (has_spring[v] && parts_.grounds[parts_.of_vertex[v]] != v) springs_.push_back(v);
  }
  with_springs_ = solver_.part_with(springs_);
  const auto count = static_cast<double>(springs_.size());
  base::require_memory({sizeof(double) * count * (3 * count + 2 * static_cast<double>(loads_.size())),
                        "biharmonic weights of " + std::to_string(loads_.size()) + " cage elements take",
                        "use a coarser cage, or other weights", ""});
  const base::ProgressPart rest(progress, factored, 1);
  find_forces(stiffness_of_springs(pool, progress));
}

// Calls change(vertex, row of the block) for each vertex of a part with springs.
template <class Change>
void ThinPlate::for_rows(std::span<double> block, const Change& change) const {
  double* row = block.data();
  for (const auto v : solver_.order()) {
    if (parts_.holds(v)) change(v, row);
    row += sparse::solved_columns;
  }
}

// Replaces forces, which are 0 outside of `given`, by the displacement w', see ThinPlate. If `wanted` is not
// null, computes w' only for it.
void ThinPlate::bend(std::span<double> block, const sparse::BlockSolver::Part& given,
                     const sparse::BlockSolver::Part* wanted) const {
  const auto& kernel = sparse::sparse_kernel(sym3::kernel());
  solver_.solve(block, kernel, &given);
  std::vector<Columns> means(parts_.grounds.size(), Columns{});
  for (std::uint32_t v = 0; v < masses_.size(); ++v) {
    if (!parts_.holds(v)) continue;
    const auto part = parts_.of_vertex[v];
    const double share = masses_[v] / part_masses_[part], *y = block.data() + solver_.row_of(v);
    for (std::size_t c = 0; c < sparse::solved_columns; ++c) means[part][c] += share * y[c];
  }
  for_rows(block, [&](std::uint32_t v, double* y) {
    const Columns mean = means[parts_.of_vertex[v]];
    const double mass = masses_[v];
    for (std::size_t c = 0; c < sparse::solved_columns; ++c) y[c] = mass * (y[c] - mean[c]);
  });
  for (const auto v : parts_.grounds)
    std::fill_n(block.data() + solver_.row_of(v), sparse::solved_columns, 0.0);
  solver_.solve(block, kernel, nullptr, wanted);
}

// Returns the lower triangle of the matrix K of ThinPlate, by columns.
std::vector<double> ThinPlate::stiffness_of_springs(base::WorkerPool& pool, base::Progress* progress) const {
  const std::size_t count = springs_.size();
  const std::span springs(springs_);
  std::vector<double> stiffness(count * count);
  solver_.for_blocks(count, pool, sparse::told(progress, 0, 1), [&](auto begin, auto end, auto block) {
    for (std::size_t i = begin; i < end; ++i) block[solver_.row_of(springs_[i]) + i - begin] = 1;
    const auto given = solver_.part_with(springs.subspan(begin, end - begin));
    const auto wanted = solver_.part_with(springs.subspan(begin));
    bend(block, given, &wanted);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = begin; j < count; ++j)
        stiffness[i * count + j] = block[solver_.row_of(springs_[j]) + i - begin];
  });
  return stiffness;
}

void ThinPlate::find_forces(std::vector<double> stiffness) {
  const std::size_t count = springs_.size();
  const auto part = [&](std::size_t i) { return parts_.of_vertex[springs_[i]]; };
  for (std::size_t i = 0; i < count; ++i) {
    const double at_ground = 1 / strengths_[parts_.grounds[part(i)]];
    for (std::size_t j = 0; j < count; ++j) {
      if (part(i) == part(j))
        stiffness[i * count + j] += i == j ? at_ground + 1 / strengths_[springs_[i]] : at_ground;
    }
  }
  forces_.resize(loads_.size() * count);
  std::vector<double> target(parts_.of_vertex.size(), 0);
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    for (const auto& [vertex, value] : loads_[l]) target[vertex] = value;
    for (std::size_t i = 0; i < count; ++i)
      forces_[l * count + i] = target[springs_[i]] - target[parts_.grounds[part(i)]];
    for (const auto& [vertex, value] : loads_[l]) target[vertex] = 0;
  }
  const auto n = static_cast<Eigen::Index>(count);
  const Eigen::LLT<Eigen::MatrixXd> factored(Eigen::Map<const Eigen::MatrixXd>(stiffness.data(), n, n));
  if (factored.info() != Eigen::Success) sparse::refuse_system();
  Eigen::Map<Eigen::MatrixXd> forces(forces_.data(), n, static_cast<Eigen::Index>(loads_.size()));
  factored.solveInPlace(forces);
}

void ThinPlate::solve(std::size_t begin, std::size_t end, std::span<double> block) const {
  if (whole_) {
    for (std::size_t l = begin; l < end; ++l)
      for (const auto& [v, value] : loads_[l]) block[solver_.row_of(v) + l - begin] = strengths_[v] * value;
    return solver_.solve(block, sparse::sparse_kernel(sym3::kernel()));
  }
  std::vector<Columns> at_ground(parts_.grounds.size(), Columns{});
  for (std::size_t l = begin; l < end; ++l)
    for (std::size_t i = 0; i < springs_.size(); ++i) {
      const double force = forces_[l * springs_.size() + i];
      block[solver_.row_of(springs_[i]) + l - begin] = force;
      at_ground[parts_.of_vertex[springs_[i]]][l - begin] -= force;
    }
  bend(block, with_springs_);
  for (std::size_t part = 0; part < at_ground.size(); ++part) {
    for (double& force : at_ground[part]) force /= -strengths_[parts_.grounds[part]];
  }
  for (std::size_t l = begin; l < end; ++l)
    for (const auto& [vertex, value] : loads_[l]) {
      const auto part = parts_.of_vertex[vertex];
      if (parts_.grounds[part] == vertex) at_ground[part][l - begin] += value;
    }
  for_rows(block, [&](std::uint32_t v, double* w) {
    const Columns b = at_ground[parts_.of_vertex[v]];
    for (std::size_t c = 0; c < sparse::solved_columns; ++c) w[c] += b[c];
  });
}

}  // namespace viete::weights
