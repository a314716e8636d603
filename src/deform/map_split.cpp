#include "deform/map_split.h"

#include <algorithm>
#include <utility>

#include "sym3/eigenvalues.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::deform {

namespace {

constexpr std::size_t portion = 64;  // elements, whose planes stay in the first cache

/// N numbers each of a portion, a plane a number.
template <int N>
struct Planes {
  alignas(64) double at[N][portion + 8];

  sym3::View<double, N> view() { return {at[0], portion + 8}; }
  sym3::View<const double, N> view() const { return {at[0], portion + 8}; }
};

// The symmetric part of R^T M.
void stretches(const Planes<9>& r, const Planes<9>& m, std::size_t count, Planes<6>& out) {
  const auto entry = [&](int i, int j, std::size_t n) {
    return r.at[i][n] * m.at[j][n] + r.at[3 + i][n] * m.at[3 + j][n] + r.at[6 + i][n] * m.at[6 + j][n];
  };
  for (std::size_t n = 0; n < count; ++n) {
    out.at[0][n] = entry(0, 0, n);
    out.at[1][n] = 0.5 * entry(0, 1, n) + 0.5 * entry(1, 0, n);
    out.at[2][n] = 0.5 * entry(0, 2, n) + 0.5 * entry(2, 0, n);
    out.at[3][n] = entry(1, 1, n);
    out.at[4][n] = 0.5 * entry(1, 2, n) + 0.5 * entry(2, 1, n);
    out.at[5][n] = entry(2, 2, n);
  }
}

void split_portion(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                   std::span<MapSplit> splits) {
  const std::size_t count = elements.size();
  Planes<9> m, r;
  Planes<6> s, x;
  Planes<3> turns, values;
  for (std::size_t n = 0; n < count; ++n) {
    for (int k = 0; k < 9; ++k) m.at[k][n] = maps[elements[n]].linear[k];
  }
  sym3::polar(std::as_const(m).view(), r.view(), count);
  sym3::log_rotation(std::as_const(r).view(), turns.view(), count);
  stretches(r, m, count, s);
  sym3::log(std::as_const(s).view(), x.view(), count);
  sym3::eigenvalues(std::as_const(s).view(), values.view(), count);
  for (std::size_t n = 0; n < count; ++n) {
    MapSplit& out = splits[elements[n]];
    for (int k = 0; k < 9; ++k) out.rotation[k] = r.at[k][n];
    out.stretch = {x.at[0][n], x.at[1][n], x.at[2][n], x.at[3][n], x.at[4][n], x.at[5][n]};
    out.turn = {turns.at[0][n], turns.at[1][n], turns.at[2][n]};
    out.least = values.at[0][n], out.largest = values.at[2][n];
  }
}

}  // namespace

void split_maps(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                std::span<MapSplit> splits) {
  for (std::size_t n = 0; n < elements.size(); n += portion) {
    split_portion(maps, elements.subspan(n, std::min(portion, elements.size() - n)), splits);
  }
}

}  // namespace viete::deform
