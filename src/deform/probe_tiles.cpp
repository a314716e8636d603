#include "deform/probe_tiles.h"

#include <algorithm>

#include "deform/rows.h"

namespace viete::deform {

namespace {

enum ProbeRow : std::size_t { stretch_row, turn_row, move_row, pivot_row, rows_per_probe };

void write(const Vec3& v, double scale, float* row) {
  for (std::size_t i = 0; i < 3; ++i) row[i] = static_cast<float>(scale * v[i]);
}

// As RowForm::logs has them, lengths in units.
void write_rows(const ProbePose& pose, const Vec3& place, double unit, float* rows) {
  constexpr std::size_t columns = log_shape.columns, turn = 6, center = log_shape.center;
  const auto& x = pose.stretch;
  float* stretch = rows + stretch_row * columns;
  for (const double entry : {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz}) *stretch++ = static_cast<float>(entry);
  write(pose.turn, 1, rows + turn_row * columns + turn);
  write(pose.move, 1 / unit, rows + move_row * columns + center);
  write(place, 1 / unit, rows + pivot_row * columns + center);
}

// x - p, [3][lane], of one tile.
void subtract_pivots(const float* weights, std::span<const float> table, const float* positions,
                     float* offsets) {
  constexpr std::size_t columns = log_shape.columns;
  for (std::size_t l = 0; l < lanes; ++l) {
    for (std::size_t i = 0; i < 3; ++i) offsets[i * lanes + l] = positions[4 * l + i];
  }
  for (std::size_t row = pivot_row; row * columns < table.size(); row += rows_per_probe) {
    const float* place = table.data() + row * columns + log_shape.center;
    const float* w = weights + row * lanes;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t l = 0; l < lanes; ++l) offsets[i * lanes + l] -= w[l] * place[i];
    }
  }
}

}  // namespace

void ProbeTiles::follow(const ProbeLayer& layer, const Leaves& leaves, base::WorkerPool& pool) {
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
  leaf.tiles = vertices.size() / lanes;
  const std::size_t rows = rows_per_probe * probes.size();
  leaf.weights.assign(vertices.size() * rows, 0.0f);
  for (std::size_t s = 0; s < vertices.size(); ++s) {
    const double follows = layer.follows(vertices[s]);
    float* tile = leaf.weights.data() + s / lanes * lanes * rows + s % lanes;
    for (const auto& [probe, w] : layer.shares(vertices[s])) {
      const auto place = static_cast<std::size_t>(std::ranges::lower_bound(probes, probe) - probes.begin());
      float* own = tile + rows_per_probe * place * lanes;
      own[stretch_row * lanes] = static_cast<float>(follows * w.stretch);
      own[turn_row * lanes] = static_cast<float>(follows * w.turn);
      own[move_row * lanes] = static_cast<float>(follows * w.move);
      own[pivot_row * lanes] = static_cast<float>(w.pivot);
    }
  }
}

bool ProbeTiles::moves(const ProbeLayer& layer, std::size_t leaf) const {
  return std::ranges::any_of(leaves_[leaf].probes,
                             [&](auto p) { return layer.probes().all[p].pose != ProbePose{}; });
}

void ProbeTiles::move(const ProbeLayer& layer, std::size_t leaf, const TileKernel& logs, double unit,
                      float* positions) const {
  const Leaf& own = leaves_[leaf];
  const std::size_t rows = rows_per_probe * own.probes.size();
  std::vector<float> table(rows * log_shape.columns);
  for (std::size_t i = 0; i < own.probes.size(); ++i) {
    const auto p = own.probes[i];
    write_rows(layer.probes().all[p].pose, layer.carried()[p], unit,
               table.data() + rows_per_probe * i * log_shape.columns);
  }
  base::AlignedVector<float> offsets(own.tiles * lanes * 3);
  for (std::size_t t = 0; t < own.tiles; ++t) {
    subtract_pivots(own.weights.data() + t * lanes * rows, table, positions + 4 * t * lanes,
                    offsets.data() + t * lanes * 3);
  }
  TileRun<float> run{};
  run.tiles = own.tiles, run.rows = rows, run.weights = own.weights.data(), run.table = table.data();
  logs.place(run, offsets.data(), offsets.data(), positions);
}

}  // namespace viete::deform
