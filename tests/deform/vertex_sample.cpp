#include "deform/vertex_sample.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

double largest_entry(const sym3::Sym3<double>& m) {
  return std::max(
      {std::abs(m.xx), std::abs(m.xy), std::abs(m.xz), std::abs(m.yy), std::abs(m.yz), std::abs(m.zz)});
}

sym3::Sym3<double> minus(const sym3::Sym3<double>& a, const sym3::Sym3<double>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}

Vec3 bent(const Vec3& p) {
  return {p[0] + 0.3 * p[1] * p[1], 1.4 * p[1], p[2] - 0.2 * p[0]};
}

}  // namespace

TEST_CASE("matrices_made_anew_are_those_of_the_staged_frame") {
  Bound b(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  b.deform(b.pose(bent), sym3::Method::diag);
  StagedEngine engine(b.binding, RowForm::logs, b.pool);
  engine.run(b.deformer.state(), sym3::Method::diag);
  const auto staged = engine.matrices();
  REQUIRE(staged.size() == b.model.positions.size());
  const Weigher weigher(*b.cage, faces);
  const auto all = sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), staged.size());
  REQUIRE(all.size() == staged.size());
  double largest = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(largest_entry(minus(all[i], staged[i])) < 1e-12);
    largest = std::max(largest, largest_entry(all[i]));
  }
  CHECK(largest > 0.1);

  const auto few = sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), 10);
  REQUIRE(few.size() == 10);
  for (std::size_t s = 0; s < few.size(); ++s) {
    CHECK(largest_entry(minus(few[s], all[s * all.size() / 10])) == 0);
  }
}

TEST_CASE("without_logs_there_are_no_matrices_and_making_them_can_be_cancelled") {
  Bound b(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  b.deform(b.pose(bent), sym3::Method::diag);
  const Weigher weigher(*b.cage, faces);
  CHECK(sample_stretches(weigher, *b.binding, nullptr, {}, 10).empty());
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(sample_stretches(weigher, *b.binding, nullptr, b.deformer.state().rows(), 10, &progress),
                  base::Cancelled);
}
