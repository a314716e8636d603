#include "scene/files/pose_json.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <random>
#include <sstream>

#include "scene/document/edit.h"
#include "scene/document/probes.h"
#include "scene/document/record.h"
#include "scene/files.h"
#include "scene/files/open.h"
#include "scene/files/session.h"
#include "scene/posed_cube.h"
#include "scene/workspace/apply_opened.h"
#include "scene/workspace/playing.h"
#include "scene/workspace/saving.h"
#include "support/longer.h"
#include "support/text.h"

using namespace viete;
using namespace viete::scene;
using test::mentions;
namespace fs = std::filesystem;

namespace {

// A workspace whose session has poses, a mix, keys of all easings, and camera keys.
Workspace animated(const test::CubeFiles& files) {
  Workspace w = test::opened({files.model, files.cage});
  REQUIRE(add_probe(w.document, {}, {1, 1, 1}));
  w.document.probes.all[0].pose = {{0.1, 0, 1.0 / 3}, {0, 0.5, 0, 0, 0, -1}, {1e-17, 2, 3}};
  test::add_two_poses(w.document);
  w.document.library.poses[0].name =
      "n\xC3\xA4"
      "mlich \"so\"\n";
  w.document.library.poses.push_back({"with probe", shared_pose(w.document)});
  w.document.selection = Selection(ElementKind::vertex);
  w.document.selection.apply(std::vector<std::uint32_t>{1, 6}, SelectMode::replace);
  set_weight(w.document, w.playback.vectors, 0, 0.29);
  w.document.selection.clear();
  set_weight(w.document, w.playback.vectors, 1, -0.5);
  w.document.timeline = test::three_keys();
  Timeline& t = w.document.timeline;
  t.keys[0].easing = Easing::linear;
  t.keys[1].easing = Easing::hold;
  t.keys[1].pose = test::whole(test::turned_cube(540), {w.document.probes.all[0].pose});
  t.keys[2].mix = {{"wide", -0.37}, {"with probe", 1.5}};
  t.unkeyed = {test::key(9, test::turned_cube(-30)),
               {3, test::whole(test::turned_cube(400), {w.document.probes.all[0].pose})}};
  t.cameras = {{1, {{0.1f, 0, 0}, 3, 1, 0.2f}}, {90, {{0, 0, 0}, 5, 40, -0.5f}}};
  t.first = -4, t.last = 90, t.rate = 29.97, t.repeat = Repeat::ping_pong, t.straight = true;
  w.document.frame = 7.25;
  return w;
}

bool same(const Workspace& a, const Workspace& b) {
  const auto same_keys = [](const auto& x, const auto& y, auto rest) {
    return std::ranges::equal(x, y,
                              [&](const auto& p, const auto& q) { return *p.pose == *q.pose && rest(p, q); });
  };
  const Timeline &s = a.document.timeline, &t = b.document.timeline;
  return same_keys(a.document.library.poses, b.document.library.poses,
                   [](const auto& p, const auto& q) {
                     return p.name == q.name && p.weight == q.weight && p.part == q.part;
                   }) &&
         same_keys(s.keys, t.keys,
                   [](const auto& p, const auto& q) {
                     return p.frame == q.frame && p.easing == q.easing && p.mix == q.mix;
                   }) &&
         same_keys(s.unkeyed, t.unkeyed, [](const auto& p, const auto& q) { return p.frame == q.frame; }) &&
         s.cameras == t.cameras && s.first == t.first && s.last == t.last && s.rate == t.rate &&
         s.repeat == t.repeat && s.straight == t.straight && a.document.frame == b.document.frame;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string warnings_of(const Workspace& w) {
  std::string all;
  for (const auto& message : w.messages.all()) all += message.text + '\n';
  return all;
}

// Opens a session of the cube with the given "poses" and "time".
Workspace opened_with(const test::CubeFiles& files, const std::string& parts) {
  test::put_file(files / "s.viete",
                 R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj", )" +
                     parts + "}");
  Workspace w;
  REQUIRE_MESSAGE(open_now(w, {OpenRequest::What::model, {files / "s.viete"}}), warnings_of(w));
  return w;
}

std::string positions(const std::string& first = "[0, 0, 0]") {
  std::string all = "\"positions\": [" + first;
  for (int i = 1; i < 8; ++i) all += ", [" + std::to_string(i) + ", 0, 0]";
  return all + "]";
}

std::string pose(const std::string& name, const std::string& more = "") {
  return "{\"name\": \"" + name + "\", " + more + positions() + "}";
}

std::string key_text(const std::string& frame, const std::string& more = "") {
  return "{\"frame\": " + frame + ", " + more + positions() + "}";
}

}  // namespace

TEST_CASE("poses_mixes_keys_and_camera_keys_come_back_to_the_last_bit") {
  const test::CubeFiles files;
  Workspace w = animated(files), again;
  REQUIRE(save_session(w, files / "a.viete"));
  REQUIRE(open_now(again, {OpenRequest::What::model, {files / "a.viete"}}));
  CHECK(same(w, again));
  CHECK(again.document.pose.positions == w.document.pose.positions);
  CHECK_FALSE(has_unsaved_edits(again));
  REQUIRE(save_session(again, files / "b.viete"));
  CHECK(text_of(files / "a.viete") == text_of(files / "b.viete"));
  // The mix continues from there.
  CHECK(clear_mix(again.document, again.playback.vectors));
  CHECK(again.document.pose.positions == test::cube(1.5).positions);
  CHECK(has_unsaved_edits(again));
}

TEST_CASE("weights_as_they_are_typed_come_back_to_the_last_bit") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  test::add_two_poses(w.document);
  for (int tenths = -2000; tenths <= 3000; tenths += 7) {
    const double weight = tenths / 10.0 / 100;
    w.document.library.poses[0].weight = weight;
    ShapeTable shapes;
    const nlohmann::json json = library_json(w.document.library, shapes);
    std::vector<std::string> warnings;
    CHECK(library_of(JsonReader(json, "file"), {}, warnings).poses[0].weight == weight);
    CHECK(warnings.empty());
  }
}

TEST_CASE("a_damaged_pose_affects_no_other_pose") {
  const test::CubeFiles files;
  const auto count = [&](const std::string& poses, std::size_t expected, const std::string& word) {
    CAPTURE(poses);
    const Workspace w = opened_with(files, "\"poses\": [" + poses + "]");
    CHECK(w.document.library.poses.size() == expected);
    CHECK((word.empty() ? warnings_of(w).empty() : mentions(warnings_of(w), word)));
    for (const NamedPose& named : w.document.library.poses) {
      CHECK(named.pose->cage.positions.size() == 8);
      CHECK(in_range(*named.pose));
    }
    return w;
  };
  count(pose("a") + "," + pose("b", "\"weight\": 50,"), 2, "");
  count(pose("a") + ", 7," + pose("b"), 2, "poses[1]");
  count(pose("a") + ", {\"name\": \"b\"}", 1, "another cage");
  count("{\"name\": \"b\", \"positions\": [[1, 2, 3]]}," + pose("c"), 1, "another cage");
  count("{\"positions\": []}," + pose("c"), 1, "name");
  count(pose(std::string(201, 'x')) + "," + pose("c"), 1, "too long");
  count(pose("a", "\"turns\": [[0,0,0],[0,0,0]],"), 0, "another cage");
  count(pose("a", "\"probes\": [{\"turned\": [1e99, 0, 0]}],"), 0, "too large");
  for (const char* weight : {"\"weight\": 1e9,", "\"weight\": \"x\",", "\"weight\": -200.1,"})
    CHECK(count(pose("a", weight), 1, "weight").document.library.poses[0].weight == 0);
  for (const char* part : {"\"weight\": 10, \"part\": [8],", "\"weight\": 10, \"part\": 5,",
                           "\"weight\": 10, \"part\": [-1],"}) {
    const Workspace w = count(pose("a", part), 1, "edited directly");
    CHECK(w.document.library.poses[0].weight == 0);
    CHECK(w.document.library.poses[0].part.empty());
  }
  const Workspace twice = count(pose("a") + "," + pose("a") + "," + pose(""), 3, "");
  CHECK(twice.document.library.poses[1].name == "a 2");
  CHECK(twice.document.library.poses[2].name == "pose");
  const Workspace one_vertex =
      count("{\"name\": \"a\", " + positions("[\"x\", 0, 0]") + "}", 1, "at rest instead");
  CHECK(one_vertex.document.library.poses[0].pose->cage.positions[0] == mesh::Point{-1.5, -1.5, -1.5});
}

TEST_CASE("a_damaged_part_of_the_timeline_is_skipped") {
  const test::CubeFiles files;
  const auto timeline = [&](const std::string& time, const std::string& word) {
    CAPTURE(time);
    const Workspace w = opened_with(files, "\"time\": {" + time + "}");
    CHECK((word.empty() ? warnings_of(w).empty() : mentions(warnings_of(w), word)));
    const Timeline& t = w.document.timeline;
    CHECK(t.first < t.last);
    CHECK(std::ranges::is_sorted(t.keys, std::less_equal{}, &PoseKey::frame));
    CHECK(w.document.frame >= Timeline::least_frame);
    return t;
  };
  const std::string two = "\"keys\": [" + key_text("9") + "," + key_text("2") + "]";
  CHECK(timeline(two, "").keys[0].frame == 2);
  CHECK(timeline("\"rate\": 0, " + two, "rate").rate == 24);
  CHECK(timeline("\"rate\": 1e9, " + two, "rate").keys.size() == 2);
  CHECK(timeline("\"repeat\": \"often\", " + two, "repeat").repeat == Repeat::loop);
  CHECK(timeline("\"first\": 50, \"last\": 3, " + two, "").last == 51);
  CHECK(timeline("\"first\": 1000000, \"last\": 1000000, " + two, "").last == Timeline::largest_frame);
  CHECK(timeline("\"first\": 1e7, " + two, "first").first == 1);
  CHECK(timeline("\"frame\": \"now\", " + two, "frame").keys.size() == 2);
  CHECK(timeline("\"keys\": [" + key_text("1e9") + "," + key_text("2") + "]", "keys[0]").keys.size() == 1);
  CHECK(timeline("\"keys\": [" + key_text("2") + "," + key_text("2") + "]", "").keys.size() == 1);
  CHECK(timeline("\"keys\": [" + key_text("2", "\"easing\": \"fast\",") + "]", "easing").keys[0].easing ==
        Easing::smooth);
  const std::string camera =
      R"("cameras": [{"frame": 3, "target": [0, 0, 0], "distance": 4, "yaw": 100, "pitch": 0}, {"frame": 4}])";
  const Timeline cameras = timeline("\"keys\": 5, " + camera, "keys");
  CHECK(cameras.keys.empty());
  REQUIRE(cameras.cameras.size() == 1);
  CHECK(cameras.cameras[0].camera.yaw == 100);
  CHECK(timeline(two + ", \"cameras\": {}", "cameras").keys.size() == 2);
}

TEST_CASE("poses_and_time_of_a_wrong_type_are_skipped") {
  const test::CubeFiles files;
  for (const char* what : {"7", "null", "{}", "\"x\"", "[[]]"}) {
    const Workspace w = opened_with(files, "\"poses\": " + std::string(what) + ", \"time\": " + what);
    CHECK(w.document.library.poses.empty());
    CHECK(w.document.timeline.keys.empty());
    CHECK(w.document.has_cage());
  }
}

TEST_CASE("a_session_without_a_pose_shows_the_pose_of_its_frame") {
  const test::CubeFiles files;
  const Workspace w =
      opened_with(files, "\"time\": {\"frame\": 5, \"keys\": [" + key_text("2") + "," + key_text("5") + "]}");
  CHECK(w.document.frame == 5);
  CHECK(w.document.pose.positions == w.document.timeline.keys[1].pose->cage.positions);
  CHECK_FALSE(has_unsaved_edits(w));
}

TEST_CASE("playing_is_no_work_that_could_be_lost_and_a_hand_that_moves_something_is") {
  const test::CubeFiles files;
  Workspace w = animated(files);
  w.document.timeline.straight = false;
  clear_mix(w.document, w.playback.vectors);
  go_to_frame(w, 1);
  REQUIRE(save_session(w, files / "a.viete"));
  for (const double frame : {11.0, 20.5, 90.0, 1.0}) {
    go_to_frame(w, frame);
    follow_time(w, 0);
    CHECK_FALSE(has_unsaved_edits(w));
  }
  go_to_frame(w, 11);
  record_edit(w.document, "move");
  w.document.pose.positions[0][0] += 0.1;
  follow_time(w, 0);
  CHECK(has_unsaved_edits(w));
}

TEST_CASE("poses_and_keys_that_cannot_be_drawn_are_refused_with_the_session_and_named") {
  const test::CubeFiles files;
  const std::string far = positions("[1e40, 0, 0]");
  for (const auto& [parts, name] :
       {std::pair("\"poses\": [{\"name\": \"far\", " + far + "}]", "the pose \"far\""),
        {"\"time\": {\"keys\": [{\"frame\": 7, " + far + "}]}", "frame 7"}}) {
    test::put_file(files / "s.viete",
                   R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj", )" +
                       parts + "}");
    Workspace w;
    CHECK_FALSE(open_now(w, {OpenRequest::What::model, {files / "s.viete"}}));
    CHECK_MESSAGE(mentions(warnings_of(w), name), warnings_of(w));
    CHECK(mentions(warnings_of(w), "s.viete"));
  }
}

TEST_CASE("recovered_work_has_its_poses_and_keys") {
  const test::CubeFiles files;
  const Workspace w = animated(files);
  test::put_file(files / "left.viete", session_text(session_of(w), files / "left.viete", false));
  Workspace again;
  REQUIRE(open_now(again, {OpenRequest::What::recovery, {files / "left.viete"}}));
  CHECK(same(w, again));
  CHECK(has_unsaved_edits(again));
}

TEST_CASE("undo_leads_back_to_poses_in_no_key_in_a_session_that_is_opened_or_recovered") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  w.document.timeline = test::three_keys();
  follow_time(w, 0);
  const std::vector<mesh::Point> first = test::turned_cube(33).positions,
                                 last = test::turned_cube(400).positions;
  for (const double degrees : {33, 400}) {
    go_to_frame(w, degrees / 10);
    record_edit(w.document, "move");
    w.document.pose = test::turned_cube(degrees);
    follow_time(w, 0);
  }
  go_to_frame(w, 11);
  const auto keyed = w.document.pose.positions;
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(has_unsaved_edits(w));
  const auto leads_back = [&](Workspace& again) {
    CHECK(again.document.pose.positions == last);
    CHECK(again.document.pose.turns == test::turned_cube(400).turns);
    CHECK(again.document.frame == 40);
    undo(again.document);
    CHECK(again.document.pose.positions == first);
    CHECK(again.document.timeline.unkeyed.empty());
  };
  Workspace opened = test::opened({files / "a.viete"});
  opened.playback.auto_key = true;
  follow_time(opened, 0);
  CHECK_FALSE(has_unsaved_edits(opened));
  CHECK(opened.document.pose.positions == keyed);
  CHECK(opened.document.timeline.keys.size() == 3);
  undo(opened.document);
  leads_back(opened);

  test::put_file(files / "left.viete", session_text(session_of(w), files / "left.viete", false));
  Workspace recovered;
  recovered.playback.auto_key = true;
  REQUIRE(open_now(recovered, {OpenRequest::What::recovery, {files / "left.viete"}}));
  follow_time(recovered, 0);
  CHECK(has_unsaved_edits(recovered));
  CHECK(recovered.document.timeline.keys.size() == 3);
  leads_back(recovered);
}

TEST_CASE("poses_in_no_key_go_along_to_another_cage_and_lose_probes_that_are_removed") {
  const test::CubeFiles files;
  Workspace w = animated(files);
  forget_probe(w.document, 0);
  for (const PoseKey& left : w.document.timeline.unkeyed) CHECK(left.pose->probes.empty());
  carry_poses(w.document, [](deform::Pose pose) {
    pose.positions.emplace_back();
    return pose;
  });
  for (const PoseKey& left : w.document.timeline.unkeyed) CHECK(left.pose->cage.positions.size() == 9);
  drop_poses(w.document, *w.document.cage);
  CHECK(w.document.timeline.unkeyed.empty());
}

TEST_CASE("damaged_animations_are_opened_or_refused_and_what_opens_plays_and_is_saved" *
          doctest::test_suite(test::longer)) {
  const test::CubeFiles files;
  const Workspace w = animated(files);
  const std::string text = session_text(session_of(w), files / "a.viete");
  const std::size_t begin = text.find("\"poses\"");
  REQUIRE(begin != std::string::npos);
  std::mt19937 random(7);
  int opened = 0;
  const int rounds = test::rounds(100, 500);
  for (int round = 0; round < rounds; ++round) {
    std::string damaged = text;
    // Changes numbers and words; a changed bracket or quote makes the file invalid.
    for (int change = 0; change < 4; ++change) {
      const std::size_t at = begin + random() % (damaged.size() - begin);
      const bool number = std::isdigit(static_cast<unsigned char>(damaged[at])) != 0;
      if (number) damaged.replace(at, 1, std::array{"9", "00", "1e9", "e300", "0.5", "null"}[random() % 6]);
      if (std::isalpha(static_cast<unsigned char>(damaged[at]))) damaged[at] = 'x';
    }
    if (random() % 4 == 0) damaged.erase(begin + random() % (damaged.size() - begin), 1);
    test::put_file(files / "damaged.viete", damaged);
    Workspace again;
    if (!open_now(again, {OpenRequest::What::model, {files / "damaged.viete"}})) continue;
    ++opened;
    start_playing(again);
    for (int i = 0; i < 5; ++i) follow_time(again, 0.7);
    for (std::size_t i = 0; i < again.document.library.poses.size(); ++i)
      set_weight(again.document, again.playback.vectors, i, 0.5);
    CHECK(in_range(whole_pose(again.document)));
    CHECK_NOTHROW(session_text(session_of(again), files / "damaged.viete"));
  }
  CHECK_MESSAGE(opened > rounds / 10, "most damage costs its own part: ", opened);
}

TEST_CASE("another_document_that_is_opened_does_not_play_on") {
  const test::CubeFiles files;
  Workspace w = animated(files);
  REQUIRE(save_session(w, files / "a.viete"));
  w.playback.auto_key = true;
  start_playing(w);
  CHECK(w.playback.playing);
  REQUIRE(open_now(w, {OpenRequest::What::model, {files / "a.viete"}}));
  CHECK_FALSE(w.playback.playing);
  CHECK(w.playback.auto_key);
  const auto positions = w.document.pose.positions;
  follow_time(w, 1);
  CHECK(w.document.pose.positions == positions);
  CHECK(w.document.timeline.keys.size() == 3);
}
