#include "sparse/sparse_matrix.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>

namespace viete::sparse {

SparseMatrix sparse_matrix(std::size_t n, std::span<const MatrixEntry> entries) {
  return sparse_matrix_of(n, [&](const auto& add) {
    for (const auto& [row, column, value] : entries) add(row, column, value);
  });
}

SparseMatrix transposed_sum(const SparseMatrix& matrix) {
  SparseMatrix result;
  result.starts.assign(matrix.starts.size(), 0);
  std::vector<std::uint32_t> last(matrix.size());  // the column in which each row was last seen, plus 1
  const auto for_entries = [&](const auto& visit) {
    std::ranges::fill(last, 0);
    for (std::uint32_t v = 0; v < matrix.size(); ++v)
      for_column(matrix, v, [&](std::uint32_t row, double value) {
        visit(v, row, std::exchange(last[row], v + 1) != v + 1, value);
      });
  };
  for_entries([&](auto, std::uint32_t row, bool is_new, double) { result.starts[row + 1] += is_new; });
  std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());
  std::vector<std::int32_t> next(result.starts.begin(), result.starts.end() - 1);
  result.rows.resize(static_cast<std::size_t>(result.starts.back()));
  result.values.resize(result.rows.size());
  for_entries([&](std::uint32_t v, std::uint32_t row, bool is_new, double value) {
    const auto i = static_cast<std::size_t>(is_new ? next[row]++ : next[row] - 1);
    result.rows[i] = static_cast<std::int32_t>(v);
    result.values[i] = is_new ? value : result.values[i] + value;
  });
  return result;
}

SparseMatrix permuted(const SparseMatrix& matrix, const std::vector<std::uint32_t>& places) {
  return sparse_matrix_of(matrix.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < matrix.size(); ++v)
      for_column(matrix, v, [&](std::uint32_t row, double value) {
        if (row >= v) add(std::max(places[row], places[v]), std::min(places[row], places[v]), value);
      });
  });
}

mesh::UnionFind connected(const SparseMatrix& matrix) {
  mesh::UnionFind parts(matrix.size());
  for (std::uint32_t v = 0; v < matrix.size(); ++v)
    for_column(matrix, v, [&](std::uint32_t row, double) { parts.join(row, v); });
  return parts;
}

SparseMatrix grounded(const SparseMatrix& matrix, const std::vector<bool>& free) {
  SparseMatrix lower;
  lower.rows.reserve(matrix.rows.size());
  lower.values.reserve(matrix.rows.size());
  const auto add = [&](std::uint32_t row, double value) {
    lower.rows.push_back(static_cast<std::int32_t>(row));
    lower.values.push_back(value);
  };
  for (std::uint32_t v = 0; v < free.size(); ++v) {
    if (!free[v]) add(v, 1);
    for_column(matrix, v, [&](std::uint32_t row, double value) {
      if (free[v] && row >= v && free[row]) add(row, value);
    });
    lower.starts.push_back(static_cast<std::int32_t>(lower.rows.size()));
  }
  return lower;
}

namespace {

/// The elimination tree, and the number of entries in each column of the factor. The parent of column c is
/// the first row below c in which column c has an entry.
class Structure {
public:
  Structure(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order, const FactorReport& report)
      : neighbours_(neighbours), order_(std::move(order)), place_(inverted(order_)) {
    grow_tree(report);
    renumber(postorder());
  }

  std::size_t size() const { return order_.size(); }
  std::vector<std::uint32_t> take_order() { return std::move(order_); }
  std::uint32_t parent(std::size_t column) const { return parents_[column]; }
  /// Returns the number of entries of a column below the diagonal.
  std::uint32_t count(std::size_t column) const { return counts_[column]; }

  /// Calls visit(place) for each neighbour of the unknown at place `at`.
  template <class Visit>
  void for_neighbours(std::uint32_t at, const Visit& visit) const {
    for (const auto u : neighbours_.of(order_[at])) visit(place_[u]);
  }

private:
  // Row r of L has entries in these columns before r: the neighbours of r, and the neighbours' ancestors.
  void grow_tree(const FactorReport& report) {
    parents_.assign(size(), no_parent);
    counts_.assign(size(), 0);
    std::vector<std::uint32_t> seen(size());
    for (std::uint32_t row = 0; row < size(); ++row) {
      if (report && row % 1024 == 0) report(0);
      seen[row] = row;
      for_neighbours(row, [&](std::uint32_t at) {
        for (; at < row && seen[at] != row; at = parents_[at]) {
          parents_[at] = std::min(parents_[at], row);
          seen[at] = row;
          ++counts_[at];
        }
      });
    }
  }

  // Returns the new place of each column in a postorder: each subtree is contiguous, and its root is last.
  // The subtree of the root's last child is directly before the root.
  std::vector<std::uint32_t> postorder() const {
    const auto n = static_cast<std::uint32_t>(size());
    std::vector<std::uint32_t> sizes(n + 1, 1), ends(n + 1, n), places(n);  // entry n: a common root
    const auto above = [&](std::uint32_t v) { return std::min(parents_[v], n); };
    for (std::uint32_t v = 0; v < n; ++v) sizes[above(v)] += sizes[v];
    for (auto v = n; v-- > 0;) {
      places[v] = ends[v] = ends[above(v)] - 1;
      ends[above(v)] -= sizes[v];
    }
    return places;
  }

  void renumber(const std::vector<std::uint32_t>& places) {
    const auto order = order_, parents = parents_, counts = counts_;
    for (std::uint32_t v = 0; v < size(); ++v) {
      const auto at = places[v];
      order_[at] = order[v];
      counts_[at] = counts[v];
      parents_[at] = parents[v] == no_parent ? no_parent : places[parents[v]];
    }
    place_ = inverted(order_);
  }

  const mesh::Adjacency& neighbours_;
  std::vector<std::uint32_t> order_, place_, parents_, counts_;
};

// Groups consecutive columns into supernodes if this adds few zeros.
class SupernodeFinder {
public:
  explicit SupernodeFinder(const Structure& structure) : structure_(structure) {}

  std::vector<Supernode> find() {
    for (std::uint32_t c = 0; c < structure_.size(); ++c) {
      nodes_.push_back({c, 1, structure_.count(c), 0, 0});
      entries_.push_back(structure_.count(c));
      while (nodes_.size() > 1 && joined()) {
      }
    }
    return std::move(nodes_);
  }

private:
  bool joined() {
    const Supernode& upper = nodes_.back();
    Supernode& lower = nodes_[nodes_.size() - 2];
    const auto parent = structure_.parent(upper.first - 1);
    if (parent == no_parent || parent >= upper.first + upper.columns) return false;
    const Supernode both{lower.first, lower.columns + upper.columns, upper.below, 0, 0};
    const double entries = entries_[nodes_.size() - 2] + entries_.back();
    const auto all = static_cast<double>(both.entries());
    if (all - entries > share_of_zeros(both.columns) * all) return false;
    lower = both;
    nodes_.pop_back();
    entries_.pop_back();
    entries_.back() = entries;
    return true;
  }

  static double share_of_zeros(std::uint32_t columns) {
    return columns <= 8 ? 0.25 : columns <= 32 ? 0.12 : 0.04;
  }

  const Structure& structure_;
  std::vector<Supernode> nodes_;
  std::vector<double> entries_;  // number of nonzero entries of each supernode
};

void place(SymbolicFactor& f) {
  std::size_t rows = 0;
  for (Supernode& node : f.supernodes) {
    node.rows = rows;
    node.values = f.entries;
    rows += node.below;
    f.entries += node.entries();
  }
  f.rows.resize(rows);
}

void find_tree(const Structure& structure, SymbolicFactor& f) {
  const auto count = static_cast<std::uint32_t>(f.supernodes.size());
  std::vector<std::uint32_t> of_column(structure.size());
  for (std::uint32_t s = 0; s < count; ++s)
    std::fill_n(of_column.begin() + f.supernodes[s].first, f.supernodes[s].columns, s);
  for (const Supernode& node : f.supernodes) {
    const auto parent = structure.parent(node.first + node.columns - 1);
    f.parents.push_back(parent == no_parent ? no_parent : of_column[parent]);
  }
  f.children = mesh::make_adjacency(count, [&](const auto& add) {
    for (std::uint32_t s = 0; s < count; ++s) {
      if (f.parents[s] != no_parent) add(f.parents[s], s);
    }
  });
}

void find_rows(const Structure& structure, const FactorReport& report, SymbolicFactor& f) {
  std::vector<std::uint32_t> seen(structure.size(), no_parent);
  for (std::uint32_t s = 0; s < f.supernodes.size(); ++s) {
    if (report && s % 256 == 0) report(0);
    const Supernode& node = f.supernodes[s];
    const auto end = node.first + node.columns;
    const auto rows = f.rows.begin() + std::ptrdiff_t(node.rows);
    auto next = rows;
    const auto add = [&](std::uint32_t row) {
      if (row >= end && std::exchange(seen[row], s) != s) *next++ = row;
    };
    for (auto c = node.first; c < end; ++c) structure.for_neighbours(c, add);
    for (const auto child : f.children.of(s)) {
      const Supernode& below = f.supernodes[child];
      std::for_each_n(f.rows.begin() + std::ptrdiff_t(below.rows), below.below, add);
    }
    std::sort(rows, next);
  }
}

}  // namespace

mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix) {
  return mesh::make_adjacency(matrix.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < matrix.size(); ++v) {
      for_column(matrix, v, [&](std::uint32_t row, double) {
        if (row > v) {
          add(row, v);
          add(v, row);
        }
      });
    }
  });
}

std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours) {
  const auto n = static_cast<int>(neighbours.starts.size() - 1);
  Eigen::SparseMatrix<double> lower(n, n);
  lower.reserve(n + static_cast<Eigen::Index>(neighbours.items.size() / 2));
  for (int v = 0; v < n; ++v) {
    lower.startVec(v);
    lower.insertBack(v, v) = 1;
    for (const auto u : neighbours.of(static_cast<std::size_t>(v)))
      if (static_cast<int>(u) > v) lower.insertBack(static_cast<int>(u), v) = 1;
  }
  lower.finalize();
  Eigen::AMDOrdering<int>::PermutationType permutation;
  if (n > 0) Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), permutation);
  return {permutation.indices().begin(), permutation.indices().end()};
}

std::vector<std::uint32_t> inverted(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

SymbolicFactor analyse(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order,
                       const FactorReport& report) {
  Structure structure(neighbours, std::move(order), report);
  SymbolicFactor f;
  f.supernodes = SupernodeFinder(structure).find();
  place(f);
  find_tree(structure, f);
  find_rows(structure, report, f);
  f.order = structure.take_order();
  return f;
}

}  // namespace viete::sparse
