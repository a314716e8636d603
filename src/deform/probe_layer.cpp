#include "deform/probe_layer.h"

#include <algorithm>
#include <utility>

#include "pose/maps.h"
#include "pose/rows.h"

namespace viete::deform {

namespace {

constexpr std::size_t weighed_at_once = 1024;

bool same_weights(const pose::Probes& a, const pose::Probes& b) {
  return a.mix == b.mix && std::ranges::equal(a.all, b.all, [](const pose::Probe& p, const pose::Probe& q) {
           return p.place == q.place && p.pin == q.pin && p.turn == q.turn && p.stretch == q.stretch &&
                  p.move == q.move;
         });
}

// The weighted sums of the probes' motions at a vertex, without the log of the stretch.
struct ProbeSum {
  std::size_t vertex;
  Vec3 turn{0, 0, 0}, move{0, 0, 0}, pivot{0, 0, 0};
};

}  // namespace

void ProbeLayer::set(const pose::Probes& probes, const weights::Mask& mask) {
  std::vector<bool> posed;
  for (const pose::Probe& p : probes.all) posed.push_back(!p.pin && p.pose != pose::ProbePose{});
  const bool same = same_weights(probes_, probes) && posed_ == posed;
  if (!same || mask_ != mask) ++revision_;
  mask_ = mask;
  probes_ = probes;
  posed_ = std::move(posed);
  moves_ = std::ranges::find(posed_, true) != posed_.end();
  if (same) return;
  weigh();
  find_anchors();
}

void ProbeLayer::weigh() {
  const std::size_t count = probes_.all.size();
  at_places_.resize(count * count);
  for (std::size_t i = 0; i < count; ++i)
    probe_weights(probes_, probes_.all[i].place, std::span(at_places_).subspan(i * count, count));
  blocks_.assign((rest_.size() + weighed_at_once - 1) / weighed_at_once, {});
  pool_.for_blocks(rest_.size(), weighed_at_once, [&](std::size_t begin, std::size_t end) {
    weigh(begin, end, blocks_[begin / weighed_at_once]);
  });
}

// If all probes near the block are at rest, stores no shares. Many resting probes then need no memory.
void ProbeLayer::weigh(std::size_t begin, std::size_t end, Block& block) const {
  std::vector<pose::ProbeWeights> weights(probes_.all.size());
  bool moves = false;
  block.starts.push_back(0);
  for (std::size_t v = begin; v < end; ++v) {
    probe_weights(probes_, rest_[v], weights);
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
      const pose::ProbeWeights& w = weights[i];
      if (!(w.turn > 0 || w.stretch > 0 || w.move > 0)) continue;
      block.shares.push_back({i, w});
      moves |= posed_[i];
    }
    block.starts.push_back(static_cast<std::uint32_t>(block.shares.size()));
  }
  if (!moves) block = {std::vector<std::uint32_t>(end - begin + 1, 0), {}};
}

void ProbeLayer::find_anchors() {
  anchors_.clear();
  from_anchors_.clear();
  places_.clear();
  origin_ = {0, 0, 0};
  for (const pose::Probe& probe : probes_.all) {
    const auto nearest = std::ranges::min_element(
        rest_, {}, [&](const mesh::Point& x) { return squared_norm(x - probe.place); });
    anchors_.push_back(static_cast<std::uint32_t>(nearest - rest_.begin()));
    from_anchors_.push_back(probe.place - *nearest);
    places_.push_back(probe.place);
  }
}

std::span<const ProbeLayer::Share> ProbeLayer::shares(std::uint32_t vertex) const {
  const Block& block = blocks_[vertex / weighed_at_once];
  const std::size_t at = vertex % weighed_at_once;
  return std::span(block.shares).subspan(block.starts[at], block.starts[at + 1] - block.starts[at]);
}

void ProbeLayer::carry(std::span<const Vec3> anchors, const Vec3& origin) {
  origin_ = origin;
  for (std::size_t i = 0; i < anchors.size(); ++i) places_[i] = anchors[i] + from_anchors_[i];
}

std::vector<mesh::Point> ProbeLayer::places() const {
  const std::size_t count = places_.size();
  std::vector<mesh::Point> places;
  for (std::size_t i = 0; i < count; ++i) {
    pose::ProbePose sum;
    Vec3 pivot{0, 0, 0};
    for (std::size_t j = 0; j < count; ++j) {
      const pose::ProbeWeights& w = at_places_[i * count + j];
      pivot = pivot + w.pivot * places_[j];
      if (j == i) continue;
      const pose::ProbePose& pose = probes_.all[j].pose;
      sum.stretch = pose::plus(sum.stretch, w.stretch, pose.stretch);
      sum.turn = sum.turn + w.turn * pose.turn;
      sum.move = sum.move + w.move * pose.move;
    }
    const Vec3 from = places_[i] - pivot;
    places.push_back(origin_ + (places_[i] + (pose::times(linear_part(sum), from) - from) + sum.move));
  }
  return places;
}

void ProbeLayer::move(std::span<const std::uint32_t> vertices, std::span<Vec3> positions,
                      sym3::Method method) const {
  std::vector<ProbeSum> sums;
  std::vector<sym3::Sym3<double>> logs;  // contiguous for the exponential
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto of_vertex = shares(vertices[i]);
    const double share = follows(vertices[i]);
    if (of_vertex.empty() || share == 0) continue;
    ProbeSum& sum = sums.emplace_back(ProbeSum{i});
    sym3::Sym3<double>& log = logs.emplace_back();
    for (const auto& [p, w] : of_vertex) {
      const pose::ProbePose& pose = probes_.all[p].pose;
      log = pose::plus(log, share * w.stretch, pose.stretch);
      sum.turn = sum.turn + share * w.turn * pose.turn;
      sum.move = sum.move + share * w.move * pose.move;
      sum.pivot = sum.pivot + w.pivot * places_[p];
    }
  }
  std::vector<sym3::Sym3<double>> stretches(logs.size());
  sym3::exp<double>(logs, stretches, method);
  const sym3::Sym3<double> none = sym3::exp(sym3::Sym3<double>{});
  for (std::size_t n = 0; n < sums.size(); ++n) {
    Vec3& x = positions[sums[n].vertex];
    const Vec3 from = x - sums[n].pivot;
    auto more = stretches[n];  // S - I; exactly 0 without motion
    more.xx -= none.xx;
    more.yy -= none.yy;
    more.zz -= none.zz;
    const Vec3 stretch = pose::times(more, from), stretched = from + stretch;
    auto r = sym3::exp_rotation(sums[n].turn);
    for (const int i : {0, 4, 8}) r[i] -= 1;
    x = x + (stretch + pose::times(r, stretched) + sums[n].move);
  }
}

void ProbeLayer::move_all(std::span<Vec3> positions, sym3::Method method) {
  std::vector<Vec3> anchors;
  for (const auto v : anchors_) anchors.push_back(positions[v]);
  carry(anchors, {0, 0, 0});
  pool_.for_blocks(positions.size(), weighed_at_once, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> vertices(end - begin);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = static_cast<std::uint32_t>(begin + i);
    move(vertices, positions.subspan(begin, end - begin), method);
  });
}

namespace {

enum ProbeRow : std::size_t { stretch_row, turn_row, move_row, pivot_row, rows_per_probe };

void write(const Vec3& v, double scale, float* row) {
  for (std::size_t i = 0; i < 3; ++i) row[i] = static_cast<float>(scale * v[i]);
}

// Writes rows of RowForm::logs. Lengths are multiples of unit.
void write_rows(const pose::ProbePose& pose, const Vec3& place, double unit, float* rows) {
  constexpr std::size_t columns = pose::log_shape.columns, turn = 6, center = pose::log_shape.center;
  const auto& x = pose.stretch;
  float* stretch = rows + stretch_row * columns;
  for (const double entry : {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz}) *stretch++ = static_cast<float>(entry);
  write(pose.turn, 1, rows + turn_row * columns + turn);
  write(pose.move, 1 / unit, rows + move_row * columns + center);
  write(place, 1 / unit, rows + pivot_row * columns + center);
}

// Writes x - p for one tile to offsets[3][lane]. x are the positions, and p are the pivots.
void subtract_pivots(const float* weights, std::span<const float> table, const float* positions,
                     float* offsets) {
  constexpr std::size_t columns = pose::log_shape.columns;
  for (std::size_t l = 0; l < weights::lanes; ++l) {
    for (std::size_t i = 0; i < 3; ++i) offsets[i * weights::lanes + l] = positions[4 * l + i];
  }
  for (std::size_t row = pivot_row; row * columns < table.size(); row += rows_per_probe) {
    const float* place = table.data() + row * columns + pose::log_shape.center;
    const float* w = weights + row * weights::lanes;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t l = 0; l < weights::lanes; ++l) offsets[i * weights::lanes + l] -= w[l] * place[i];
    }
  }
}

}  // namespace

void ProbeTiles::follow(const ProbeLayer& layer, const weights::Leaves& leaves, base::WorkerPool& pool) {
  if (revision_ == layer.revision() && leaves_.size() == leaves.count()) return;
  revision_ = layer.revision();
  leaves_.assign(leaves.count(), {});
  pool.for_blocks(leaves.count(), 1, [&](std::size_t l, std::size_t) {
    weigh(layer, std::span(leaves.order).subspan(leaves.begin(l), leaves.end(l) - leaves.begin(l)),
          leaves_[l]);
  });
}

void ProbeTiles::weigh(const ProbeLayer& layer, std::span<const std::uint32_t> vertices, Leaf& leaf) {
  auto& probes = leaf.probes;
  for (const auto v : vertices) {
    for (const auto& share : layer.shares(v)) probes.push_back(share.probe);
  }
  std::ranges::sort(probes);
  probes.erase(std::unique(probes.begin(), probes.end()), probes.end());
  leaf.tiles = vertices.size() / weights::lanes;
  const std::size_t rows = rows_per_probe * probes.size();
  leaf.weights.assign(vertices.size() * rows, 0.0f);
  const weights::TileLines<float> lines{leaf.weights.data(), rows};
  for (std::size_t s = 0; s < vertices.size(); ++s) {
    const double follows = layer.follows(vertices[s]);
    for (const auto& [probe, w] : layer.shares(vertices[s])) {
      const auto place = static_cast<std::size_t>(std::ranges::lower_bound(probes, probe) - probes.begin());
      const std::size_t own = rows_per_probe * place;
      lines.at(s, own + stretch_row) = static_cast<float>(follows * w.stretch);
      lines.at(s, own + turn_row) = static_cast<float>(follows * w.turn);
      lines.at(s, own + move_row) = static_cast<float>(follows * w.move);
      lines.at(s, own + pivot_row) = static_cast<float>(w.pivot);
    }
  }
}

bool ProbeTiles::moves(const ProbeLayer& layer, std::size_t leaf) const {
  return std::ranges::any_of(leaves_[leaf].probes,
                             [&](auto p) { return layer.probes().all[p].pose != pose::ProbePose{}; });
}

void ProbeTiles::move(const ProbeLayer& layer, std::size_t leaf, const TileKernel& logs, double unit,
                      float* positions) const {
  const Leaf& own = leaves_[leaf];
  const std::size_t rows = rows_per_probe * own.probes.size();
  std::vector<float> table(rows * pose::log_shape.columns);
  for (std::size_t i = 0; i < own.probes.size(); ++i) {
    const auto p = own.probes[i];
    write_rows(layer.probes().all[p].pose, layer.carried()[p], unit,
               table.data() + rows_per_probe * i * pose::log_shape.columns);
  }
  base::AlignedVector<float> offsets(own.tiles * weights::lanes * 3);
  for (std::size_t t = 0; t < own.tiles; ++t) {
    subtract_pivots(own.weights.data() + t * weights::lanes * rows, table, positions + 4 * t * weights::lanes,
                    offsets.data() + t * weights::lanes * 3);
  }
  TileRun run{};
  run.tiles = own.tiles;
  run.rows = rows;
  run.weights = own.weights.data();
  run.table = table.data();
  logs.apply(run, offsets.data(), offsets.data(), positions);
}

}  // namespace viete::deform
