#include "sparse/sparse_cholesky.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "sym3/kernel.h"

namespace viete::sparse {

namespace {

constexpr std::size_t eliminated_at_once = 32, longest_product = 256;
constexpr double step = 4e6;    // approximate multiplications between two reports
constexpr double small = 2e7;   // products with fewer multiplications run on one thread
constexpr double tasks = 64;    // approximate number of tasks; a task eliminates one subtree
constexpr double before = 0.2;  // part of the time that finding the order takes

std::size_t padded(std::size_t rows) {
  return (rows + front_lanes - 1) / front_lanes * front_lanes;
}

std::size_t groups(std::size_t columns) {
  return (columns + column_group - 1) / column_group;
}

// Returns the number of multiplications of a supernode, plus 1000 for its overhead.
double work_of(const Supernode& node) {
  const double b = node.below, m = node.columns + b;
  return (m * m * m - b * b * b) / 6 + b * b / 2 + 1e3;
}

/// Scratch of one thread for one front at a time.
struct Scratch {
  explicit Scratch(std::size_t n) : position(n) {}

  std::vector<std::uint32_t> position;  // position of each row in its front
  std::vector<std::uint32_t> rows;      // rows of a child
  base::AlignedVector<double> panel, right;
  double work = 0;  // work that is not yet reported
};

class Elimination {
public:
  Elimination(const SparseMatrix& matrix, SparseFactor& factor, base::WorkerPool& pool,
              const FactorReport& report, const SparseKernel& kernel)
      : matrix_(matrix),
        factor_(factor),
        pool_(pool),
        report_(report),
        kernel_(kernel),
        updates_(factor.supernodes.size()),
        work_(factor.supernodes.size()) {
    factor.values.resize(factor.entries);
    factor.pivots.resize(factor.size());
    factor.inverse.resize(factor.size());
    for (std::size_t s = 0; s < work_.size(); ++s) {
      const double work = work_of(factor.supernodes[s]);
      work_[s] += work;
      total_ += work;
      if (factor.parents[s] != no_parent) work_[factor.parents[s]] += work_[s];
    }
  }

  void run() {
    const auto roots = task_roots();
    std::atomic<std::size_t> next{0};
    const auto threads = static_cast<std::size_t>(pool_.threads());
    pool_.for_blocks(threads, 1, [&](std::size_t, std::size_t) {
      Scratch scratch(factor_.size());
      for (std::size_t i; (i = next++) < roots.size();) eliminate_subtree(roots[i], scratch);
    });
    shared_ = threads > 1;
    Scratch scratch(factor_.size());
    for (std::uint32_t s = 0; s < work_.size(); ++s) {
      if (work_[s] > largest_task()) eliminate(s, scratch);
    }
  }

private:
  double largest_task() const { return total_ / tasks; }

  // Returns the roots of the subtrees that are tasks, with the most work first.
  std::vector<std::uint32_t> task_roots() const {
    std::vector<std::uint32_t> roots;
    for (std::uint32_t s = 0; s < work_.size(); ++s) {
      const auto parent = factor_.parents[s];
      if (work_[s] <= largest_task() && (parent == no_parent || work_[parent] > largest_task()))
        roots.push_back(s);
    }
    std::ranges::stable_sort(roots, std::greater(), [&](auto s) { return work_[s]; });
    return roots;
  }

  // Eliminates a subtree. The supernodes of a subtree are contiguous, and parents follow their children.
  void eliminate_subtree(std::uint32_t root, Scratch& scratch) {
    auto first = root;
    while (!factor_.children.of(first).empty()) first = factor_.children.of(first).front();
    for (auto s = first; s <= root; ++s) eliminate(s, scratch);
  }

  void tell(double work, Scratch& scratch) {
    scratch.work += work;
    if (scratch.work < step) return;
    const double done = (done_ += std::exchange(scratch.work, 0)) / total_;
    if (report_) report_(std::min(1.0, done));
  }

  void eliminate(std::uint32_t s, Scratch& scratch) {
    const Supernode& node = factor_.supernodes[s];
    const Front panel = assemble(s, scratch);
    eliminate_columns(node, panel, scratch);
    for (std::size_t p = 0; p < node.columns; p += longest_product) {
      const Front left{panel.values + p * panel.stride + padded(node.columns), panel.stride};
      subtract(left, padded(node.below), node.below, std::min(longest_product, node.columns - p),
               factor_.pivots.data() + node.first + p, update_of(s), scratch);
    }
    keep(node, panel);
    tell(1e3, scratch);
  }

  Front update_of(std::uint32_t s) { return {updates_[s].data(), padded(factor_.supernodes[s].below)}; }

  Front assemble(std::uint32_t s, Scratch& scratch) {
    const Supernode& node = factor_.supernodes[s];
    const std::size_t top = padded(node.columns), stride = top + padded(node.below);
    scratch.panel.assign(stride * top, 0.0);
    updates_[s].assign(padded(node.below) * padded(node.below), 0.0);
    const std::uint32_t* rows = factor_.rows.data() + node.rows;
    for (std::uint32_t i = 0; i < node.columns; ++i) scratch.position[node.first + i] = i;
    for (std::uint32_t i = 0; i < node.below; ++i)
      scratch.position[rows[i]] = static_cast<std::uint32_t>(top + i);
    for (std::uint32_t c = 0; c < node.columns; ++c) {
      for_column(matrix_, node.first + c, [&](std::uint32_t row, double value) {
        scratch.panel[c * stride + scratch.position[row]] += value;
      });
    }
    const Front panel{scratch.panel.data(), stride};
    for (const auto child : factor_.children.of(s)) {
      add_child(child, panel, update_of(s), top, scratch);
      base::AlignedVector<double>().swap(updates_[child]);  // frees the memory
    }
    return panel;
  }

  void add_child(std::uint32_t s, const Front& panel, const Front& update, std::size_t top,
                 Scratch& scratch) {
    const Supernode& child = factor_.supernodes[s];
    const Front from = update_of(s);
    scratch.rows.resize(child.below);
    for (std::uint32_t i = 0; i < child.below; ++i)
      scratch.rows[i] = scratch.position[factor_.rows[child.rows + i]];
    for (std::size_t j = 0; j < child.below; ++j) {
      const std::size_t at = scratch.rows[j];
      double* into =
          at < top ? panel.values + at * panel.stride : update.values + (at - top) * update.stride - top;
      const double* column = from.values + j * from.stride;
      for (std::size_t i = j; i < child.below; ++i) into[scratch.rows[i]] += column[i];
    }
    tell(0.5 * child.below * child.below, scratch);
  }

  void eliminate_columns(const Supernode& node, const Front& panel, Scratch& scratch) {
    double* pivots = factor_.pivots.data() + node.first;
    for (std::size_t begin = 0; begin < node.columns; begin += eliminated_at_once) {
      const std::size_t end = std::min<std::size_t>(begin + eliminated_at_once, node.columns);
      kernel_.eliminate(panel, begin, end, pivots);
      const std::size_t rows = panel.stride - begin, columns = end - begin;
      tell(static_cast<double>(columns * columns * rows) / 2, scratch);
      const Front left{panel.values + begin * panel.stride + end, panel.stride};
      const Front into{panel.values + end * panel.stride + end, panel.stride};
      if (end < node.columns)
        subtract(left, panel.stride - end, node.columns - end, columns, pivots + begin, into, scratch);
    }
  }

  // Computes into -= left * D * left^T for the first `columns` columns.
  void subtract(const Front& left, std::size_t rows, std::size_t columns, std::size_t depth,
                const double* pivots, const Front& into, Scratch& scratch) {
    const std::size_t count = groups(columns);
    scratch.right.assign(count * column_group * depth, 0.0);
    for (std::size_t p = 0; p < depth; ++p) {
      const double* column = left.values + p * left.stride;
      for (std::size_t j = 0; j < columns; ++j)
        scratch.right[(j / column_group * depth + p) * column_group + j % column_group] =
            pivots[p] * column[j];
    }
    const ProductJob job{into, left, rows, scratch.right.data(), depth};
    const auto work = [&](std::size_t begin, std::size_t end) {
      return static_cast<double>(column_group * depth * (end - begin)) *
             (static_cast<double>(rows) - 2 * static_cast<double>(begin + end));
    };
    const auto at_once = static_cast<std::size_t>(std::max(1.0, step / work(0, 1)));
    const auto subtract_from = [&](std::size_t g, Scratch& used) {
      const std::size_t end = std::min(g + at_once, count);
      kernel_.subtract_product(job, g, end);
      tell(work(g, end), used);
    };
    if (!shared_ || work(0, count) < small) {
      for (std::size_t g = 0; g < count; g += at_once) subtract_from(g, scratch);
      return;
    }
    std::atomic<std::size_t> next{0};
    pool_.for_blocks(static_cast<std::size_t>(pool_.threads()), 1, [&](std::size_t, std::size_t) {
      Scratch other(0);
      for (std::size_t g; (g = next.fetch_add(at_once)) < count;) subtract_from(g, other);
    });
  }

  void keep(const Supernode& node, const Front& panel) {
    double* value = factor_.values.data() + node.values;
    const std::size_t top = padded(node.columns);
    for (std::size_t begin = 0; begin < node.columns; begin += column_group) {
      const std::size_t end = std::min<std::size_t>(begin + column_group, node.columns);
      const auto take = [&](std::size_t row, std::size_t until) {
        for (std::size_t c = begin; c < until; ++c) *value++ = panel.values[c * panel.stride + row];
      };
      for (std::size_t r = begin + 1; r < node.columns; ++r) take(r, std::min(r, end));
      for (std::size_t r = top; r < top + node.below; ++r) take(r, end);
    }
    for (auto c = node.first; c < node.first + node.columns; ++c) factor_.inverse[c] = 1 / factor_.pivots[c];
  }

  const SparseMatrix& matrix_;  // permuted
  SparseFactor& factor_;
  base::WorkerPool& pool_;
  const FactorReport& report_;
  const SparseKernel& kernel_;
  // The update that each supernode passes to its parent: a lower triangle, for rows below the supernode.
  std::vector<base::AlignedVector<double>> updates_;
  std::vector<double> work_;  // work of each subtree
  double total_ = 0;
  std::atomic<double> done_{0};
  bool shared_ = false;
};

}  // namespace

std::vector<Supernode> SparseFactor::part_above(std::span<const std::uint32_t> unknowns,
                                                std::span<const std::uint32_t> places) const {
  std::vector<bool> seen(supernodes.size());
  for (const auto u : unknowns) {
    const auto above = std::ranges::upper_bound(supernodes, places[u], {}, &Supernode::first);
    auto s = static_cast<std::uint32_t>(above - supernodes.begin() - 1);
    for (; s != no_parent && !seen[s]; s = parents[s]) seen[s] = true;
  }
  std::vector<Supernode> part;
  for (std::size_t s = 0; s < seen.size(); ++s) {
    if (seen[s]) part.push_back(supernodes[s]);
  }
  return part;
}

FactorReport told(base::Progress* progress, double from, double to) {
  if (!progress) return {};
  return [=](double done) { progress->report(std::lerp(from, to, done)); };
}

SparseFactor factor(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report) {
  const mesh::Adjacency neighbours = neighbours_of_unknowns(matrix);
  if (report) report(0);
  FactorReport rest;
  if (report) rest = [&report](double done) { report(std::lerp(before, 1.0, done)); };
  return factor(matrix, neighbours, elimination_order(neighbours), pool, rest);
}

SparseFactor factor(const SparseMatrix& matrix, const mesh::Adjacency& neighbours,
                    std::vector<std::uint32_t> order, base::WorkerPool& pool, const FactorReport& report,
                    const SparseKernel& kernel) {
  SparseFactor result{analyse(neighbours, std::move(order), report), {}, {}, {}};
  if (report) report(0);
  const SparseMatrix lower = permuted(matrix, inverted(result.order));
  if (report) report(0);
  Elimination(lower, result, pool, report, kernel).run();
  return result;
}

namespace {

// If a pivot is less than this fraction of the matrix's diagonal entry, the matrix counts as not positive
// definite. Testing for positive pivots is not sufficient, because rounding can make a zero pivot positive.
constexpr double least_pivot = 1e-14;

[[noreturn]] void refuse_row(std::size_t row) {
  throw base::Error("row " + std::to_string(row), "the system does not determine this unknown",
                    "fix the part of the model that it belongs to");
}

double diagonal(const SparseMatrix& matrix, std::uint32_t row) {
  double sum = 0;
  for_column(matrix, row, [&](std::uint32_t other, double value) { sum += other == row ? value : 0; });
  return sum;
}

void put(const mesh::Vec3& from, double* to) {
  to[0] = from[0];
  to[1] = from[1];
  to[2] = from[2];
  to[3] = 0;
}
mesh::Vec3 vec(const double* from) {
  return {from[0], from[1], from[2]};
}

}  // namespace

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report)
    : factor_(factor(matrix, pool, report)), places_(inverted(factor_.order)) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double pivot = factor_.pivots[i];
    const std::uint32_t row = factor_.order[i];
    if (!(pivot > least_pivot * diagonal(matrix, row) && std::isfinite(pivot))) refuse_row(row);
  }
}

void SparseCholesky::read(std::span<const mesh::Vec3> b, Workspace& work) const {
  work.rows.resize(4 * size());
  for (std::size_t i = 0; i < size(); ++i) put(b[factor_.order[i]], &work.rows[4 * i]);
}

void SparseCholesky::write(const Workspace& work, std::span<mesh::Vec3> x) const {
  for (std::size_t i = 0; i < size(); ++i) x[factor_.order[i]] = vec(&work.rows[4 * i]);
}

void SparseCholesky::solve(std::span<const mesh::Vec3> b, std::span<mesh::Vec3> x, Workspace& work) const {
  const SparseKernel& kernel = sparse_kernel(sym3::kernel());
  read(b, work);
  kernel.forward_four(factor_.view(), work.rows.data());
  kernel.backward_four(factor_.view(), work.rows.data());
  write(work, x);
}

// Uses L^-1 * (b + c) = L^-1 * b + L^-1 * c. The last term is 0 outside of the supernodes of part_above().
void SparseCholesky::solve_corrected(std::span<mesh::Vec3> b, std::span<mesh::Vec3> x,
                                     std::span<const std::uint32_t> some,
                                     const std::function<void()>& correct, Workspace& work) const {
  const SparseKernel& kernel = sparse_kernel(sym3::kernel());
  read(b, work);
  kernel.forward_four(factor_.view(), work.rows.data());
  const auto nodes = factor_.part_above(some, places_);
  work.part.resize(4 * size());
  const TriangularFactor part = factor_.view(nodes);
  const auto for_part = [&](const auto& visit) {
    for (const Supernode& node : nodes)
      for (std::size_t i = 4 * node.first; i < 4 * (node.first + node.columns); ++i) visit(i);
  };
  for_part([&](std::size_t i) { work.part[i] = work.rows[i]; });
  kernel.backward_four(part, work.part.data());
  for (const auto u : some) {
    x[u] = vec(&work.part[4 * places_[u]]);
    b[u] = {0, 0, 0};
  }
  correct();
  for_part([&](std::size_t i) { work.part[i] = 0; });
  for (const auto u : some) put(b[u], &work.part[4 * places_[u]]);
  kernel.forward_four(part, work.part.data());
  for_part([&](std::size_t i) { work.rows[i] += work.part[i]; });
  kernel.backward_four(factor_.view(), work.rows.data());
  write(work, x);
}

void refuse_system() {
  throw base::Error("", "the equations of these weights have no solution in double precision",
                    "choose other weights, or repair the model's triangles");
}

BlockSolver::BlockSolver(const SparseMatrix& matrix, base::WorkerPool& pool, const FactorReport& report)
    : factor_(factor(matrix, pool, report)), places_(inverted(factor_.order)) {
  for (const double pivot : factor_.pivots) {
    if (!(pivot > 0 && std::isfinite(pivot))) refuse_system();
  }
}

// Each thread has one block: making a new block for every act() would take as long as a solve.
void BlockSolver::for_blocks(std::size_t columns, base::WorkerPool& pool, const FactorReport& report,
                             const Act& act) const {
  std::atomic<std::size_t> next{0}, done{0};
  const std::size_t blocks = (columns + solved_columns - 1) / solved_columns;
  pool.for_blocks(
      std::min(blocks, static_cast<std::size_t>(pool.threads())), 1, [&](std::size_t, std::size_t) {
        base::AlignedVector<double> block(unknowns() * solved_columns);
        for (std::size_t i; (i = next++) < blocks;) {
          const std::size_t begin = i * solved_columns, end = std::min(begin + solved_columns, columns);
          std::ranges::fill(block, 0.0);
          act(begin, end, block);
          done += end - begin;
          if (report) report(static_cast<double>(done) / static_cast<double>(columns));
        }
      });
}

void BlockSolver::solve(std::span<double> block, const SparseKernel& kernel, const Part* given,
                        const Part* wanted) const {
  kernel.forward_columns(given ? factor_.view(*given) : factor_.view(), block.data());
  kernel.backward_columns(wanted ? factor_.view(*wanted) : factor_.view(), block.data());
}

BlockSolver::Part BlockSolver::part_with(std::span<const std::uint32_t> unknowns) const {
  return factor_.part_above(unknowns, places_);
}

}  // namespace viete::sparse
