#include "deform/sparse/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
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
  const auto n = static_cast<std::uint32_t>(piece.size());
  std::vector<Eigen::Triplet<double>> lower;
  lower.reserve(n + piece.neighbours.items.size() / 2);
  for (std::uint32_t v = 0; v < n; ++v) {
    lower.emplace_back(v, v, 1);
    for (const auto u : piece.neighbours.of(v)) {
      if (u > v) lower.emplace_back(u, v, 1);
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(lower.begin(), lower.end());
  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(matrix.selfadjointView<Eigen::Lower>(), permutation);
  for (const int v : permutation.indices()) *order++ = piece.unknowns[static_cast<std::size_t>(v)];
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

/// Those of the sequence, which becomes that of their numbers.
Piece extracted(const Piece& piece, std::span<const std::uint32_t> sequence, std::size_t place) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  Piece part{{}, {{0}, {}}, place};
  std::vector<std::uint32_t> number(piece.size(), none);
  for (const auto v : sequence) {
    number[v] = static_cast<std::uint32_t>(part.size());
    part.unknowns.push_back(piece.unknowns[v]);
  }
  auto& [starts, items] = part.neighbours;
  for (const auto v : sequence) {
    for (const auto u : piece.neighbours.of(v)) {
      if (number[u] != none) items.push_back(number[u]);
    }
    starts.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return part;
}

/// Where to cut levels in two, few in the separator, and sides alike; 0 where there are too many in it. The
/// separator are those of a level below it with a neighbour at or above it.
std::uint32_t best_level(const mesh::Adjacency& graph, const std::vector<std::uint32_t>& levels) {
  const std::size_t end = 2 + *std::ranges::max_element(levels);
  std::vector<std::int64_t> below(end, 0), cut(end, 0);
  for (std::size_t v = 0; v < levels.size(); ++v) {
    std::uint32_t highest = levels[v];
    for (const auto u : graph.of(v)) highest = std::max(highest, levels[u]);
    ++below[levels[v] + 1], ++cut[levels[v] + 1];
    --cut[highest + 1];
  }
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(levels.size());
  for (std::uint32_t l = 1; l + 1 < end; ++l) {
    below[l] += below[l - 1], cut[l] += cut[l - 1];
    const auto under = static_cast<double>(below[l]), cuts = static_cast<double>(cut[l]);
    const double larger = std::max(under - cuts, n - under) / n;
    const double cost = cuts * (1 + 0.4 * (larger - 0.5));
    if (larger <= larger_side && cost < least) best = l, least = cost;
  }
  return least <= worst_separator * n ? best : 0;
}

/// Moves unknowns out of the separator to a side, which takes their neighbours of the other side into it: the
/// best move first, worse ones on the way to better ones, and back to the best that was seen.
class Refinement {
public:
  Refinement(const mesh::Adjacency& graph, std::vector<Side>& sides)
      : graph_(graph), sides_(sides), moved_in_(sides.size(), -1) {
    for (const Side side : sides) ++count_[side];
  }

  void run() {
    for (int pass = 0; pass < passes; ++pass) {
      const Count begun = count_;
      improve(pass);
      if (!better(count_, begun)) return;
    }
  }

private:
  using Count = std::array<std::int64_t, 3>;  // by side
  struct Move {
    std::int64_t gain;
    std::uint32_t unknown;
    Side to;
    auto operator<=>(const Move&) const = default;
  };

  static bool better(const Count& a, const Count& b) {
    const auto rank = [](const Count& c) { return std::pair(c[separator], std::abs(c[0] - c[1])); };
    return rank(a) < rank(b);
  }
  static Side opposite(Side side) { return side == first_side ? second_side : first_side; }

  std::int64_t gain(std::uint32_t v, Side to) const {
    const Side taken = opposite(to);
    return 1 - std::ranges::count_if(graph_.of(v), [&](auto u) { return sides_[u] == taken; });
  }
  void propose(std::uint32_t v) {
    for (const Side to : {first_side, second_side}) moves_.push({gain(v, to), v, to});
  }
  bool unbalances(Side to) const {
    const auto grown = static_cast<double>(count_[to] + 1), n = static_cast<double>(sides_.size());
    return grown > balanced_side * n && count_[to] >= count_[opposite(to)];
  }

  void put(std::uint32_t v, Side side) {
    log_.emplace_back(v, sides_[v]);
    --count_[sides_[v]], ++count_[side];
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
    moves_ = {}, log_.clear();
    for (std::uint32_t v = 0; v < sides_.size(); ++v) {
      if (sides_[v] == separator) propose(v);
    }
    Count best = count_;
    std::size_t best_log = 0;
    const std::int64_t patience = 40 + count_[separator] / 4;
    for (std::int64_t worse = 0; !moves_.empty() && worse < patience;) {
      const Move move = moves_.top();
      moves_.pop();
      if (sides_[move.unknown] != separator || moved_in_[move.unknown] == pass) continue;
      const auto now = gain(move.unknown, move.to);
      if (now != move.gain) {
        if (now < move.gain) moves_.push({now, move.unknown, move.to});
        continue;  // the better one is there too
      }
      if (unbalances(move.to)) continue;
      make(move, pass);
      ++worse;
      if (better(count_, best)) best = count_, best_log = log_.size(), worse = 0;
    }
    for (; log_.size() > best_log; log_.pop_back()) sides_[log_.back().first] = log_.back().second;
    count_ = best;
  }

  const mesh::Adjacency& graph_;
  std::vector<Side>& sides_;
  std::vector<int> moved_in_;  // the pass
  Count count_{};
  std::priority_queue<Move> moves_;
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
    const std::uint32_t level = best_level(piece.neighbours, levels);
    tell(0);
    if (level == 0) return finish(piece);
    return halves(piece, sides_of(piece, levels, level), from_one.reached());
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
    std::vector<std::uint32_t> members[3];  // by side
    for (const auto v : sequence) members[sides[v]].push_back(v);
    const std::size_t middle = piece.place + members[first_side].size();
    auto last = order_.begin() + std::ptrdiff_t(middle + members[second_side].size());
    for (const auto v : members[separator]) *last++ = piece.unknowns[v];
    tell(members[separator].size());
    return {extracted(piece, members[first_side], piece.place),
            extracted(piece, members[second_side], middle)};
  }

  // What hangs together; small ones together up to the size that is not divided.
  std::vector<Piece> split(const Piece& piece, Distances& distances) {
    std::vector<Piece> parts;
    std::size_t begin = 0;
    const auto end_at = [&](std::size_t end) {
      tell(0);
      parts.push_back(
          extracted(piece, std::span(distances.reached()).subspan(begin, end - begin), piece.place + begin));
      begin = end;
    };
    for (std::uint32_t v = 0; v < piece.size(); ++v) {
      if (distances[v] != Distances::none) continue;
      const std::size_t before = distances.reached().size();
      distances.grow(piece.neighbours, v);
      if (distances.reached().size() - begin > smallest_) end_at(before);
    }
    end_at(piece.size());
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
