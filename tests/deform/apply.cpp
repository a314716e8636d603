#include "deform/staged_engine.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"
#include "sym3/exp.h"

using namespace viete::test;

TEST_CASE("apply_stretches_first_then_turns_then_moves") {
  Binding b;
  b.vertices = 1;
  b.rest.resize(1);
  b.offsets = {{1, 2, 3}};
  const std::vector<double> sums{0, 0, 0, 0, 0, 0, 0, 0, 90 * degree, 10, 20, 30};
  const std::vector<viete::sym3::Sym3<double>> stretches = {{2, 0, 0, 3, 0, 1}};
  std::vector<viete::mesh::Point> out(1);
  apply(b, {}, RowForm::logs, sums, stretches, {100, 0, 0}, 0, 1, out);
  CHECK(norm(out[0] - Vec3{100 + 10 - 6, 20 + 2, 30 + 3}) < 1e-13);
}

TEST_CASE("apply_writes_only_its_range") {
  Binding b;
  b.vertices = 3;
  b.rest.resize(3);
  b.offsets.assign(3, {1, 1, 1});
  const std::vector<double> sums(3 * log_shape.columns);
  const std::vector<viete::sym3::Sym3<double>> stretches(3, viete::sym3::identity<double>());
  std::vector<viete::mesh::Point> out(3, {7, 7, 7});
  apply(b, {}, RowForm::logs, sums, stretches, {0, 0, 0}, 1, 2, out);
  CHECK(out == std::vector<viete::mesh::Point>{{7, 7, 7}, {1, 1, 1}, {7, 7, 7}});
}
