#include "document/pose_edit.h"

#include <doctest/doctest.h>

#include "document/cage_editing.h"
#include "document/probes.h"
#include "support/edits.h"
#include "support/posed_cube.h"

using namespace viete;
using namespace viete::document;
using test::distance, test::whole, test::stretched_cube, test::turned_cube;

namespace {

struct Mixed {
  Document document = test::cube_document();
  VectorCache vectors;

  explicit Mixed(bool poses = true) {
    if (poses) test::add_two_poses(document);
  }
  std::vector<NamedPose>& poses() { return document.changed_library().poses; }
  const std::vector<mesh::Point>& positions() const { return document.pose().positions; }
  bool weigh(std::size_t pose, double weight) { return set_weight(document, vectors, pose, weight); }
  // Sets the pose as a drag does.
  void put(const pose::Pose& pose, const char* label = "move by hand") {
    record_edit(document, label);
    document.changed_pose() = pose;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const NamedPose& named : document.library().poses) all.push_back(named.name);
    return all;
  }
  void check_undone(const Document& start) {
    const pose::Pose pose = document.pose();
    const PoseLibrary library = document.library();
    std::size_t steps = 0;
    for (; document.history().can_undo(); ++steps) undo(document);
    CHECK(document.pose().positions == start.pose().positions);
    CHECK(document.library() == start.library());
    CHECK(document.timeline() == start.timeline());
    for (std::size_t i = 0; i < steps; ++i) redo(document);
    CHECK(document.pose().positions == pose.positions);
    CHECK(document.library() == library);
  }
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("poses_are_kept_applied_renamed_moved_duplicated_and_deleted_and_all_of_it_is_undone") {
  Mixed m(false);
  const Document start = m.document;
  m.put(turned_cube(400));
  CHECK(keep_pose(m.document, m.vectors, "turned") == 0);
  m.put(stretched_cube(3));
  CHECK(keep_pose(m.document, m.vectors, "wide") == 1);
  CHECK(keep_pose(m.document, m.vectors, "wide") == 2);
  CHECK(m.names() == Names{"turned", "wide", "wide 2"});
  apply_pose(m.document, 0);
  CHECK(m.document.pose().positions == turned_cube(400).positions);
  CHECK(m.document.pose().turns == turned_cube(400).turns);
  rename_pose(m.document, 2, "wide");
  rename_pose(m.document, 2, "turned");
  CHECK(m.names() == Names{"turned", "wide", "turned 2"});
  rename_pose(m.document, 2, "");
  move_pose(m.document, 2, 0);
  CHECK(m.names() == Names{"turned 2", "turned", "wide"});
  move_pose(m.document, 0, 3);
  CHECK(m.names() == Names{"turned", "wide", "turned 2"});
  remove_pose(m.document, m.vectors, 1);
  CHECK(m.names() == Names{"turned", "turned 2"});
  update_pose(m.document, 1);
  CHECK(m.poses()[1].pose->cage.positions == turned_cube(400).positions);
  m.check_undone(start);
}

TEST_CASE("names_are_short_each_there_once_and_cut_between_characters") {
  PoseLibrary library;
  const auto add = [&](const std::string& wish) {
    library.poses.push_back({free_name(library, wish), whole(turned_cube(0))});
    return library.poses.back().name;
  };
  CHECK(add("") == "pose");
  CHECK(add("") == "pose 2");
  const std::string wide = "\xC3\xA4";
  std::string text = "a";
  for (int i = 0; i < 150; ++i) text += wide;
  for (int i = 0; i < 12; ++i) {
    const std::string name = add(text);
    CHECK(name.size() <= PoseLibrary::longest_name);
    const auto space = name.find(' ');
    CHECK(name.substr(0, space).size() % 2 == 1);  // no character of two bytes is split
  }
}

TEST_CASE("unchanged_values_and_too_many_poses_are_no_edits") {
  Mixed m;
  rename_pose(m.document, 0, "turned");
  move_pose(m.document, 0, 0);
  move_pose(m.document, 0, 1);
  CHECK(m.weigh(0, 0));
  CHECK(clear_mix(m.document, m.vectors));
  m.poses().resize(PoseLibrary::most_poses, m.poses().front());
  CHECK_THROWS_AS(keep_pose(m.document, m.vectors, "one more"), base::Error);
  CHECK_THROWS_AS(add_poses(m.document, {m.poses().front()}), base::Error);
  CHECK_FALSE(m.document.history().can_undo());
}

TEST_CASE("a_weight_goes_through_rest_and_beyond_the_pose") {
  Mixed m;
  for (const double weight : {0.25, 0.5, 1.5, -0.5, 1.0, 3.0, -2.0}) {
    CHECK(m.weigh(0, weight));
    CHECK(distance(m.positions(), turned_cube(90 * weight).positions) < 1e-12);
  }
  m.weigh(0, 0);
  for (const double weight : {0.5, 1.5, -0.5, 1.0}) {
    m.weigh(1, weight);
    CHECK(distance(m.positions(), stretched_cube(std::pow(2, weight)).positions) < 1e-12);
  }
  m.weigh(1, 17);
  CHECK(m.poses()[1].weight == PoseLibrary::largest_weight);
}

TEST_CASE("weight_1_is_the_pose_and_weight_0_the_previous_pose_bit_for_bit") {
  Mixed m;
  m.poses()[0].pose = whole(turned_cube(400));
  m.weigh(0, 0.3);
  m.weigh(0, 1);
  CHECK(m.document.pose().positions == turned_cube(400).positions);
  CHECK(m.document.pose().turns == turned_cube(400).turns);
  m.weigh(0, 0);
  CHECK(m.positions() == test::cube(1.5).positions);
  m.put(stretched_cube(1.1, 0.7));
  m.weigh(0, 0.4);
  m.weigh(1, -0.7);
  m.weigh(0, 0);
  m.weigh(1, 0);
  CHECK(m.positions() == stretched_cube(1.1, 0.7).positions);
}

TEST_CASE("several_poses_are_added_in_log_space_and_subtracted") {
  Mixed m;
  m.poses().push_back({"back", whole(turned_cube(-30))});
  m.weigh(0, 1);
  m.weigh(2, 1);
  CHECK(distance(m.positions(), turned_cube(60).positions) < 1e-12);
  m.weigh(2, -1);
  CHECK(distance(m.positions(), turned_cube(120).positions) < 1e-12);
  m.weigh(2, 0);
  CHECK(clear_mix(m.document, m.vectors));
  CHECK(m.positions() == test::cube(1.5).positions);
  // The mix also uses whole turns.
  m.poses()[0].pose = whole(turned_cube(360));
  m.weigh(0, 0.5);
  m.weigh(2, 1);
  CHECK(distance(m.positions(), turned_cube(150).positions) < 1e-12);
}

TEST_CASE("a_mix_that_cannot_be_drawn_changes_nothing") {
  Mixed m;
  m.poses()[1].pose = whole(stretched_cube(1e20));
  CHECK(m.weigh(1, 1));
  const pose::Pose before = m.document.pose();
  CHECK_FALSE(m.weigh(1, 3));
  CHECK_FALSE(m.weigh(1, std::numeric_limits<double>::quiet_NaN()));
  CHECK(m.document.pose().positions == before.positions);
  CHECK(m.poses()[1].weight == 1);
  CHECK(test::edit_count(m.document.history()) == 1);
}

TEST_CASE("moves_of_one_slider_are_one_edit_and_of_another_one_another") {
  Mixed m;
  const Document start = m.document;
  for (int i = 1; i < 10; ++i) m.weigh(0, 0.1 * i);
  CHECK(test::edit_count(m.document.history()) == 1);
  m.weigh(1, 0.5);
  m.weigh(1, 0.6);
  CHECK(test::edit_count(m.document.history()) == 2);
  undo(m.document);
  CHECK(m.poses()[1].weight == 0);
  CHECK(m.poses()[0].weight == doctest::Approx(0.9));
  CHECK(distance(m.positions(), turned_cube(81).positions) < 1e-12);
  m.weigh(0, 0.5);
  CHECK(distance(m.positions(), turned_cube(45).positions) < 1e-12);
  m.check_undone(start);
}

TEST_CASE("a_drag_edits_the_pose_below_the_mix") {
  Mixed m;
  m.weigh(0, 0.5);
  m.put(turned_cube(65));  // a drag by 20 degrees, from 45 degrees
  m.weigh(0, 1);
  CHECK(distance(m.positions(), turned_cube(110).positions) < 1e-12);
  m.weigh(0, 0);
  CHECK(distance(m.positions(), turned_cube(20).positions) < 1e-12);
  // A change of whole turns is an edit too.
  m.weigh(0, 0.5);
  m.put(turned_cube(65 + 360));
  m.weigh(0, 0.75);
  CHECK(m.document.pose().turns[0][2] == doctest::Approx((65 + 360 + 22.5) / 180 * std::numbers::pi));
}

TEST_CASE("an_added_pose_has_the_weight_1_and_moves_nothing") {
  Mixed m;
  m.put(turned_cube(30));
  const auto alone = m.positions();
  CHECK(keep_pose(m.document, m.vectors, "alone") == 2);
  CHECK(m.positions() == alone);
  CHECK(m.poses()[2].weight == 1);
  CHECK(m.weigh(2, 0.5));
  CHECK(distance(m.positions(), turned_cube(15).positions) < 1e-12);
  CHECK(m.weigh(2, 1));
  CHECK(m.positions() == alone);
  CHECK(m.weigh(2, 0));

  CHECK(m.weigh(0, 0.5));
  m.put(turned_cube(65));
  CHECK(keep_pose(m.document, m.vectors, "upon another") == 3);
  CHECK(m.positions() == turned_cube(65).positions);
  CHECK(m.poses()[0].weight == 0.5);
  CHECK(m.poses()[3].weight == 1);
  CHECK(m.weigh(0, 0.25));
  CHECK(distance(m.positions(), turned_cube(42.5).positions) < 1e-12);
  CHECK(m.weigh(3, 0));
  CHECK(distance(m.positions(), turned_cube(22.5).positions) < 1e-12);
  CHECK(clear_mix(m.document, m.vectors));
  CHECK(distance(m.positions(), turned_cube(0).positions) < 1e-12);
  for (int i = 0; i < 3; ++i) undo(m.document);
  CHECK(m.positions() == turned_cube(65).positions);
  CHECK(m.poses()[3].weight == 1);
  undo(m.document);
  CHECK(m.poses().size() == 3);
  CHECK(m.poses()[0].weight == 0.5);
}

TEST_CASE("a_pose_added_at_a_key_is_in_the_mix_of_the_key") {
  Mixed m;
  m.weigh(0, 0.5);
  m.put(turned_cube(65));
  set_key(m.document, 1);
  REQUIRE(m.document.timeline().keys[0].mix.size() == 1);
  SUBCASE("with the weights of the sliders") {
    keep_pose(m.document, m.vectors, "edit");
  }
  SUBCASE("with the weights of the played pose") {
    end_mix(m.document);
    keep_pose(m.document, m.vectors, "edit", std::vector<double>{0.5, 0});
  }
  CHECK(m.poses()[0].weight == 0.5);
  const auto& mix = m.document.timeline().keys[0].mix;
  REQUIRE(mix.size() == 2);
  CHECK(mix[1].name == "edit");
  CHECK(mix[1].weight == 1);
}

TEST_CASE("a_whole_pose_in_the_list_has_the_weight_1_and_a_pose_from_elsewhere_ends_the_mix") {
  const auto ended = [](auto put, std::optional<std::size_t> alone = {}) {
    Mixed m;
    m.weigh(0, 0.5);
    put(m.document);
    for (std::size_t i = 0; i < 2; ++i) CHECK(m.poses()[i].weight == (alone == i ? 1 : 0));
    const auto shown = m.positions();
    if (alone) {
      m.weigh(*alone, 0.5);
      m.weigh(*alone, 1);
      CHECK(m.positions() == shown);
      m.weigh(*alone, 0);
      CHECK(m.positions() == turned_cube(0).positions);
    }
    const auto there = m.document.pose().positions;
    m.weigh(0, 0.5);
    m.weigh(0, 0);
    CHECK(m.document.pose().positions == there);
  };
  ended([](Document& d) { apply_pose(d, 1); }, 1);
  ended(
      [](Document& d) {  // applying a pose also ends cage editing
        begin_cage_editing(d);
        apply_pose(d, 1);
        CHECK_FALSE(is_editing_cage(d));
        CHECK(d.pose().positions == stretched_cube(2).positions);
      },
      1);
  ended([](Document& d) { reset_pose(d); });
  ended([](Document& d) { set_pose(d, stretched_cube(3)); });
  ended([](Document& d) { update_pose(d, 0); }, 0);
}

TEST_CASE("removing_a_mixed_pose_removes_its_motion") {
  Mixed m;
  const Document start = m.document;
  m.weigh(0, 0.5);
  m.weigh(1, 1);
  remove_pose(m.document, m.vectors, 0);
  CHECK(m.names() == Names{"wide"});
  CHECK(distance(m.positions(), stretched_cube(2).positions) < 1e-12);
  m.check_undone(start);
}

TEST_CASE("probes_are_mixed_by_their_logs_and_locked_ones_stay") {
  Mixed m;
  m.document.changed_probes().all.resize(2);
  const pose::ProbePose pose{{0, 0, 2}, {1, 0, 0, 0, 0, 0}, {3, 0, 0}};
  m.poses()[0].pose = whole(turned_cube(90), {pose, pose});
  m.document.changed_probes().all[1].locked = true;
  m.document.changed_probes().all[1].pose.move = {7, 7, 7};
  m.weigh(0, 0.5);
  CHECK(m.document.probes().all[0].pose == pose::ProbePose{{0, 0, 1}, {0.5, 0, 0, 0, 0, 0}, {1.5, 0, 0}});
  CHECK(m.document.probes().all[1].pose == pose::ProbePose{.move = {7, 7, 7}});
  m.put(turned_cube(50));
  m.weigh(0, 0.25);
  CHECK(m.document.probes().all[1].pose == pose::ProbePose{.move = {7, 7, 7}});
  m.weigh(0, 0);
  CHECK(mesh::norm(m.document.probes().all[0].pose.turn) < 1e-15);
  apply_pose(m.document, 0);
  CHECK(m.document.probes().all[0].pose == pose);
  CHECK(m.document.probes().all[1].pose.move == mesh::Vec3{7, 7, 7});
}

TEST_CASE("poses_of_probes_alone_are_mixed_without_a_cage") {
  Document document(test::cube_document().model());
  document.changed_probes().all.resize(1);
  document.changed_library().poses = {{"out", whole({}, {{.move = {4, 0, 0}}})}};
  VectorCache vectors;
  CHECK(set_weight(document, vectors, 0, 0.5));
  CHECK(document.probes().all[0].pose.move == mesh::Vec3{2, 0, 0});
  CHECK(set_weight(document, vectors, 0, 0));
  CHECK(document.probes().all[0].pose.move == mesh::Vec3{0, 0, 0});
}

TEST_CASE("a_removed_probe_is_gone_from_every_pose_and_key_and_comes_back_with_undo") {
  Mixed m;
  m.document.changed_probes().all.resize(3);
  std::vector<pose::ProbePose> poses(3);
  for (int i = 0; i < 3; ++i) poses[i].move = {double(i), 0, 0};
  m.poses()[0].pose = whole(turned_cube(90), poses);
  m.document.changed_timeline().keys = m.document.changed_timeline().unkeyed = {{1, m.poses()[0].pose}};
  m.document.changed_selection() = Selection(ElementKind::probe, std::array{1u});
  remove_probes(m.document);
  for (const SharedPose& pose :
       {m.poses()[0].pose, m.document.timeline().keys[0].pose, m.document.timeline().unkeyed[0].pose}) {
    REQUIRE(pose->probes.size() == 2);
    CHECK(pose->probes[1].move == mesh::Vec3{2, 0, 0});
  }
  undo(m.document);
  CHECK(m.poses()[0].pose->probes == poses);
}

TEST_CASE("an_edited_cage_takes_its_poses_and_keys_along") {
  Mixed m;
  m.document.changed_timeline() = test::three_keys();
  m.document.changed_timeline().unkeyed = {test::key(9, turned_cube(-30))};
  const Document start = m.document;
  m.weigh(1, 0.5);
  begin_cage_editing(m.document);
  subdivide_cage(m.document);
  end_cage_editing(m.document);
  const std::size_t count = m.document.cage()->surface.positions.size();
  REQUIRE(count > 8);
  CHECK_FALSE(m.document.library().mixes());
  for (const NamedPose& named : m.poses()) CHECK(named.pose->cage.positions.size() == count);
  for (const auto* keys : {&m.document.timeline().keys, &m.document.timeline().unkeyed})
    for (const PoseKey& key : *keys) CHECK(key.pose->cage.positions.size() == count);
  CHECK(m.weigh(0, 0.5));
  CHECK(test::distance(m.positions(), start.pose().positions) > 1);
  m.check_undone(start);
}

TEST_CASE("poses_of_a_cage_that_is_replaced_are_gone_and_counted") {
  Mixed m;
  CHECK(drop_poses(m.document, *m.document.cage()) == "2 poses");
  CHECK(drop_poses(m.document, *m.document.cage()).empty());
  test::add_two_poses(m.document);
  m.document.changed_timeline().keys = m.document.changed_timeline().unkeyed = {test::key(1, turned_cube(0))};
  CHECK(drop_poses(m.document, *m.document.cage()) == "2 poses and 1 key");
  CHECK(m.document.timeline().unkeyed.empty());
}
