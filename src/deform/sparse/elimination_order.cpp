#include "deform/sparse/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

namespace viete::deform {

namespace {

constexpr double larger_side = 0.75;    // of a piece, at most, where a separator begins
constexpr double balanced_side = 0.52;  // up to which it may grow further
constexpr double worst_separator = 0.2;
constexpr int passes = 6;

enum Side : std::uint8_t { first_side, second_side, separator };

/// A part of the graph that is still to be ordered, with numbers of its own.
struct Piece {
  std::vector<std::uint32_t> unknowns;
  mesh::Adjacency neighbours;
  std::size_t place = 0;  ///< in the order, of the first of them

  std::size_t size() const { return unknowns.size(); }
};

void order_by_degree(const Piece& piece, std::uint32_t* order) {
  const auto n = static_cast<int>(piece.size());
  std::vector<int> starts{0}, rows;
  rows.reserve(piece.size() + piece.neighbours.items.size());
  for (int v = 0; v < n; ++v) {
    rows.push_back(v);
    for (const auto u : piece.neighbours.of(static_cast<std::size_t>(v))) rows.push_back(static_cast<int>(u));
    std::sort(rows.begin() + starts.back(), rows.end());
    starts.push_back(static_cast<int>(rows.size()));
  }
  const std::vector<double> values(rows.size(), 1.0);
  using Sparse = Eigen::SparseMatrix<double>;
  const Eigen::Map<const Sparse> view(n, n, starts.back(), starts.data(), rows.data(), values.data());
  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(view.selfadjointView<Eigen::Lower>(), permutation);
  for (int i = 0; i < n; ++i) order[i] = piece.unknowns[static_cast<std::size_t>(permutation.indices()[i])];
}

/// Unknowns by their distance from one of them, in edges.
class Distances {
public:
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();

  Distances(const mesh::Adjacency& graph, std::uint32_t from) : of_(graph.starts.size() - 1, none) {
    grow(graph, from);
  }
  /// Also what hangs together with `from`, which is not reached yet.
  void grow(const mesh::Adjacency& graph, std::uint32_t from) {
    std::size_t next = reached_.size();
    of_[from] = 0, reached_.push_back(from);
    for (; next < reached_.size(); ++next) {
      for (const auto u : graph.of(reached_[next])) {
        if (of_[u] == none) of_[u] = of_[reached_[next]] + 1, reached_.push_back(u);
      }
    }
  }

  std::uint32_t operator[](std::size_t unknown) const { return of_[unknown]; }
  std::uint32_t farthest() const { return reached_.back(); }
  /// In this order.
  const std::vector<std::uint32_t>& reached() const { return reached_; }

private:
  std::vector<std::uint32_t> of_, reached_;
};

/// Those of a label, in the given sequence, which becomes that of their numbers.
template <class Label>
Piece extracted(const Piece& piece, std::span<const std::uint32_t> sequence, const std::vector<Label>& labels,
                Label label) {
  Piece part;
  std::vector<std::uint32_t> number(piece.size());
  for (const auto v : sequence) {
    if (labels[v] != label) continue;
    number[v] = static_cast<std::uint32_t>(part.unknowns.size());
    part.unknowns.push_back(piece.unknowns[v]);
  }
  auto& [starts, items] = part.neighbours;
  starts.push_back(0);
  for (const auto v : sequence) {
    if (labels[v] != label) continue;
    for (const auto u : piece.neighbours.of(v)) {
      if (labels[u] == label) items.push_back(number[u]);
    }
    starts.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return part;
}

/// Where to cut levels in two: the separator are those of a level below it with a neighbour at or above it.
struct Cut {
  std::uint32_t level = 0;
  double cost = std::numeric_limits<double>::infinity();
};

// Few in the separator, and sides alike.
Cut best_cut(const mesh::Adjacency& graph, const std::vector<std::uint32_t>& levels) {
  const std::size_t end = 2 + *std::ranges::max_element(levels);
  std::vector<std::int64_t> below(end, 0), cut(end, 0);
  for (std::size_t v = 0; v < levels.size(); ++v) {
    std::uint32_t highest = levels[v];
    for (const auto u : graph.of(v)) highest = std::max(highest, levels[u]);
    ++below[levels[v] + 1], ++cut[levels[v] + 1];
    --cut[highest + 1];
  }
  Cut best;
  const auto n = static_cast<double>(levels.size());
  for (std::size_t l = 1; l + 1 < end; ++l) {
    below[l] += below[l - 1], cut[l] += cut[l - 1];
    const auto under = static_cast<double>(below[l]), cuts = static_cast<double>(cut[l]);
    const double larger = std::max(under - cuts, n - under) / n;
    const double cost = cuts * (1 + 0.4 * (larger - 0.5));
    if (larger <= larger_side && cost < best.cost) best = {static_cast<std::uint32_t>(l), cost};
  }
  return best;
}

/// Moves unknowns out of the separator to a side, which takes their neighbours of the other side into it: the
/// best move first, worse ones on the way to better ones, and back to the best that was seen.
class Refinement {
public:
  Refinement(const mesh::Adjacency& graph, std::vector<Side>& sides)
      : graph_(graph), sides_(sides), moved_in_(sides.size(), -1) {
    for (const Side side : sides) ++state_.count[side];
  }

  void run() {
    for (int pass = 0; pass < passes; ++pass) {
      const State begun = state_;
      improve(pass);
      if (!(better(state_, begun))) return;
    }
  }

private:
  struct State {
    std::int64_t count[3] = {0, 0, 0};  // by side
  };
  struct Move {
    std::int64_t gain;
    std::uint32_t unknown;
    Side to;
    auto operator<=>(const Move&) const = default;
  };

  static bool better(const State& a, const State& b) {
    const auto uneven = [](const State& s) { return std::abs(s.count[0] - s.count[1]); };
    return std::pair(a.count[separator], uneven(a)) < std::pair(b.count[separator], uneven(b));
  }
  static Side opposite(Side side) { return side == first_side ? second_side : first_side; }

  std::int64_t gain(std::uint32_t v, Side to) const {
    const Side taken = opposite(to);
    return 1 - std::ranges::count_if(graph_.of(v), [&](auto u) { return sides_[u] == taken; });
  }
  void propose(std::uint32_t v) {
    for (const Side to : {first_side, second_side}) propose(Move{gain(v, to), v, to});
  }
  void propose(const Move& move) {
    heap_.push_back(move);
    std::ranges::push_heap(heap_);
  }
  Move take_best() {
    std::ranges::pop_heap(heap_);
    const Move move = heap_.back();
    heap_.pop_back();
    return move;
  }
  bool unbalances(Side to) const {
    const auto grown = static_cast<double>(state_.count[to] + 1), n = static_cast<double>(sides_.size());
    return grown > balanced_side * n && state_.count[to] >= state_.count[opposite(to)];
  }

  void put(std::uint32_t v, Side side) {
    log_.emplace_back(v, sides_[v]);
    --state_.count[sides_[v]], ++state_.count[side];
    sides_[v] = side;
  }
  void make(const Move& move, int pass) {
    put(move.unknown, move.to);
    moved_in_[move.unknown] = pass;
    for (const auto u : graph_.of(move.unknown)) {
      if (sides_[u] != opposite(move.to)) continue;
      put(u, separator);
      if (moved_in_[u] != pass) propose(u);
      for (const auto w : graph_.of(u)) {
        if (sides_[w] == separator && moved_in_[w] != pass) propose(w);
      }
    }
  }

  void improve(int pass) {
    heap_.clear(), log_.clear();
    for (std::uint32_t v = 0; v < sides_.size(); ++v) {
      if (sides_[v] == separator) propose(v);
    }
    State best = state_;
    std::size_t best_log = 0;
    const std::int64_t patience = 40 + state_.count[separator] / 4;
    for (std::int64_t worse = 0; !heap_.empty() && worse < patience;) {
      Move move = take_best();
      if (sides_[move.unknown] != separator || moved_in_[move.unknown] == pass) continue;
      const auto now = gain(move.unknown, move.to);
      if (now != move.gain) {
        if (now < move.gain) propose(Move{now, move.unknown, move.to});
        continue;  // the better one is there too
      }
      if (unbalances(move.to)) continue;
      make(move, pass);
      ++worse;
      if (better(state_, best)) best = state_, best_log = log_.size(), worse = 0;
    }
    for (; log_.size() > best_log; log_.pop_back()) sides_[log_.back().first] = log_.back().second;
    state_ = best;
  }

  const mesh::Adjacency& graph_;
  std::vector<Side>& sides_;
  std::vector<int> moved_in_;  // the pass
  State state_;
  std::vector<Move> heap_;
  std::vector<std::pair<std::uint32_t, Side>> log_;  // what was where
};

class Dissection {
public:
  Dissection(base::WorkerPool& pool, const FactorReport& report, std::size_t total, std::size_t smallest)
      : pool_(pool), report_(report), smallest_(smallest), order_(total) {}

  std::vector<std::uint32_t> run(Piece whole) {
    std::vector<Piece> pieces;
    pieces.push_back(std::move(whole));
    while (!pieces.empty()) {
      std::vector<std::vector<Piece>> parts(pieces.size());
      pool_.for_blocks(pieces.size(), 1, [&](std::size_t i, std::size_t) {
        tell(0);
        parts[i] = divide(pieces[i]);
        pieces[i] = {};
      });
      pieces.clear();
      for (auto& some : parts) std::ranges::move(some, std::back_inserter(pieces));
    }
    return std::move(order_);
  }

private:
  void tell(std::size_t ordered) {
    const auto done = static_cast<double>(ordered_ += ordered);
    if (report_) report_(done / static_cast<double>(order_.size()));
  }

  std::vector<Piece> finish(const Piece& piece) {
    order_by_degree(piece, order_.data() + piece.place);
    tell(piece.size());
    return {};
  }

  std::vector<Piece> divide(const Piece& piece) {
    if (piece.size() <= smallest_) return finish(piece);
    Distances from_any(piece.neighbours, 0);
    if (from_any.reached().size() < piece.size()) return split(piece, from_any);
    tell(0);
    Distances from_one(piece.neighbours, from_any.farthest());
    tell(0);
    const Distances from_other(piece.neighbours, from_one.farthest());
    const std::uint32_t apart = from_one[from_one.farthest()];
    std::vector<std::uint32_t> levels(piece.size());
    for (std::size_t v = 0; v < levels.size(); ++v) levels[v] = from_one[v] + apart - from_other[v];
    const Cut cut = best_cut(piece.neighbours, levels);
    tell(0);
    if (!(cut.cost <= worst_separator * static_cast<double>(piece.size()))) return finish(piece);
    return halves(piece, sides_of(piece, levels, cut.level), from_one.reached());
  }

  std::vector<Side> sides_of(const Piece& piece, const std::vector<std::uint32_t>& levels,
                             std::uint32_t level) {
    std::vector<Side> sides(piece.size());
    for (std::size_t v = 0; v < sides.size(); ++v) {
      const bool cut =
          std::ranges::any_of(piece.neighbours.of(v), [&](auto u) { return levels[u] >= level; });
      sides[v] = levels[v] >= level ? second_side : cut ? separator : first_side;
    }
    Refinement(piece.neighbours, sides).run();
    tell(0);
    return sides;
  }

  std::vector<Piece> halves(const Piece& piece, const std::vector<Side>& sides,
                            std::span<const std::uint32_t> sequence) {
    std::vector<Piece> parts;
    std::size_t place = piece.place;
    for (const Side side : {first_side, second_side}) {
      parts.push_back(extracted(piece, sequence, sides, side));
      parts.back().place = place;
      place += parts.back().size();
    }
    for (const auto v : sequence) {
      if (sides[v] == separator) order_[place++] = piece.unknowns[v];
    }
    tell(piece.size() - parts[0].size() - parts[1].size());
    return parts;
  }

  // What hangs together; small ones together up to the size that is not divided.
  std::vector<Piece> split(const Piece& piece, Distances& distances) {
    const auto& reached = distances.reached();
    std::vector<std::uint32_t> labels(piece.size(), 0);
    std::vector<std::size_t> begins{0};
    for (std::size_t begin = 0, v = 0;;) {
      if (begin > begins.back() && reached.size() - begins.back() > smallest_) begins.push_back(begin);
      for (; begin < reached.size(); ++begin)
        labels[reached[begin]] = static_cast<std::uint32_t>(begins.size() - 1);
      while (v < piece.size() && distances[v] != Distances::none) ++v;
      if (v == piece.size()) break;
      distances.grow(piece.neighbours, static_cast<std::uint32_t>(v));
    }
    begins.push_back(piece.size());
    std::vector<Piece> parts;
    for (std::uint32_t l = 0; l + 1 < begins.size(); ++l) {
      tell(0);
      const auto sequence = std::span(reached).subspan(begins[l], begins[l + 1] - begins[l]);
      parts.push_back(extracted(piece, sequence, labels, l));
      parts.back().place = piece.place + begins[l];
    }
    return parts;
  }

  base::WorkerPool& pool_;
  const FactorReport& report_;
  std::size_t smallest_;
  std::vector<std::uint32_t> order_;
  std::atomic<std::size_t> ordered_{0};
};

}  // namespace

mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix) {
  return mesh::make_adjacency(matrix.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < matrix.size(); ++v) {
      for_column(matrix, v, [&](std::uint32_t row, double) {
        if (row > v) add(row, v), add(v, row);
      });
    }
  });
}

std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours, base::WorkerPool& pool,
                                             const FactorReport& report, std::size_t whole,
                                             std::size_t piece) {
  const std::size_t n = neighbours.starts.size() - 1;
  if (n == 0) return {};
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0u);
  return Dissection(pool, report, n, n <= whole ? n : piece).run({std::move(all), neighbours, 0});
}

}  // namespace viete::deform
