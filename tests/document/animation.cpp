#include "document/animation.h"

#include <doctest/doctest.h>

#include "support/posed_cube.h"

using namespace viete;
using namespace viete::document;
using test::distance, test::key, test::stretched_cube, test::turned_cube;

namespace {

struct Keyed {
  Document document = test::cube_document();
  VectorCache vectors;

  Animation animation(const Timeline& timeline) {
    vectors.follow(document.cage());
    return {timeline, vectors};
  }
};

Timeline two_keys(const pose::Pose& from, const pose::Pose& to, Easing easing = Easing::constant_speed) {
  Timeline timeline;
  timeline.keys = {key(1, from, easing), key(11, to)};
  return timeline;
}

// A cube without a cage, and shapes of this cube.
struct Shaped {
  std::shared_ptr<const mesh::Surface> model = std::make_shared<const mesh::Surface>(test::cube(1));
  VectorCache vectors;

  Animation animation(const Timeline& timeline) {
    vectors.follow_model(model);
    return {timeline, vectors};
  }
  SharedShape shape(double degrees, double pull = 0) const {
    auto points = model->positions;
    points[7][2] += pull;
    return std::make_shared<const std::vector<mesh::Point>>(test::turned(points, degrees));
  }
  static PoseKey key(int frame, SharedShape shape, Easing easing = Easing::constant_speed) {
    return {frame, std::make_shared<const WholePose>(WholePose{{}, {}, std::move(shape)}), easing};
  }
};

}  // namespace

TEST_CASE("half_of_a_half_turn_between_keys_is_a_quarter_turn") {
  Keyed k;
  for (const Easing easing : {Easing::constant_speed, Easing::smooth}) {
    const Animation a = k.animation(two_keys(turned_cube(0), turned_cube(180), easing));
    CHECK(distance(a.at(6).cage.positions, turned_cube(90).positions) < 1e-12);
  }
  const Animation even = k.animation(two_keys(turned_cube(0), turned_cube(180)));
  for (double share = 0; share <= 1; share += 0.05)
    CHECK(distance(even.at(1 + 10 * share).cage.positions, turned_cube(180 * share).positions) < 1e-12);
  // In the middle of a linear blend, the cube has no volume.
  Timeline linear = two_keys(turned_cube(0), turned_cube(180));
  linear.linear = true;
  for (const auto& middle : {even.at(6, true), k.animation(linear).at(6)})
    for (const auto& p : middle.cage.positions) CHECK(std::hypot(p[0], p[1]) < 1e-12);
  CHECK(k.animation(linear).at(6, false) == even.at(6));
}

TEST_CASE("a_sheared_cage_with_a_whole_turn_from_key_to_key_goes_round") {
  Keyed k;
  pose::Pose sheared = turned_cube(0), turned;
  for (auto& p : sheared.positions) {
    p[0] += 0.5 * p[1];
    p[1] += 0.25 * p[2];
  }
  turned = sheared;
  turned.turns[0] = {0, 0, 2 * std::numbers::pi};
  const Animation a = k.animation(two_keys(sheared, turned));
  for (const double degrees : {36.0, 90.0, 180.0, 288.0}) {
    const auto expected = test::turned(sheared.positions, degrees);
    CHECK(distance(a.at(1 + degrees / 36).cage.positions, expected) < 1e-12);
  }
}

TEST_CASE("poses_that_say_nothing_of_whole_turns_have_those_nearest_to_the_key_before") {
  Keyed k;
  Timeline t;
  for (int i = 0; i <= 9; ++i) {
    pose::Pose pose = turned_cube(60 * i);
    pose.turns.clear();
    t.keys.push_back(key(1 + 10 * i, pose, Easing::constant_speed));
  }
  const Animation a = k.animation(t);
  for (double degrees = 0; degrees <= 540; degrees += 30) {
    const WholePose pose = a.at(1 + degrees / 6);
    CHECK(distance(pose.cage.positions, turned_cube(degrees).positions) < 1e-12);
    CHECK(pose.cage.turns[0][2] == doctest::Approx(degrees / 180 * std::numbers::pi));
  }
}

TEST_CASE("the_frame_of_a_key_is_its_pose_to_the_bit_in_either_way") {
  Keyed k;
  const Timeline t = test::three_keys();
  const Animation a = k.animation(t);
  for (const PoseKey& each : t.keys) {
    CHECK(a.at(each.frame) == *each.pose);
    CHECK(a.at(each.frame, true) == *each.pose);
  }
  CHECK(a.at(-100) == *t.keys.front().pose);
  CHECK(a.at(100) == *t.keys.back().pose);
}

TEST_CASE("keys_with_and_without_shapes_lead_by_logs_from_one_to_the_next") {
  Shaped m;
  Timeline t;
  const SharedShape turned = m.shape(170), pulled = m.shape(70, 0.5);
  t.keys = {Shaped::key(1, nullptr), Shaped::key(11, turned), Shaped::key(21, pulled),
            Shaped::key(31, nullptr)};
  const Animation a = m.animation(t);
  CHECK(a.notes().empty());
  for (const PoseKey& key : t.keys) CHECK(a.at(key.frame) == *key.pose);
  CHECK(a.at(21).shape == pulled);
  CHECK(distance(*a.at(6).shape, *m.shape(85)) < 1e-12);
  CHECK(a.at(-3).shape == nullptr);
  CHECK(a.at(99).shape == nullptr);
  const auto linear = a.at(6, true).shape;
  for (std::size_t v = 0; v < linear->size(); ++v)
    CHECK(mesh::norm((*linear)[v] - 0.5 * (m.model->positions[v] + (*turned)[v])) < 1e-15);
  // The result does not depend on frames that were computed earlier.
  std::vector<WholePose> in_order;
  for (int frame = 1; frame <= 31; ++frame) in_order.push_back(a.at(frame));
  Shaped other;
  const Animation b = other.animation(t);
  for (int frame = 31; frame >= 1; --frame) CHECK(b.at(frame) == in_order[std::size_t(frame - 1)]);
}

TEST_CASE("shapes_go_on_turning_from_key_to_key_and_back_to_rest_after_a_whole_turn") {
  Shaped m;
  Timeline t;
  for (int i = 0; i <= 6; ++i)
    t.keys.push_back(Shaped::key(1 + 10 * i, i % 3 ? m.shape(120 * i) : SharedShape()));
  const Animation a = m.animation(t);
  for (double degrees = 0; degrees <= 720; degrees += 30)
    if (const SharedShape shape = a.at(1 + degrees / 12).shape)
      CHECK(distance(*shape, *m.shape(degrees)) < 1e-12);
}

TEST_CASE("a_loop_of_shapes_flows_through_where_it_ends_as_it_begins") {
  Shaped m;
  Timeline t;
  t.repeat = Repeat::loop;
  const auto speed_at_start = [&](const SharedShape& last) {
    t.keys = {Shaped::key(1, nullptr, Easing::smooth), Shaped::key(11, m.shape(40), Easing::smooth),
              Shaped::key(21, m.shape(-40), Easing::smooth), Shaped::key(31, last)};
    return distance(*m.animation(t).at(1.01).shape, m.model->positions);
  };
  CHECK(speed_at_start(nullptr) > 10 * speed_at_start(m.shape(20)));
}

TEST_CASE("shapes_move_beside_the_cage_and_are_taken_once") {
  Keyed k;
  Shaped m;
  Timeline t = two_keys(turned_cube(0), turned_cube(180));
  WholePose last = *t.keys[1].pose;
  last.shape = m.shape(60);
  t.keys[1].pose = std::make_shared<const WholePose>(last);
  k.vectors.follow_model(m.model);
  const Animation a = k.animation(t);
  CHECK(distance(a.at(6).cage.positions, turned_cube(90).positions) < 1e-12);
  CHECK(distance(*a.at(6).shape, *m.shape(30)) < 1e-12);
  base::WorkerPool pool;
  shapes::ShapeReport report;
  const auto known = k.vectors.of(last.shape, nullptr, pool, report);
  CHECK(k.vectors.of(last.shape, nullptr, pool, report) == known);
  k.vectors.follow_model(std::make_shared<const mesh::Surface>(test::cube(1)));
  CHECK(k.vectors.of(last.shape, nullptr, pool, report) != known);
  const auto wrong = std::make_shared<const std::vector<mesh::Point>>(5);
  CHECK_THROWS(k.vectors.of(wrong, nullptr, pool, report));
}

TEST_CASE("probes_are_blended_by_their_logs_also_without_a_cage") {
  const pose::ProbePose half{{0, 0, std::numbers::pi}, {2, 0, 0, 0, 0, 0}, {4, 0, 0}};
  Timeline t;
  t.keys = {{1, test::whole({}, {}), Easing::constant_speed}, {11, test::whole({}, {half})}};
  VectorCache none;
  none.follow(nullptr);
  const WholePose pose = Animation(t, none).at(6);
  CHECK(pose.cage.positions.empty());
  REQUIRE(pose.probes.size() == 1);
  CHECK(pose.probes[0].turn[2] == doctest::Approx(std::numbers::pi / 2));
  CHECK(pose.probes[0].stretch.xx == doctest::Approx(1));
  CHECK(pose.probes[0].move[0] == doctest::Approx(2));
}

TEST_CASE("overshoot_beyond_the_drawable_range_shows_the_previous_key") {
  Keyed k;
  Timeline t = two_keys(stretched_cube(1), stretched_cube(1e30), Easing::smooth);
  t.keys.push_back(key(111, stretched_cube(1e29)));
  const Animation a = k.animation(t);
  bool stayed = false;
  for (double frame = 1; frame <= 111; frame += 0.5) {
    const WholePose pose = a.at(frame);
    CHECK(in_range(pose));
    stayed |= frame > 12 && pose == *t.keys[1].pose;
  }
  CHECK(stayed);
}
