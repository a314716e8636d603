#include "deform/maps.h"

#include <doctest/doctest.h>

#include "deform/polar.h"
#include "deform/shapes.h"

using namespace viete::test;

namespace {

// Rotations by up to 180 degrees of stretches between 0.5 and 2.
std::vector<AffineMap> maps(std::size_t count) {
  Random random(3);
  std::vector<AffineMap> all(count);
  for (auto& map : all) {
    const Polar p = polar(viete::sym3::exp_rotation(random.vector(1.8)));
    const Polar axes = polar(viete::sym3::exp_rotation(random.vector(1.8)));
    const auto& [r, unused, none] = p;
    const auto& v = axes.rotation;
    const Vec3 s{random(0.5, 2), random(0.5, 2), random(0.5, 2)};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
          for (int l = 0; l < 3; ++l) sum += r[3 * i + k] * v[3 * k + l] * s[l] * v[3 * j + l];
        }
        map.linear[3 * i + j] = sum;
      }
    }
  }
  return all;
}

template <class Numbers>
double difference(const Numbers& a, const Numbers& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

std::array<double, 6> six(const viete::sym3::Sym3<double>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

}  // namespace

TEST_CASE("splits_in_vector_code_agree_with_singular_values") {
  const auto all = maps(301);
  std::vector<MapSplit> splits(all.size());
  split_maps(all, first(all.size()), splits);
  for (std::size_t e = 0; e < all.size(); ++e) {
    const Polar expected = polar(all[e].linear);
    CHECK(difference(splits[e].rotation, expected.rotation) < 1e-14);
    CHECK(difference(six(splits[e].stretch), six(log_stretch(expected))) < 1e-14);
    CHECK(difference(splits[e].turn, Vec3(viete::sym3::log_rotation(expected.rotation))) < 1e-12);
    CHECK(splits[e].least == doctest::Approx(expected.stretches[2]));
    CHECK(splits[e].largest == doctest::Approx(expected.stretches[0]));
  }
}

TEST_CASE("a_split_depends_on_its_own_map_alone_to_the_last_bit") {
  const auto all = maps(150);
  std::vector<MapSplit> together(all.size()), apart(all.size());
  split_maps(all, first(all.size()), together);
  for (const std::uint32_t e : {0u, 7u, 63u, 64u, 149u}) {
    split_maps(all, std::array{e}, apart);
    CHECK(apart[e].rotation == together[e].rotation);
    CHECK(apart[e].stretch == together[e].stretch);
    CHECK(apart[e].turn == together[e].turn);
  }
  CHECK(apart[1].largest == 0);
}

TEST_CASE("a_split_tells_of_maps_that_mirror_or_are_not_finite") {
  std::vector<AffineMap> two(2);
  two[0].linear = {-1, 0, 0, 0, 2, 0, 0, 0, 3};
  two[1].linear = {1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 1};
  std::vector<MapSplit> splits(2);
  split_maps(two, first(2), splits);
  CHECK(splits[0].least < 0);
  CHECK_FALSE(splits[1].least >= 0);
}
