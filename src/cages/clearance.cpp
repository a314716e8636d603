#include "cages/clearance.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace viete::cages {

namespace {

constexpr std::size_t block = 8;  // the number of nodes along one side of a block

// Computes the distance from each node to the model. In a mirrored grid, the model's mirror image counts too.
class Distances {
public:
  Distances(const Obstacle& model, const Grid& grid, double enough)
      : model_(model), grid_(grid), enough_(enough), values_(grid.node_count()) {}

  std::vector<float> measure(base::WorkerPool& pool, base::Progress* progress) {
    const Index3 blocks = {blocks_along(0), blocks_along(1), blocks_along(2)};
    const std::size_t all = blocks[0] * blocks[1] * blocks[2];
    constexpr std::size_t portion = 64;  // the number of blocks between two progress reports
    for (std::size_t first = 0; first < all; first += portion) {
      const std::size_t some = std::min(all - first, portion);
      pool.for_blocks(some, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = first + begin; b < first + end; ++b) {
          const Index3 low = {block * (b % blocks[0]), block * (b / blocks[0] % blocks[1]),
                              block * (b / blocks[0] / blocks[1])};
          measure_block(low, block, std::numeric_limits<double>::infinity());
        }
      });
      if (progress) progress->report(static_cast<double>(first + some) / static_cast<double>(all));
    }
    return std::move(values_);
  }

private:
  std::size_t blocks_along(std::size_t axis) const { return (grid_.size[axis] + block - 1) / block; }

  double distance(const Point& p, double below) const {
    double squared = model_.tree.nearest(p, below * below).squared_distance;
    if (grid_.mirrored) {
      const double bound = std::min(squared, below * below);
      squared = std::min(squared, model_.tree.nearest({-p[0], p[1], p[2]}, bound).squared_distance);
    }
    return std::sqrt(squared);
  }

  // If the block is far from the model, gives each node a lower bound of its distance. Otherwise divides the
  // block into eight blocks. `below` is an upper bound of the distance from the block's center.
  void measure_block(const Index3& low, std::size_t size, double below) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] >= grid_.size[k]) return;
    }
    const double half = 0.5 * static_cast<double>(size - 1);
    const Point middle = grid_.place(low[0], low[1], low[2]) + (half * grid_.step) * Vec3{1, 1, 1};
    const double radius = std::sqrt(3.0) * half * grid_.step;
    const double to_middle = distance(middle, below);
    if (size == 1) {
      values_[grid_.index(low[0], low[1], low[2])] = static_cast<float>(to_middle);
    } else if (to_middle - radius > enough_) {
      fill(low, size, middle, to_middle);
    } else {
      const std::size_t part = size / 2;
      const double away = std::sqrt(3.0) * 0.5 * static_cast<double>(part) * grid_.step;
      for (std::size_t c = 0; c < 8; ++c) {
        measure_block({low[0] + part * (c & 1), low[1] + part * (c >> 1 & 1), low[2] + part * (c >> 2)}, part,
                      (to_middle + away) * (1 + 1e-9));
      }
    }
  }

  void fill(const Index3& low, std::size_t size, const Point& middle, double to_middle) {
    Index3 last;
    for (std::size_t k = 0; k < 3; ++k) last[k] = std::min(low[k] + size, grid_.size[k]) - 1;
    for_box(low, last, [&](std::size_t i, std::size_t j, std::size_t k) {
      const double away = mesh::norm(grid_.place(i, j, k) - middle);
      values_[grid_.index(i, j, k)] = static_cast<float>(to_middle - away);
    });
  }

  const Obstacle& model_;
  const Grid& grid_;
  double enough_;
  std::vector<float> values_;
};

template <class Visit>
void for_neighbors(const Grid& grid, std::size_t index, Visit&& visit) {
  const Index3 at = grid.node(index);
  const Index3 strides = {1, grid.size[0], grid.size[0] * grid.size[1]};
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] > 0) visit(index - strides[k]);
    if (at[k] + 1 < grid.size[k]) visit(index + strides[k]);
  }
}

// Returns for each node whether it is inside the model, and farther than `least` from it. If the model is
// closed, returns only 0: reached_from_outside() cannot enter a closed model, and needs no inside nodes.
std::vector<std::uint8_t> wound(const Obstacle& model, const Grid& grid, const std::vector<float>& distances,
                                double least, base::WorkerPool& pool) {
  std::vector<std::uint8_t> inside(grid.node_count(), 0);
  if (model.closed) return inside;
  pool.for_blocks(inside.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (distances[n] <= least) continue;
      const Point p = grid.place(n);
      double number = std::abs(model.tree.winding_number(p));
      if (grid.mirrored) number = std::max(number, std::abs(model.tree.winding_number({-p[0], p[1], p[2]})));
      inside[n] = number > 0.5;
    }
  });
  return inside;
}

// Searches from the grid's border. Returns for each node whether the search reached it. The search visits
// only nodes that are outside the model, and farther than `least` from it.
std::vector<std::uint8_t> reached_from_outside(const Grid& grid, const std::vector<float>& distances,
                                               const std::vector<std::uint8_t>& inside, double least) {
  std::vector<std::uint8_t> reached(grid.node_count(), 0);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t n) {
    if (reached[n] || inside[n] || distances[n] <= least) return;
    reached[n] = 1;
    open.push_back(n);
  };
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const Index3 at = grid.node(n);
    bool border = at[0] + 1 == grid.size[0] || (at[0] == 0 && !grid.mirrored);
    for (std::size_t k = 1; k < 3; ++k) border = border || at[k] == 0 || at[k] + 1 == grid.size[k];
    if (border) reach(n);
  }
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    for_neighbors(grid, n, reach);
  }
  return reached;
}

// Computes the distance from each unreached node to the reached region, clamped to `most`. Each node passes
// its nearest border point on to its neighbours (Danielsson 1980, Euclidean distance mapping).
class Depths {
public:
  Depths(const Grid& grid, const std::vector<std::uint8_t>& reached, const std::vector<float>& distances,
         double least, double most)
      : grid_(grid),
        reached_(reached),
        values_(grid.node_count(), static_cast<float>(most)),
        nearest_(grid.node_count()) {
    find_border(distances, least);
    hand_on();
  }
  std::vector<float> take() { return std::move(values_); }

private:
  // Finds a border point on each edge between a reached node and an unreached node. The distance from the
  // border point to the model is `least`. If no point of the edge has this distance, uses the midpoint.
  void find_border(const std::vector<float>& distances, double least) {
    for (std::size_t n = 0; n < reached_.size(); ++n) {
      if (!reached_[n]) continue;
      for_neighbors(grid_, n, [&](std::size_t other) {
        if (reached_[other]) return;
        const double from = distances[n], to = distances[other];
        const double t = to < least ? std::clamp((from - least) / (from - to), 0.0, 1.0) : 0.5;
        const Point a = grid_.place(n), b = grid_.place(other);
        take(other, a + t * (b - a));
      });
    }
  }

  void hand_on() {
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const std::size_t n = queue_[next];
      const Point from = nearest_[n];
      for_neighbors(grid_, n, [&](std::size_t other) {
        if (!reached_[other]) take(other, from);
      });
    }
  }

  void take(std::size_t n, const Point& border) {
    const auto distance = static_cast<float>(mesh::norm(grid_.place(n) - border));
    if (distance >= values_[n]) return;
    values_[n] = distance;
    nearest_[n] = border;
    queue_.push_back(n);
  }

  const Grid& grid_;
  const std::vector<std::uint8_t>& reached_;
  std::vector<float> values_;
  std::vector<Point> nearest_;
  std::vector<std::size_t> queue_;
};

// Returns the clearance of an unreached node: the exact distance `to_model` with a sign, if it agrees with
// the approximate clearance `by_depth`. Otherwise returns the smaller value.
double signed_distance(double to_model, double by_depth, double tolerance) {
  if (std::abs(to_model - by_depth) < tolerance) return to_model;
  if (std::abs(-to_model - by_depth) < tolerance) return -to_model;
  return std::min(to_model, by_depth);
}

}  // namespace

Grid grid_around(const mesh::Bounds& box, std::size_t cells, double padding, bool mirrored) {
  const Vec3 size = box.high - box.low;
  Grid grid;
  grid.mirrored = mirrored;
  grid.step = mesh::largest_abs(size) / static_cast<double>(cells);
  const double around = padding + 2 * grid.step;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool half = mirrored && k == 0;
    const double length = half ? box.high[0] + around : size[k] + 2 * around;
    grid.size[k] = static_cast<std::size_t>(std::ceil(length / grid.step)) + 1;
    const double spare = static_cast<double>(grid.size[k] - 1) * grid.step - length;
    grid.origin[k] = half ? 0 : box.low[k] - around - 0.5 * spare;
  }
  return grid;
}

Clearance::Clearance(const Grid& grid, std::vector<float> values) : grid_(grid), values_(std::move(values)) {
  for (std::size_t k = 0; k < 3; ++k) last_[k] = static_cast<float>(grid.size[k] - 1);
}

Clearance::Place Clearance::in_steps(const Point& p) const {
  const double x = grid_.mirrored ? std::abs(p[0]) : p[0];
  const Vec3 place = (1 / grid_.step) * (Point{x, p[1], p[2]} - grid_.origin);
  return {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
}

float Clearance::at(const Place& p) const {
  float beyond = 0;  // the squared distance from p to the grid, in squared steps
  std::array<std::size_t, 3> cell;
  Place t;
  for (std::size_t k = 0; k < 3; ++k) {
    const float clamped = std::max(0.0F, std::min(p[k], last_[k]));  // NaN clamps to 0
    beyond += (p[k] - clamped) * (p[k] - clamped);
    cell[k] = std::min(static_cast<std::size_t>(clamped), grid_.size[k] - 2);
    t[k] = clamped - static_cast<float>(cell[k]);
  }
  const std::size_t up = grid_.size[0], deep = grid_.size[0] * grid_.size[1];
  const float* v = values_.data() + grid_.index(cell[0], cell[1], cell[2]);
  const auto along = [&](std::size_t at) { return v[at] + t[0] * (v[at + 1] - v[at]); };
  const float front = along(0) + t[1] * (along(up) - along(0));
  const float back = along(deep) + t[1] * (along(deep + up) - along(deep));
  const float value = front + t[2] * (back - front);
  return beyond > 0 ? std::hypot(value, std::sqrt(beyond) * static_cast<float>(grid_.step)) : value;
}

bool Clearance::is_clear(const Place& a, const Place& b, const Place& c, float radius, float margin) const {
  const Place middle = (1.0F / 3) * (a + b + c);
  const float here = at(middle);
  if (here < margin) return false;
  if (here >= margin + radius * static_cast<float>(grid_.step)) return true;
  if (radius < 0.75F) return true;
  const Place ab = 0.5F * (a + b), bc = 0.5F * (b + c), ca = 0.5F * (c + a);
  const float half = 0.5F * radius;
  return is_clear(ab, bc, ca, half, margin) && is_clear(a, ab, ca, half, margin) &&
         is_clear(ab, b, bc, half, margin) && is_clear(ca, bc, c, half, margin);
}

bool Clearance::is_clear(const mesh::Corners& t, double margin) const {
  const Place a = in_steps(t[0]), b = in_steps(t[1]), c = in_steps(t[2]);
  const Place middle = (1.0F / 3) * (a + b + c);
  const float radius = std::sqrt(std::max(
      {mesh::squared_norm(a - middle), mesh::squared_norm(b - middle), mesh::squared_norm(c - middle)}));
  return is_clear(a, b, c, radius, static_cast<float>(margin));
}

Clearance clearance(const Obstacle& model, const Grid& grid, const Closing& closing, base::WorkerPool& pool,
                    base::Progress* progress) {
  const double least = closing.offset + closing.gap;
  std::vector<float> values = Distances(model, grid, least + grid.step).measure(pool, progress);
  const auto inside = wound(model, grid, values, least, pool);
  const auto reached = reached_from_outside(grid, values, inside, least);
  const double deepest = least + 4 * grid.step;
  const std::vector<float> depths = Depths(grid, reached, values, least, deepest).take();
  const double tolerance = 0.35 * grid.step;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!reached[n]) values[n] = static_cast<float>(signed_distance(values[n], least - depths[n], tolerance));
  }
  return {grid, std::move(values)};
}

Clearance with_balls(const Clearance& clearance, std::span<const Point> centers, double radius, double most) {
  const Grid& grid = clearance.grid();
  std::vector<float> values(grid.node_count());
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = clearance.at_node(n);
  for (Point p : centers) {
    if (grid.mirrored) p[0] = std::abs(p[0]);
    Index3 low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto node = [&](double x) {
        const auto last = static_cast<double>(grid.size[k] - 1);
        return static_cast<std::size_t>(std::max(0.0, std::min((x - grid.origin[k]) / grid.step, last)));
      };
      low[k] = node(p[k] - radius - most);
      high[k] = node(p[k] + radius + most);
    }
    for_box(low, high, [&](std::size_t i, std::size_t j, std::size_t k) {
      float& value = values[grid.index(i, j, k)];
      value = std::min(value, static_cast<float>(mesh::norm(grid.place(i, j, k) - p) - radius));
    });
  }
  return {grid, std::move(values)};
}

}  // namespace viete::cages
