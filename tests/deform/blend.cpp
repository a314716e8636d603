#include "deform/staged_engine.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

namespace {

Binding random_binding(std::size_t vertices, std::size_t handles, Random& random) {
  Binding b;
  b.vertices = vertices;
  b.handles = handles;
  for (std::size_t i = 0; i < vertices * handles; ++i) b.weights.push_back(random(0, 1));
  for (std::size_t i = 0; i < vertices; ++i) b.offsets.push_back(random.vector(1));
  b.rest.resize(vertices);
  return b;
}

Rows rows_of(const std::vector<MapLog>& logs) {
  return {RowForm::logs, {reinterpret_cast<const double*>(logs.data()), 12 * logs.size()}, {}};
}

Rows rows_of(const std::vector<Vec3>& positions) {
  return {RowForm::positions, {positions.data()->data(), 3 * positions.size()}, {}};
}

}  // namespace

TEST_CASE("blend_is_the_sum_over_handles_in_their_order_to_the_last_bit") {
  Random random(13);
  const std::size_t n = 37, k = 23;
  const Binding b = random_binding(n, k, random);
  std::vector<MapLog> logs(k);
  for (auto& l : logs) {
    l = {{random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)},
         random.vector(3),
         random.vector(2)};
  }
  std::vector<double> sums(n * log_shape.columns);
  blend(b, rows_of(logs), 0, n, sums);
  for (std::size_t i = 0; i < n; ++i) {
    double xy = 0, zz = 0;
    Vec3 rotation{0, 0, 0}, center{0, 0, 0};
    for (std::size_t j = 0; j < k; ++j) {
      const double w = b.weights[i * k + j];
      xy += w * logs[j].stretch.xy;
      zz += w * logs[j].stretch.zz;
      rotation = rotation + w * logs[j].rotation;
      center = center + w * logs[j].center;
    }
    const double* sum = sums.data() + i * log_shape.columns;
    CHECK(sum[1] == xy);
    CHECK(sum[5] == zz);
    CHECK(Vec3{sum[6], sum[7], sum[8]} == rotation);
    CHECK(Vec3{sum[9], sum[10], sum[11]} == center);
  }
}

TEST_CASE("blend_over_any_division_into_ranges_has_the_same_bits") {
  Random random(14);
  const std::size_t n = 50, k = 31;
  const Binding b = random_binding(n, k, random);
  std::vector<MapLog> logs(k);
  for (auto& l : logs) l = {{random(-1, 1), 0, 0, 0, 0, random(-1, 1)}, random.vector(3), random.vector(2)};
  std::vector<Vec3> posed(k);
  for (auto& p : posed) p = random.vector(1);
  std::vector<double> whole(n * log_shape.columns), parts = whole;
  std::vector<double> a(3 * n), c(3 * n);
  blend(b, rows_of(logs), 0, n, whole);
  blend(b, rows_of(posed), 0, n, a);
  for (const auto& [begin, end] : {std::pair{0u, 1u}, {1u, 4u}, {4u, 11u}, {11u, 50u}}) {
    blend(b, rows_of(logs), begin, end, parts);
    blend(b, rows_of(posed), begin, end, c);
  }
  CHECK(whole == parts);
  CHECK(a == c);
}

TEST_CASE("blended_positions_are_origin_offset_and_weighted_sum") {
  Random random(15);
  const Binding b = random_binding(6, 5, random);
  std::vector<Vec3> posed(5);
  for (auto& p : posed) p = random.vector(1);
  std::vector<viete::mesh::Point> out(6);
  std::vector<double> sums(18);
  blend(b, rows_of(posed), 0, 6, sums);
  apply(b, {}, RowForm::positions, sums, {}, {10, 20, 30}, 0, 6, out);
  for (std::size_t i = 0; i < 6; ++i) {
    Vec3 sum = Vec3{10, 20, 30} + b.offsets[i];
    for (std::size_t j = 0; j < 5; ++j) sum = sum + b.weights[i * 5 + j] * posed[j];
    CHECK(norm(out[i] - sum) < 1e-13);
  }
}
