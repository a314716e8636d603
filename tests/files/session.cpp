#include "files/session.h"

#include <nlohmann/json.hpp>

#include <cctype>
#include <random>

#include "document/probes.h"
#include "files/json_codec.h"
#include "interact/transform_drag.h"
#include "support/files.h"
#include "support/grips.h"
#include "support/posed_cube.h"
#include "support/skip.h"
#include "support/text.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

using namespace viete;
using test::mentions;
using namespace viete::document;
using namespace viete::files;
using namespace viete::interact;
using namespace viete::workspace;
namespace fs = std::filesystem;

namespace {

// Returns a workspace in which no setting has its default.
Workspace worked(const test::CubeFiles& files) {
  Workspace w;
  w.view.camera.viewport = {{1000, 800}, {320, 0}, {680, 774}};
  REQUIRE(test::load_model(w, files.model, files.cage));
  REQUIRE(add_probe(w.document, {}, {1, 1, 1}));
  Probe& probe = w.document.changed_probes().all[0];
  probe.pose = {{0.1, 0, 1.0 / 3}, {0, 0.5, 0, 0, 0, -1}, {1e-17, 2, 3}};
  probe.turn = {Falloff::sharp, 0.123};
  probe.locked = true;
  w.document.changed_probes().mix = pose::ProbeMix::softmax;
  w.document.changed_pose().positions[3] = {0.1, -1.0 / 3, 1e-17};
  w.document.changed_pose().turns = {{0.1, 6.3, -1e-9}};
  w.document.changed_selection() = Selection(ElementKind::vertex, std::vector<std::uint32_t>{2, 5});
  w.document.changed_groups() = {{0, 7}, {{"left \"arm\"\n", ElementKind::face, {0, 1, 2}}}};
  w.document.put_method(sym3::Method::sd);
  pose::Deformer deformer = pose::deformer_of(pose::Preset::mean_value);
  deformer.weighting.radius = 0.27;
  deformer.amounts = {0.29, 1.75};
  deformer.holding = {0.29, 0.07};
  w.document.put_deformer(deformer);
  set_mask(w.document, inverted(w.document), "invert");
  w.view.camera.set_pose({{0.1f, 0.2f, 0.3f}, 3.3f, -2.7f, 0.123f, true, UpAxis::z});
  w.view.options = {.dark = false,
                    .model = false,
                    .deformed = false,
                    .shading = Shading::checker,
                    .wireframe = true,
                    .cage = false,
                    .grid = false,
                    .ghost = true,
                    .field = analysis::Field::turn,
                    .select_visible = true,
                    .panels = false,
                    .hints = false};
  w.view.handling = {Pivot::point,
                     mesh::Point{1, 2, 1.0 / 3},
                     Axes::selection,
                     MirrorPlane::y,
                     {true, 0.29, SoftCurve::linear, SoftDistance::space},
                     0.25};
  put_side_views(w.view.split,
                 {{{pose::deformer_of(pose::Preset::rigid), sym3::Method::sd, analysis::Field::area, true},
                   {pose::deformer_of(pose::Preset::arap)}},
                  {{{0, 0.1f, 0}, 5.5f, 1.25f, -0.2f}, {{1, 0, 0}, 2, 0, 0.5f, true}}});
  return w;
}

// Like worked(), but also has poses, a mix, keys with all easings, and camera keys.
Workspace animated(const test::CubeFiles& files) {
  Workspace w = worked(files);
  w.document.changed_selection() = Selection(ElementKind::vertex);
  const pose::ProbePose motion = w.document.probes().all[0].pose;
  test::add_two_poses(w.document);
  w.document.changed_library().poses[0].name = "n\xC3\xA4mlich \"so\"\n";
  w.document.changed_library().poses.push_back({"with probe", shared_pose(w.document)});
  w.document.changed_selection().apply(std::vector<std::uint32_t>{1, 6}, SelectMode::replace);
  set_weight(w.document, w.playback.vectors, 0, 0.29);
  w.document.changed_selection().clear();
  set_weight(w.document, w.playback.vectors, 1, -0.5);
  w.document.changed_timeline() = test::three_keys();
  Timeline& t = w.document.changed_timeline();
  t.keys[0].easing = Easing::constant_speed;
  t.keys[1].easing = Easing::hold;
  t.keys[1].pose = test::whole(test::turned_cube(540), {motion});
  t.keys[2].mix = {{"wide", -0.37}, {"with probe", 1.5}};
  t.unkeyed = {test::key(9, test::turned_cube(-30)), {3, test::whole(test::turned_cube(400), {motion})}};
  t.channels = {{"with probe", w.document.library().poses[2].pose, {{-3, 0.29}, {8, -5, Easing::hold}}},
                {w.document.library().poses[0].name, w.document.library().poses[0].pose, {{7, 1.0 / 3}}}};
  t.cameras = {{1, {{0.1f, 0, 0}, 3, 1, 0.2f}}, {90, {{0, 0, 0}, 5, 40, -0.5f}}};
  t.first = -4;
  t.last = 90;
  t.rate = 29.97;
  t.repeat = Repeat::ping_pong;
  t.linear = true;
  w.document.put_frame(7.25);
  return w;
}

bool same_keys(const std::vector<PoseKey>& a, const std::vector<PoseKey>& b) {
  return std::ranges::equal(a, b, [](const PoseKey& x, const PoseKey& y) {
    return *x.pose == *y.pose && x.frame == y.frame && x.easing == y.easing && x.mix == y.mix;
  });
}

void check_same(const Workspace& a, const Workspace& b) {
  CHECK(a.document.pose().positions == b.document.pose().positions);
  CHECK(a.document.pose().turns == b.document.pose().turns);
  CHECK(a.document.selection() == b.document.selection());
  CHECK(a.document.groups() == b.document.groups());
  CHECK(a.document.method() == b.document.method());
  CHECK(a.document.deformer() == b.document.deformer());
  CHECK(a.document.probes() == b.document.probes());
  CHECK(same_mask(a.document.mask(), b.document.mask()));
  CHECK(a.view.camera.pose() == b.view.camera.pose());
  CHECK(a.view.options == b.view.options);
  CHECK(a.view.handling == b.view.handling);
  CHECK(side_views(a) == side_views(b));
  for (std::size_t view = 0; view < a.view.split.count(); ++view)
    CHECK(camera_of(a, view) == camera_of(b, view));
  CHECK(a.document.model().surface->positions == b.document.model().surface->positions);
  CHECK(std::ranges::equal(a.document.library().poses, b.document.library().poses,
                           [](const NamedPose& x, const NamedPose& y) {
                             return *x.pose == *y.pose && x.name == y.name && x.weight == y.weight;
                           }));
  Timeline s = a.document.timeline(), t = b.document.timeline();
  CHECK(same_keys(s.keys, t.keys));
  CHECK(same_keys(s.unkeyed, t.unkeyed));
  CHECK(std::ranges::equal(s.channels, t.channels, [](const Channel& x, const Channel& y) {
    return x.name == y.name && x.keys == y.keys && *x.pose == *y.pose;
  }));
  for (const Channel& channel : t.channels)
    CHECK(std::ranges::count(b.document.library().poses, channel.pose, &NamedPose::pose) == 1);
  s.channels.clear();
  t.channels.clear();
  s.keys.clear();
  s.unkeyed.clear();
  t.keys.clear();
  t.unkeyed.clear();
  CHECK(s == t);
  CHECK(a.document.frame() == b.document.frame());
}

std::string refusal(const fs::path& file) {
  Workspace w;
  CHECK_FALSE(test::open_now(w, {OpenRequest::What::model, {file}}));
  CHECK_FALSE(w.document.model().surface);
  return w.messages.all().back().text;
}

std::vector<std::string> said_on_opening(const fs::path& session) {
  const Workspace w = test::opened({session});
  std::vector<std::string> all;
  for (const auto& message : w.messages.all()) all.push_back(message.text);
  return all;
}

void check_note(const fs::path& session, const std::string& end) {
  const auto said = said_on_opening(session);
  REQUIRE(said.size() == 1);
  CHECK_MESSAGE(said[0].ends_with("viete: " + end), said[0]);
}

// Returns a session of the cube with additional members.
std::string with(const std::string& members) {
  return R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj", )" + members +
         "}";
}

std::string positions(const std::string& first = "[0, 0, 0]") {
  std::string all = "\"positions\": [" + first;
  for (int i = 1; i < 8; ++i) all += ", [" + std::to_string(i) + ", 0, 0]";
  return all + "]";
}

std::string key_text(const std::string& frame, const std::string& more = "") {
  return "{\"frame\": " + frame + ", " + more + positions() + "}";
}

// Returns a valid probe, and a second probe with additional members.
std::string probes(const std::string& members, const std::string& place = "[0, 0, 1]") {
  const std::string part = R"({"falloff": "smooth", "radius": 1})",
                    good = "\"rotation\": " + part + ", \"stretch\": " + part + ", \"move\": " + part +
                           ", \"place\": ";
  return "\"probes\": {\"all\": [{" + good + "[0, 0, 0]}, {" + good + place + members + "}]}";
}

}  // namespace

TEST_CASE("a_session_brings_everything_back_to_the_last_bit") {
  const test::CubeFiles files;
  for (Workspace w : {worked(files), animated(files)}) {
    REQUIRE(save_session(w, files / "a.viete"));
    Workspace back = test::opened({files / "a.viete"});
    check_same(w, back);
    for (const Message& message : back.messages.all())
      CHECK(message.text == "Undo restores 2 unkeyed poses.");
    CHECK(back.files.saved.session == files / "a.viete");
    CHECK_FALSE(has_unsaved_edits(back));
    back.view.camera.viewport = w.view.camera.viewport;
    CHECK(session_text(session_of(back), files / "a.viete") == test::file_bytes(files / "a.viete"));
    if (w.document.library().poses.empty()) continue;
    CHECK(clear_mix(back.document, back.playback.vectors));
    CHECK(back.document.pose().positions != w.document.pose().positions);
    CHECK(has_unsaved_edits(back));
  }
}

TEST_CASE("recovered_work_has_absolute_names_and_all_of_a_session") {
  const test::CubeFiles files;
  Workspace w = animated(files);
  w.files.saved.session = files / "mine.viete";
  test::put_file(files / "r.viete", session_text(session_of(w), files / "r.viete", false));
  const Session session = read_session(files / "r.viete");
  CHECK(session.model.path == fs::canonical(files.model));
  CHECK(session.origin == fs::canonical(files.path()) / "mine.viete");
  Workspace again;
  REQUIRE(test::open_now(again, {OpenRequest::What::recovery, {files / "r.viete"}}));
  check_same(w, again);
  CHECK(has_unsaved_edits(again));
  CHECK(again.files.saved.session == session.origin);
  CHECK(again.recovery.from == files / "r.viete");
  CHECK(again.preferences.recent.empty());
  REQUIRE(save_session(again, again.files.saved.session));
  CHECK_FALSE(has_unsaved_edits(again));
}

TEST_CASE("cameras_of_views_are_kept_wherever_the_hand_is") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  const CameraPose first = w.view.camera.pose();
  enter_view(w, 2);
  w.view.camera.orbit({30, 10});
  const CameraPose moved = w.view.camera.destination();
  REQUIRE(save_session(w, files / "a.viete"));
  Workspace back = test::opened({files / "a.viete"});
  CHECK(back.view.split.active == 0);
  CHECK(camera_of(back, 0) == first);
  CHECK(camera_of(back, 1) == camera_of(w, 1));
  CHECK(camera_of(back, 2) == moved);
  back.view.camera.look(StandardView::front);
  const CameraPose goal = back.view.camera.destination();
  CHECK(session_of(back).camera == goal);  // even while the camera is still moving
  CHECK(goal.yaw == 0);
}

TEST_CASE("a_session_names_its_files_relative_to_itself_and_moves_with_them") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  fs::create_directories(files / "one" / "deep");
  REQUIRE(save_session(w, files / "one" / "deep" / "a.viete"));
  CHECK(mentions(test::file_bytes(files / "one" / "deep" / "a.viete"), "\"../../model.obj\""));
  const test::TemporaryFolder elsewhere;
  fs::copy(files.path(), elsewhere / "moved", fs::copy_options::recursive);
  fs::create_directory_symlink(files / "one" / "deep", files / "link");
  REQUIRE(save_session(w, files / "link" / "b.viete"));
  for (const char* folder : {"link", "one/deep"}) CHECK(said_on_opening(files / folder / "b.viete").empty());
  fs::remove(files.model);
  Workspace back = test::opened({elsewhere / "moved" / "one" / "deep" / "a.viete"});
  check_same(w, back);
}

TEST_CASE("only_a_model_is_required_and_unknown_keys_are_ignored_with_a_note") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete",
                 R"({"format": "viete session", "version": 1, "model": "model.obj", "later": {"x": [1]}})");
  CHECK_FALSE(test::opened({files / "a.viete"}).document.has_cage());
  check_note(files / "a.viete", "unknown key ignored: \"later\"");
  test::put_file(files / "b.viete", with(R"("view": {"dark": false, "holograms": 3})"));
  const Workspace w = test::opened({files / "b.viete"});
  CHECK_FALSE(w.view.options.dark);
  CHECK(w.view.options.grid);
  CHECK_FALSE(differs_from_rest(w.document));
  check_note(files / "b.viete", "unknown key ignored: \"holograms\"");
  std::string odd = with("\"time\": {\"keys\": [" + key_text("2") + "," + key_text("5") + "]}");
  for (std::size_t at = 0; (at = odd.find("\"frame\"", at)) != odd.npos; at += 20)
    odd.insert(at, "\"odd\": {\"x\": 1}, ");
  test::put_file(files / "odd.viete", odd);
  check_note(files / "odd.viete", "unknown key ignored: \"odd\"");
  const std::string keys = "\"keys\": [" + key_text("2") + "," + key_text("5") + "]";
  test::put_file(files / "c.viete", with("\"time\": {\"frame\": 5, " + keys + "}"));
  const Workspace keyed = test::opened({files / "c.viete"});
  CHECK(keyed.document.frame() == 5);
  CHECK(keyed.document.pose().positions == keyed.document.timeline().keys[1].pose->cage.positions);
  CHECK_FALSE(has_unsaved_edits(keyed));
}

TEST_CASE("a_damaged_session_is_refused_with_its_file_and_key") {
  const test::CubeFiles files;
  const std::string camera = R"("target": [0, 0, 0], "distance": 1, "yaw": 0, "pitch": 0)",
                    named = R"("poses": [{"name": "a", )",
                    key_of_a = R"({"pose": "a", "keys": [{"frame": 2, "weight": 1}]})",
                    turns = "\"turns\": [[0,0,0],[0,0,0]], ";
  const auto time = [](const std::string& members) { return "\"time\": {" + members + "}"; };
  const auto keys = [&](const std::string& all) { return time("\"keys\": [" + all + "]"); };
  const auto weights = [&](const std::string& all) {
    return named + positions() + "}], " + time("\"weights\": [" + all + "]");
  };
  const auto pose = [](const std::string& members) { return "\"pose\": {" + members + "}"; };
  const auto stretched = [](const std::string& log) { return probes(", \"stretched\": " + log); };
  const struct {
    std::string members, said;
  } cases[] = {
      {R"("cage": 7)", "a.viete: cage: expected a file name, found a number"},
      {R"("cage_content": "00")", "a.viete: cage_content: the text must have 16 hexadecimal digits"},
      {R"("method": "best")", "a.viete: method: unknown value \"best\""},
      {R"("blend": "srl", "weights": "mean-value")", "a.viete: blend: these weights and this blend"},
      {R"("weights": "mean-value", "iterations": 1)",
       "a.viete: iterations: these weights or this blend use the cage's vertices"},
      {R"("radius": 0.01)", "a.viete: radius: the number 0.01 must be from "},
      {R"("rotation": 201)", "a.viete: rotation: "},
      {R"("stretch": -1)", "a.viete: stretch: "},
      {R"("iterations": 21)", "a.viete: iterations: "},
      {R"("attach": 101)", "a.viete: attach: "},
      {R"("hold": -1)", "a.viete: hold: "},
      {R"("camera": [])", "a.viete: camera: expected an object, found a list of length 0"},
      {R"("camera": {"target": [0, 1e308, 0]})", "camera.target[1]: the number 1e+308 must be from "},
      {R"("camera": {"target": [0, null, 0]})", "camera.target[1]: expected a number, found null"},
      {"\"camera\": {" + camera + ", \"up\": \"x\"}", "camera.up: unknown value \"x\""},
      {R"("camera": {"target": [0, 0, 0], "distance": 1e9})", "camera.distance: "},
      {R"("camera": {"target": [0, 0, 0], "distance": 1})", "camera: the key \"yaw\" is missing"},
      {R"("view": {"grid": 1})", "a.viete: view.grid: expected true or false, found a number"},
      {"\"cameras\": [{" + camera + "}]", "a.viete: cameras: there must be one camera for each"},
      {R"("views": [{}, {}, {}, {}])", "a.viete: views: the list has 4 entries, at most 3 are allowed"},
      {R"("hand": {"pivot": "nose"})", "a.viete: hand.pivot: "},
      {R"("window": [8192, 8192])", "a.viete: window: the window size is invalid"},
      {R"("window": [1e999, 800])", "a.viete: the file contains a number that is too large"},
      {R"("selecting": "holes")", "a.viete: selecting: unknown value \"holes\""},
      {R"("selection": [1, -1])", "a.viete: selection[1]: expected a whole number of 0 or more"},
      {R"("selection": [1, 8])", "a.viete: selection: vertex 8 does not exist, there are only 8 vertices"},
      {R"("selecting": "faces", "selection": [12])", "face 12 does not exist, there are only 12 faces"},
      {R"("sets": [{"name": "a", "selecting": "probes", "vertices": [1]}])", "a.viete: sets[0].selecting: "},
      {R"("mask": [0, 1])", "a.viete: mask: the mask is for a vertex, the model has 20"},
      {R"("mask": [256, 8])", "a.viete: mask[0]: a share must be 0 to 255"},
      {R"("mask": [0, 4294967295])", "a.viete: mask[1]: the mask has more than"},
      {R"("mask": [255])", "a.viete: mask: the number of vertices is missing after"},
      {pose("\"positions\": [[0, 0, 0]]"), "a.viete: pose.positions: the pose is for a vertex, the cage"},
      {pose(positions("[0, 0, 1e200]")), "a.viete: pose.positions[0]: this coordinate is too large"},
      {pose(positions("[0, null, 0]")), "a.viete: pose.positions[0][1]: expected a number, found null"},
      {pose(turns + positions()), "a.viete: pose.turns: the pose is for 2 parts, the cage has 1 part"},
      {pose("\"turns\": [[0, 0, 1e9]], " + positions()), "a.viete: pose.turns[0]: this coordinate is too"},
      {probes("", "[0, 0]"), "probes.all[1].place: "},
      {R"("probes": {"all": [{"place": [0, 0, 0]}]})", "probes.all[0]: the key \"rotation\" is missing"},
      {probes(", \"locked\": 3"), "probes.all[1].locked"},
      {probes(", \"turned\": [8e5, 8e5, 0]"), "probes.all[1]: the motion of this probe is too large"},
      {stretched("[1, 2, 3]"), "probes.all[1].stretched: expected a list of 6 numbers"},
      {probes(", \"moved\": [1e40, 0, 0]"), "probes.all[1].moved: "},
      {probes(", \"pin\": \"glues\", \"vertex\": 0"), "probes.all[1].pin: unknown value \"glues\""},
      {probes(", \"pin\": \"holds\", \"vertex\": 20"), "a.viete: probes: vertex 20 does not exist"},
      {probes(", \"move\": {\"falloff\": \"odd\", \"radius\": 1}"), "falloff: unknown value \"odd\""},
      {probes(", \"move\": {\"falloff\": \"none\", \"radius\": 0}"), "the radius must be above 0"},
      {R"("poses": {})", "a.viete: poses: expected a list, found an object"},
      {named + turns + positions() + "}]", "a.viete: poses: the pose \"a\" belongs to another cage or model"},
      {named + "\"weight\": 1e9}]", "a.viete: poses[0].weight: "},
      {named + "\"shape\": 0, " + positions() + "}]", "a.viete: poses[0].shape: shape 0 does not exist"},
      {named + positions("[1e40, 0, 0]") + "}]", "the pose \"a\""},
      {R"("poses": [{"positions": []}])", "a.viete: poses[0]: the key \"name\" is missing"},
      {"\"poses\": [{\"name\": \"" + std::string(201, 'x') + "\"}]",
       "poses[0].name: the name has more than 200 bytes"},
      {R"("unmixed": {})", "a.viete: unmixed: "},
      {R"("shapes": [{"float32": "!"}])", "a.viete: shapes[0].float32: the text is not base64"},
      {R"("shapes": [{"float32": "AAAA"}])", "three numbers for each vertex"},
      {R"("shapes": [{"float32": "AAAAAAAAAAAAAAAA"}], "shape": 0)",
       "a.viete: shape: the shape is for a vertex"},
      {time("\"rate\": 0"), "a.viete: time.rate: "},
      {time("\"repeat\": \"often\""), "a.viete: time.repeat: "},
      {time("\"first\": 50, \"last\": 3"), "a.viete: time: the last frame must be after the first"},
      {time("\"first\": 1e7"), "a.viete: time.first: "},
      {time("\"frame\": \"now\""), "a.viete: time.frame: "},
      {time("\"cameras\": [{\"frame\": 4}]"), "a.viete: time.cameras[0]: the key \"target\" is missing"},
      {weights(R"({"pose": "b", "keys": [{"frame": 2, "weight": 1}]})"),
       "a.viete: time.weights[0].pose: there is no pose with the name \"b\""},
      {weights(key_of_a + "," + key_of_a), "time.weights[1].pose: there are already keys for the pose \"a\""},
      {weights(R"({"pose": "a", "keys": []})"), "a.viete: time.weights[0].keys: there must be a key"},
      {weights(R"({"pose": "a"})"), "a.viete: time.weights[0]: the key \"keys\" is missing"},
      {weights(R"({"pose": "a", "keys": [{"frame": 2}]})"), "keys[0]: the key \"weight\" is missing"},
      {weights(R"({"pose": "a", "keys": [{"frame": 2, "weight": 5.1}]})"), "keys[0].weight: the number 5.1"},
      {weights(R"({"pose": "a", "keys": [{"frame": 2, "weight": 1}, {"frame": 2, "weight": 1}]})"),
       "a.viete: time.weights[0].keys: the keys must be sorted"},
      {weights(R"({"pose": "a", "keys": [{"frame": 2, "weight": 1, "easing": "odd"}]})"),
       "keys[0].easing: unknown value \"odd\""},
      {keys(key_text("1e9")), "a.viete: time.keys[0].frame: "},
      {keys(key_text("2") + "," + key_text("2")), "a.viete: time.keys: the keys must be sorted"},
      {keys(key_text("2", "\"easing\": \"fast\",")), "a.viete: time.keys[0].easing: "},
      {keys("{\"frame\": 7}"), "a.viete: time: the pose of frame 7 belongs to another cage or model"},
      {keys("{\"frame\": 7, " + positions("[1e40, 0, 0]") + "}"), "frame 7"}};
  for (const auto& c : cases) {
    CAPTURE(c.members);
    test::put_file(files / "a.viete", with(c.members));
    const std::string said = refusal(files / "a.viete");
    CHECK_MESSAGE(mentions(said, c.said), said);
    CHECK_MESSAGE(mentions(said, "a.viete"), said);
  }
}

TEST_CASE("all_typed_values_and_views_survive_saving") {
  const test::CubeFiles files;
  for (const double amount : {1e150, -1e150, 1e99, 1e20, 1e5, 1e-300}) {
    Workspace w = worked(files);
    w.view.options.cage = true;
    const Transform t{.factors = {1, amount, 1}, .degrees = amount, .shift = {amount, 0, 0}};
    for (const Tool tool : {Tool::move, Tool::scale, Tool::rotate})
      transform_selection(w.document, tool, test::plain_grip(w.document), t);
    frame_selection(w, false);
    w.view.camera.pan({1e30f, -1e30f});
    REQUIRE(save_session(w, files / "a.viete"));
    CHECK_FALSE(mentions(test::file_bytes(files / "a.viete"), "null"));
    Workspace back = test::opened({files / "a.viete"});
    CHECK(back.messages.all().empty());
    check_same(w, back);
  }
  Workspace w = test::opened({files.model, files.cage});
  test::add_two_poses(w.document);
  for (int tenths = -2000; tenths <= 3000; tenths += 493) {
    w.document.changed_library().poses[0].weight = tenths / 10.0 / 100;
    test::put_file(files / "b.viete", session_text(session_of(w), files / "b.viete"));
    CHECK(read_json(files / "b.viete")["poses"][0].value("weight", 0.0) == tenths / 10.0);
    CHECK(read_session(files / "b.viete").library.poses[0].weight == tenths / 10.0 / 100);
  }
}

TEST_CASE("every_deformer_is_kept_and_a_session_may_name_any_part_of_one") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  const auto check_kept = [&](const pose::Deformer& deformer) {
    CAPTURE(text(deformer));
    w.document.put_deformer(deformer);
    test::put_file(files / "a.viete", session_text(session_of(w), files / "a.viete"));
    CHECK(read_session(files / "a.viete").deformer == deformer);
  };
  for (pose::Deformer deformer : pose::valid_deformers()) {
    deformer.weighting.radius = 0.29;  // the radius is kept even if the weights do not use it
    check_kept(deformer);
  }
  CHECK(read_json(files / "a.viete")["radius"] == 29);
  pose::Deformer stitched = pose::default_deformer();
  for (const int iterations : {0, 1, pose::most_iterations}) {
    stitched.iterations = iterations;
    stitched.holding = {0.29, 0.07};
    check_kept(stitched);
  }
  const auto deformer = [&](const std::string& keys) {
    test::put_file(files / "a.viete", with(keys));
    return text(read_session(files / "a.viete").deformer);
  };
  CHECK(deformer(R"("radius": 30)") == "inverse, srl");
  CHECK(deformer(R"("weights": "mean-value")") == "mean-value, linear");
  CHECK(deformer(R"("blend": "linear")") == "inverse, linear");
  CHECK(deformer(R"("blend": "mls-rigid", "weights": "biharmonic")") == "biharmonic, mls-rigid");
}

TEST_CASE("another_format_and_another_version_are_refused_with_advice") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete", R"({"version": 1, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"), "not a session"));
  test::put_file(files / "a.viete", R"({"format": "viete session", "version": 2, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"),
                 "version: the session has version 2, this version of Viete reads version 1"));
  for (const char* text : {"", "[]", "3", "{", "null", "\xff\xfe{}"}) {
    test::put_file(files / "a.viete", text);
    CHECK_MESSAGE(mentions(refusal(files / "a.viete"), "a.viete"), text);
  }
}

TEST_CASE("opening_a_session_warns_of_a_changed_model_or_cage") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage, files.pose});
  REQUIRE(save_session(w, files / "a.viete"));
  fs::copy(files.cage, files / "same.obj");
  fs::rename(files / "same.obj", files.cage);  // replaces the file by a file with the same content
  CHECK(said_on_opening(files / "a.viete").empty());

  mesh::Surface cage = test::cube(1.5);
  std::reverse(cage.positions.begin(), cage.positions.end());
  for (auto& t : cage.triangles)
    for (auto& v : t) v = 7 - v;
  formats::write(files.cage, mesh::from_triangles(cage.positions, cage.triangles));
  auto said = said_on_opening(files / "a.viete");
  REQUIRE(said.size() == 1);
  CHECK_MESSAGE((mentions(said[0], "a.viete: cage: ") && mentions(said[0], "cage.obj has changed since")),
                said[0]);
  CHECK(mentions(said[0], "restore the older file"));

  formats::write(files.model, test::cube(1.25));
  said = said_on_opening(files / "a.viete");
  REQUIRE(said.size() == 2);
  CHECK(mentions(said[0], "model.obj has changed since"));

  Workspace again = test::opened({files / "a.viete"});
  REQUIRE(save_session(again, files / "a.viete"));
  CHECK_MESSAGE(said_on_opening(files / "a.viete").empty(), "the session belongs to the new files");
}

TEST_CASE("a_pose_that_is_cut_short_is_not_blamed_on_the_cage") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.changed_pose().positions.pop_back();
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(mentions(refusal(files / "a.viete"), "use an older copy"));
  formats::write(files.cage, test::cube(1.25));
  CHECK(mentions(refusal(files / "a.viete"), "the cage has changed"));
}

TEST_CASE("a_broken_cage_names_both_files") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "a.viete"));
  fs::rename(files.broken, files.cage);
  const std::string said = refusal(files / "a.viete");
  CHECK_MESSAGE((mentions(said, "a.viete: cage: ") && mentions(said, "cage.obj:2")), said);
}

// Half of the rounds damage only digits, so that the JSON often stays valid.
TEST_CASE("damaged_sessions_are_refused_or_play_and_can_be_saved" * doctest::test_suite(test::longer)) {
  const test::CubeFiles files;
  const std::string whole = session_text(session_of(animated(files)), files / "a.viete");
  const std::string noise = "0123456789-+.eE\"[]{},:tfn \x80";
  std::mt19937 random(3);
  int refused = 0, opened = 0;
  const int rounds = test::rounds(200, 2000);
  for (int i = 0; i < rounds; ++i) {
    std::string damaged = whole.substr(0, i % 8 == 0 ? random() % whole.size() : whole.size());
    for (unsigned n = 1 + i % 3; n-- > 0 && !damaged.empty();) {
      const std::size_t at = random() % damaged.size();
      if (i % 2) {
        damaged[at] = noise[random() % noise.size()];
      } else if (std::isdigit(static_cast<unsigned char>(damaged[at]))) {
        damaged.replace(at, 1, std::array{"9", "00", "1e9", "e300", "0.5", "null"}[random() % 6]);
      }
    }
    test::put_file(files / "b.viete", damaged);
    Workspace back;
    if (!test::open_now(back, {OpenRequest::What::model, {files / "b.viete"}})) {
      ++refused;
      CHECK(mentions(back.messages.all().back().text, "b.viete"));
      CHECK_FALSE(back.document.model().surface);
      continue;
    }
    ++opened;
    start_playing(back);
    for (int frame = 0; frame < 5; ++frame) follow_time(back, 0.7);
    for (std::size_t pose = 0; pose < back.document.library().poses.size(); ++pose)
      set_weight(back.document, back.playback.vectors, pose, 0.5);
    CHECK(in_range(whole_pose(back.document)));
    test::put_file(files / "c.viete", session_text(session_of(back), files / "c.viete"));
    CHECK_NOTHROW(read_session(files / "c.viete"));
  }
  CHECK(refused > rounds / 5);
  CHECK(opened > rounds / 10);
}

TEST_CASE("names_of_files_and_poses_that_are_not_utf_8_are_saved") {
  const test::CubeFiles files;
  const fs::path folder = files / "caf\xe9 100%";
  fs::create_directories(folder);
  fs::rename(files.model, folder / "m\xff.obj");
  fs::rename(files.cage, folder / "c\xff.obj");
  Workspace w;
  REQUIRE(test::load_model(w, folder / "m\xff.obj", folder / "c\xff.obj"));
  REQUIRE(test::open_now(w, {OpenRequest::What::poses, {folder / "c\xff.obj"}}));
  for (const fs::path& session : {folder / "s\xff.viete", files / "s.viete"}) {
    REQUIRE(save_session(w, session));
    Workspace back = test::opened({session});
    CHECK(back.document.model().path.filename() == "m\xff.obj");
    CHECK(back.document.cage_file().path.filename() == "c\xff.obj");
    CHECK(back.document.library().poses.at(0).name == "c\xef\xbf\xbd");
  }
}

TEST_CASE("undo_leads_back_to_poses_in_no_key_in_a_session_that_is_opened_or_recovered") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  w.document.changed_timeline() = test::three_keys();
  follow_time(w, 0);
  for (const double degrees : {33, 400}) {
    go_to_frame(w, degrees / 10);
    record_edit(w.document, "move");
    w.document.changed_pose() = test::turned_cube(degrees);
    follow_time(w, 0);
  }
  go_to_frame(w, 11);
  const auto keyed = w.document.pose().positions;
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(has_unsaved_edits(w));
  test::put_file(files / "left.viete", session_text(session_of(w), files / "left.viete", false));
  for (const bool recovered : {false, true}) {
    CAPTURE(recovered);
    Workspace again;
    again.playback.auto_key = true;
    REQUIRE(recovered ? test::open_now(again, {OpenRequest::What::recovery, {files / "left.viete"}})
                      : test::open_now(again, {OpenRequest::What::model, {files / "a.viete"}}));
    follow_time(again, 0);
    CHECK(has_unsaved_edits(again) == recovered);
    CHECK(again.document.timeline().keys.size() == 3);
    if (!recovered) CHECK(again.document.pose().positions == keyed);
    if (!recovered) undo(again.document);
    CHECK(again.document.pose().positions == test::turned_cube(400).positions);
    CHECK(again.document.pose().turns == test::turned_cube(400).turns);
    CHECK(again.document.frame() == 40);
    undo(again.document);
    CHECK(again.document.pose().positions == test::turned_cube(33).positions);
    CHECK(again.document.timeline().unkeyed.empty());
  }
}

TEST_CASE("another_document_that_is_opened_does_not_play_on") {
  const test::CubeFiles files;
  Workspace w = animated(files);
  REQUIRE(save_session(w, files / "a.viete"));
  w.playback.auto_key = true;
  start_playing(w);
  CHECK(w.playback.playing);
  REQUIRE(test::open_now(w, {OpenRequest::What::model, {files / "a.viete"}}));
  CHECK_FALSE(w.playback.playing);
  CHECK(w.playback.auto_key);
  const auto positions = w.document.pose().positions;
  follow_time(w, 1);
  CHECK(w.document.pose().positions == positions);
  CHECK(w.document.timeline().keys.size() == 3);
}
