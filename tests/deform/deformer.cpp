#include "deform/deformer.h"

#include <doctest/doctest.h>

#include <set>

#include "base/error.h"
#include "deform/bound.h"

using namespace viete::test;
using viete::sym3::Method;

TEST_CASE("links_have_different_names") {
  std::set<std::string_view> names;
  for (const auto link : {Link::face_maps, Link::log_maps, Link::blend, Link::exp, Link::apply,
                          Link::skeleton, Link::fused, Link::normals})
    names.insert(name(link));
  CHECK(names.size() == link_count);
}

TEST_CASE("before_the_first_frame_the_model_is_at_rest_with_normals") {
  const Bound b(tube(20, 12, 0.3, 1.5), box());
  CHECK(largest_distance(b.deformer.positions(), b.model.positions) == 0);
  for (const auto& n : b.deformer.normals()) CHECK(norm(n) == doctest::Approx(1));
  CHECK(b.deformer.report().turns.size() == 1);
}

TEST_CASE("face_coordinates_time_every_staged_link_and_mean_values_only_theirs") {
  Bound face(tube(60, 30, 0.3, 1.5), box()), mvc(tube(60, 30, 0.3, 1.5), box(), Coordinates::mean_value);
  face.deform(face.pose(shear()));
  for (const auto link :
       {Link::face_maps, Link::log_maps, Link::blend, Link::exp, Link::apply, Link::normals})
    CHECK(face.deformer.times()[link] > 0);
  CHECK(face.deformer.times()[Link::fused] == 0);
  CHECK(face.deformer.matrices().size() == face.model.positions.size());
  mvc.deform(mvc.pose(shear()));
  const auto& t = mvc.deformer.times();
  CHECK(t[Link::face_maps] + t[Link::log_maps] + t[Link::exp] + t[Link::apply] == 0);
  CHECK(t[Link::blend] > 0);
  CHECK(t.total() == doctest::Approx(t[Link::blend] + t[Link::normals]));
  CHECK(mvc.deformer.matrices().empty());
}

TEST_CASE("a_pose_with_another_number_of_vertices_is_refused") {
  Bound b(tube(4, 12, 0.3, 1.5), box());
  Pose pose = rest_pose(*b.cage);
  pose.positions.pop_back();
  CHECK_THROWS_AS(b.deformer.deform(pose, Method::fast), viete::base::Error);
}

TEST_CASE("frames_have_the_same_bits_for_any_number_of_threads") {
  for (const auto c : {Coordinates::face, Coordinates::mean_value}) {
    Bound one(tube(50, 30, 0.3, 1.5), box(), c, 1), four(tube(50, 30, 0.3, 1.5), box(), c, 4);
    const Twist twist{2, {0, 0, 0}, -1, 1, 0, 150 * degree};
    one.deform(one.pose(twist));
    four.deform(four.pose(twist));
    CHECK(largest_distance(one.deformer.positions(), four.deformer.positions()) == 0);
    CHECK(largest_distance(one.deformer.normals(), four.deformer.normals()) == 0);
  }
}

TEST_CASE("a_frame_does_not_depend_on_the_frames_before") {
  Bound a(tube(20, 12, 0.3, 1.5), box()), b(tube(20, 12, 0.3, 1.5), box());
  a.deform(a.pose(similarity({1, 2, 3}, 3, 7)));
  const Pose pose = a.pose(shear());
  CHECK(largest_distance(a.deform(pose), b.deform(pose)) == 0);
}

TEST_CASE("mean_values_hand_the_turns_on") {
  Bound b(tube(4, 12, 0.3, 1.5), box(), Coordinates::mean_value);
  b.deform(b.pose(shear(), {{1, 2, 3}}));
  CHECK(b.deformer.report().turns == std::vector<Vec3>{{1, 2, 3}});
}

TEST_CASE("normals_turn_with_the_pose") {
  Bound b(tube(20, 12, 0.3, 1.5), box());
  const auto map = similarity({1, 2, 3}, 1.5);
  const auto expected = mapped(b.deformer.normals(), map);
  b.deform(b.pose(map));
  CHECK(largest_distance(b.deformer.normals(), expected) < 1e-10);
}

TEST_CASE("a_binding_for_the_fused_frame_takes_it_for_method_fast_and_for_mean_values") {
  for (const auto c : {Coordinates::face, Coordinates::mean_value}) {
    Bound staged(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2), c);
    const auto tiled = std::make_shared<const Binding>(
        bind(staged.model, *staged.cage, c, Path::fused, nullptr, staged.pool));
    CHECK(tiled->weights.empty());
    Deformer fused(staged.cage, tiled, staged.pool);
    CHECK(largest_distance(fused.normals(), staged.deformer.normals()) == 0);
    CHECK(fused.path(Method::fast) == Path::fused);
    CHECK(fused.path(Method::diag).has_value() == (c == Coordinates::mean_value));
    const Pose pose = staged.pose(shear());
    fused.deform(pose, Method::fast);
    staged.deform(pose);
    CHECK(fused.fused() != nullptr);
    CHECK(largest_distance(fused.positions(), staged.deformer.positions()) < 2e-5 * staged.cage->diagonal);
    CHECK(fused.times()[Link::fused] > 0);
    CHECK(fused.matrices().empty() == (c == Coordinates::mean_value));
    for (std::size_t i = 0; i < fused.matrices().size(); ++i) {
      const auto &a = fused.matrices()[i],
                 &b = staged.deformer.matrices()[i * staged.model.positions.size() / fused.matrices().size()];
      CHECK(std::abs(a.xx - b.xx) + std::abs(a.xy - b.xy) + std::abs(a.zz - b.zz) < 1e-13);
    }
    const auto both = std::make_shared<const Binding>(
        bind(staged.model, *staged.cage, c, Path::staged, tiled.get(), staged.pool));
    CHECK(both->tiles == tiled->tiles);
    Deformer any(staged.cage, both, staged.pool);
    any.deform(pose, Method::fast);
    any.deform(pose, Method::diag);
    CHECK(largest_distance(any.positions(), staged.deformer.positions()) <
          (any.path(Method::diag) == Path::staged ? 1e-12 : 2e-5) * staged.cage->diagonal);
  }
}
