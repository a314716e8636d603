#include "bench/methods.h"

#include <doctest/doctest.h>

#include "bench/accuracy.h"
#include "sym3/reference.h"

using namespace viete;

TEST_CASE("every_way_to_exp_is_one_in_double_and_in_float") {
  const sym3::Sym3<double> s{0.3, 0.1, -0.2, 0.4, 0.05, -0.1};
  const sym3::Sym3<float> f{0.3F, 0.1F, -0.2F, 0.4F, 0.05F, -0.1F};
  CHECK(bench::exp_methods().size() >= 6);
  for (const auto& method : bench::exp_methods()) {
    CHECK_MESSAGE(sym3::relative_error(method.in_double(s), s) < 1e-13, method.name);
    const auto e = method.in_float(f);
    CHECK_MESSAGE(sym3::relative_error({e.xx, e.xy, e.xz, e.yy, e.yz, e.zz}, s) < 1e-5, method.name);
  }
}

TEST_CASE("accuracy_has_a_cell_for_every_method_in_every_row") {
  base::Progress progress;
  const auto tables = bench::measure_accuracy(16, false, progress);
  CHECK_FALSE(tables.empty());
  for (const auto& table : tables) {
    CHECK_FALSE(table.rows.empty());
    for (const auto& row : table.rows) CHECK(row.cells.size() == bench::exp_methods().size());
  }
}
