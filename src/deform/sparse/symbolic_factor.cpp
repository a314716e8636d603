#include "deform/sparse/symbolic_factor.h"

#include <algorithm>
#include <utility>

namespace viete::deform {

namespace {

/// Which columns have entries in which rows: parents in the elimination tree, a column's first row below.
class Structure {
public:
  Structure(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order, const FactorReport& report)
      : neighbours_(neighbours), report_(report), order_(std::move(order)), place_(inverted(order_)) {
    find_parents();
    renumber(postorder());
    count_rows();
  }

  std::size_t size() const { return order_.size(); }
  std::vector<std::uint32_t> take_order() { return std::move(order_); }
  std::uint32_t parent(std::size_t column) const { return parents_[column]; }
  /// Of a column, below its diagonal.
  std::uint32_t count(std::size_t column) const { return counts_[column]; }

  /// visit(place) of the neighbours of what is in this place.
  template <class Visit>
  void for_neighbours(std::uint32_t at, const Visit& visit) const {
    for (const auto u : neighbours_.of(order_[at])) visit(place_[u]);
  }

private:
  void tell(std::uint32_t at) const {
    if (report_ && at % 1024 == 0) report_(0);
  }

  // With shortcuts to ancestors.
  void find_parents() {
    parents_.assign(size(), no_parent);
    std::vector<std::uint32_t> ancestors(size(), no_parent);
    for (std::uint32_t row = 0; row < size(); ++row) {
      tell(row);
      for_neighbours(row, [&](std::uint32_t at) {
        while (at < row && at != no_parent) {
          const auto next = std::exchange(ancestors[at], row);
          if (next == no_parent) parents_[at] = row;
          at = next;
        }
      });
    }
  }

  std::vector<std::uint32_t> postorder() const {
    std::vector<std::uint32_t> child(size(), no_parent), sibling(size(), no_parent), result, path;
    result.reserve(size());
    for (auto v = static_cast<std::uint32_t>(size()); v-- > 0;) {
      if (parents_[v] != no_parent) sibling[v] = std::exchange(child[parents_[v]], v);
    }
    for (std::uint32_t root = 0; root < size(); ++root) {
      if (parents_[root] != no_parent) continue;
      path.push_back(root);
      while (!path.empty()) {
        const auto next = std::exchange(child[path.back()], no_parent);
        if (next != no_parent) {
          path.push_back(next);
          child[path[path.size() - 2]] = sibling[next];
        } else {
          result.push_back(path.back()), path.pop_back();
        }
      }
    }
    return result;
  }

  void renumber(const std::vector<std::uint32_t>& sequence) {
    const auto number = inverted(sequence);
    std::vector<std::uint32_t> order, parents;
    for (const auto v : sequence) {
      order.push_back(order_[v]);
      parents.push_back(parents_[v] == no_parent ? no_parent : number[parents_[v]]);
    }
    order_ = std::move(order), parents_ = std::move(parents);
    place_ = inverted(order_);
  }

  // A row has entries in what is between its neighbours and itself in the tree.
  void count_rows() {
    counts_.assign(size(), 0);
    std::vector<std::uint32_t> seen(size(), no_parent);
    for (std::uint32_t row = 0; row < size(); ++row) {
      tell(row);
      seen[row] = row;
      for_neighbours(row, [&](std::uint32_t at) {
        for (; at < row && seen[at] != row; at = parents_[at]) seen[at] = row, ++counts_[at];
      });
    }
  }

  const mesh::Adjacency& neighbours_;
  const FactorReport& report_;
  std::vector<std::uint32_t> order_, place_, parents_, counts_;
};

// Columns one after the other that are worth a dense block together: the zeros that this adds are few.
class SupernodeFinder {
public:
  explicit SupernodeFinder(const Structure& structure) : structure_(structure) {}

  std::vector<Supernode> find() {
    for (std::uint32_t c = 0; c < structure_.size(); ++c) {
      found_.push_back({{c, 1, structure_.count(c), 0, 0}, 1.0 * structure_.count(c)});
      while (found_.size() > 1 && joined()) {
      }
    }
    std::vector<Supernode> supernodes;
    for (const auto& [node, entries] : found_) supernodes.push_back(node);
    return supernodes;
  }

private:
  struct Found {
    Supernode node;
    double entries;  // that are not 0
  };

  bool joined() {
    Found& upper = found_.back();
    Found& lower = found_[found_.size() - 2];
    const auto parent = structure_.parent(upper.node.first - 1);
    if (parent == no_parent || parent >= upper.node.first + upper.node.columns) return false;
    const Supernode both{lower.node.first, lower.node.columns + upper.node.columns, upper.node.below, 0, 0};
    const double entries = lower.entries + upper.entries, all = static_cast<double>(both.entries());
    if (all - entries > share_of_zeros(both.columns) * all) return false;
    lower = {both, entries};
    found_.pop_back();
    return true;
  }

  static double share_of_zeros(std::uint32_t columns) {
    return columns <= 8 ? 0.25 : columns <= 32 ? 0.12 : 0.04;
  }

  const Structure& structure_;
  std::vector<Found> found_;
};

class Analysis {
public:
  Analysis(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order, const FactorReport& report)
      : structure_(neighbours, std::move(order), report), report_(report) {
    factor_.supernodes = SupernodeFinder(structure_).find();
    find_tree();
    place_values();
    find_rows();
  }

  SymbolicFactor take() {
    factor_.order = structure_.take_order();
    return std::move(factor_);
  }

private:
  void find_tree() {
    const auto count = static_cast<std::uint32_t>(factor_.supernodes.size());
    std::vector<std::uint32_t> of_column(structure_.size());
    for (std::uint32_t s = 0; s < count; ++s)
      std::fill_n(of_column.begin() + factor_.supernodes[s].first, factor_.supernodes[s].columns, s);
    auto& parents = factor_.parents;
    for (const Supernode& node : factor_.supernodes) {
      const auto parent = structure_.parent(node.first + node.columns - 1);
      parents.push_back(parent == no_parent ? no_parent : of_column[parent]);
    }
    factor_.children = mesh::make_adjacency(count, [&](const auto& add) {
      for (std::uint32_t s = 0; s < count; ++s) {
        if (parents[s] != no_parent) add(parents[s], s);
      }
    });
  }

  void place_values() {
    std::size_t rows = 0;
    for (Supernode& node : factor_.supernodes) {
      node.rows = rows, node.values = factor_.entries;
      rows += node.below, factor_.entries += node.entries();
    }
    factor_.rows.resize(rows);
  }

  void find_rows() {
    std::vector<std::uint32_t> seen(structure_.size(), no_parent), rows;
    for (std::uint32_t s = 0; s < factor_.supernodes.size(); ++s) {
      if (report_ && s % 256 == 0) report_(0);
      const Supernode& node = factor_.supernodes[s];
      const auto end = node.first + node.columns;
      rows.clear();
      const auto add = [&](std::uint32_t row) {
        if (row >= end && std::exchange(seen[row], s) != s) rows.push_back(row);
      };
      for (auto c = node.first; c < end; ++c) structure_.for_neighbours(c, add);
      for (const auto child : factor_.children.of(s)) {
        const Supernode& below = factor_.supernodes[child];
        std::for_each_n(factor_.rows.begin() + std::ptrdiff_t(below.rows), below.below, add);
      }
      std::ranges::sort(rows);
      std::ranges::copy(rows, factor_.rows.begin() + std::ptrdiff_t(node.rows));
    }
  }

  Structure structure_;
  const FactorReport& report_;
  SymbolicFactor factor_;
};

}  // namespace

std::vector<std::uint32_t> inverted(const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

SymbolicFactor analyse(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order,
                       const FactorReport& report) {
  return Analysis(neighbours, std::move(order), report).take();
}

}  // namespace viete::deform
