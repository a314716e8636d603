#include "deform/blend.h"

#include <algorithm>
#include <cassert>

namespace viete::deform {

namespace {

// Rows x columns of the product weights * table, the sums held in registers.
template <std::size_t Rows, std::size_t Columns>
void product(const double* weights, const double* table, std::size_t handles, double (&sums)[Rows][Columns]) {
  double s[Rows][Columns] = {};
  for (std::size_t j = 0; j < handles; ++j) {
    const double* entry = table + j * Columns;
    for (std::size_t r = 0; r < Rows; ++r) {
      const double w = weights[r * handles + j];
      for (std::size_t c = 0; c < Columns; ++c) s[r][c] += w * entry[c];
    }
  }
  for (std::size_t r = 0; r < Rows; ++r) {
    for (std::size_t c = 0; c < Columns; ++c) sums[r][c] = s[r][c];
  }
}

// Calls store(vertex, sums) for every vertex of [begin, end); so many rows at once fill the registers.
template <std::size_t Rows, std::size_t Columns, class Store>
void for_rows(const Binding& binding, const double* table, std::size_t begin, std::size_t end,
              const Store& store) {
  const std::size_t k = binding.handles;
  std::size_t i = begin;
  for (; i + Rows <= end; i += Rows) {
    double sums[Rows][Columns];
    product<Rows, Columns>(binding.weights.data() + i * k, table, k, sums);
    for (std::size_t r = 0; r < Rows; ++r) store(i + r, sums[r]);
  }
  for (; i < end; ++i) {
    double sums[1][Columns];
    product<1, Columns>(binding.weights.data() + i * k, table, k, sums);
    store(i, sums[0]);
  }
}

template <std::size_t Columns>
void blend_columns(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
                   std::span<double> sums) {
  constexpr std::size_t at_once = Columns < 4 ? 4 : 2;
  for_rows<at_once, Columns>(binding, rows.values.data(), begin, end,
                             [&](std::size_t i, const double(&s)[Columns]) {
                               std::copy_n(s, Columns, sums.begin() + std::ptrdiff_t(i * Columns));
                             });
}

}  // namespace

void blend(const Binding& binding, const Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums) {
  switch (rows.columns()) {
    case 3: return blend_columns<3>(binding, rows, begin, end, sums);
    case 12: return blend_columns<12>(binding, rows, begin, end, sums);
    default: assert(false);  // a form has another number of columns
  }
}

}  // namespace viete::deform
