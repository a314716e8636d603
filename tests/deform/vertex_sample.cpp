#include "deform/vertex_sample.h"

#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

double largest_difference(const sym3::Sym3<double>& a, const sym3::Sym3<double>& b) {
  return sym3::largest_entry(plus(a, -1, b));
}

Vec3 bent_down(const Vec3& p) {
  return {p[0] + 0.3 * p[1] * p[1], 1.4 * p[1], p[2] - 0.2 * p[0]};
}

}  // namespace

TEST_CASE("recomputed_matrices_equal_those_of_the_staged_frame") {
  Bound b(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  b.deform(b.pose(bent_down), sym3::Method::diag);
  StagedEngine engine(b.binding, RowForm::logs, b.pool);
  engine.run(b.deformer.state(), sym3::Method::diag);
  const auto staged = engine.matrices();
  REQUIRE(staged.size() == b.model.positions.size());
  const Weigher weigher(*b.cage, faces);
  const auto all = sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), staged.size());
  REQUIRE(all.size() == staged.size());
  double largest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(largest_difference(all[i], staged[i]) < 1e-12);
    largest = std::max(largest, sym3::largest_entry(all[i]));
  }
  CHECK(largest > 0.1);

  const auto few = sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), 10);
  REQUIRE(few.size() == 10);
  for (std::size_t s = 0; s < few.size(); ++s)
    CHECK(largest_difference(few[s], all[s * all.size() / 10]) == 0);

  CHECK(sample_stretches(weigher, *b.binding, nullptr, {}, 10).empty());
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), 10, &progress),
                  base::Cancelled);
}

TEST_CASE("the_sum_at_a_vertex_equals_that_of_its_terms_and_the_exponent_of_the_frame") {
  Bound b(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  b.deform(b.pose(bent_down), sym3::Method::diag);
  const Weigher weigher(*b.cage, faces);
  const Rows rows = b.deformer.state().rows();
  const auto all = sample_stretches(weigher, *b.binding, nullptr, rows, b.model.positions.size());
  for (const std::size_t vertex : {0, 17, 900}) {
    const VertexSum sum = vertex_sum(weigher, *b.binding, nullptr, rows, vertex);
    REQUIRE(sum.has_logs);
    CHECK(largest_difference(sum.stretch, all[vertex]) < 1e-13);
    double weights = 0;
    Vec3 offset = sum.terms[0].at;
    for (std::size_t i = 0; i < sum.terms.size(); ++i) {
      weights += sum.terms[i].weight;
      if (i > 0) CHECK(std::abs(sum.terms[i].weight) <= std::abs(sum.terms[i - 1].weight));
    }
    CHECK(weights == doctest::Approx(1).epsilon(1e-12));
    // The element that has the largest term is near.
    CHECK(norm(offset - bent_down(b.model.positions[vertex])) < 1);
  }
  const Mask half = std::make_shared<const std::vector<float>>(b.model.positions.size(), 0.5f);
  const VertexSum masked = vertex_sum(weigher, *b.binding, half, rows, 17);
  CHECK(2 * masked.stretch.xx == doctest::Approx(all[17].xx).epsilon(1e-9));
}
