// viete animate: formats, errors, and complete frames after the program is killed.
#include <set>

#include "base/numbered_files.h"
#include "base/text.h"
#include "files/export.h"
#include "formats/read.h"
#include "program/command_line.h"
#include "support/animated_cube.h"
#include "support/pictures.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

using namespace viete;
using namespace viete::test;

namespace {

// Files of a cube and a cage. The posed cages p_01, p_09 and p_17 are keys.
struct AnimatedFiles : AnimatedCube {
  AnimatedFiles() {
    for (const int frame : {1, 9, 17}) {
      mesh::Surface posed = *document.cage_file().surface;
      posed.positions = AnimatedCube::pose(frame).cage.positions;
      formats::write(*this / (frame < 10 ? "p_0" + std::to_string(frame) + ".obj" : "p_17.obj"), posed);
    }
  }
  Outcome animate(const std::string& rest, const std::string& before = "") const {
    return run("animate model.obj cage.obj --keys p_##.obj " + rest,
               "cd " + quoted(path()) + " && " + before);
  }
};

std::set<std::string> names_of(const fs::path& folder, const std::string& end) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().ends_with(end)) names.insert(entry.path().filename().string());
  return names;
}

// The dragon with two keys. A frame takes so long that the test can interrupt it.
struct AnimatedDragon : TemporaryFolder {
  AnimatedDragon() {
    fs::copy(cage, *this / "k_01.obj");
    fs::copy(alert_pose, *this / "k_41.obj");
  }
  std::string line(const std::string& rest) const {
    return "animate " + quoted(dragon) + " " + quoted(cage) + " --keys k_##.obj " + rest;
  }
};

}  // namespace

TEST_CASE("pictures_and_turntables_show_no_tool_and_the_cage_only_if_it_is_asked_for") {
  const AnimatedFiles files;
  files::Session session;
  session.model.path = files / "model.obj";
  session.cage_file.path = files / "cage.obj";
  session.view.panels = false;
  const auto drawn = [&](const std::string& command) {
    put_file(files / "s.viete", files::session_text(session, files / "s.viete"));
    const Outcome outcome = run(command + " --size 200x150 --force", "cd " + quoted(files.path()) + " &&");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    return read_png(files / (command.starts_with("render") ? "p.png" : "t_02.png"));
  };
  const std::string commands[] = {"render s.viete -o p.png", "render s.viete --show-cage -o p.png",
                                  "animate s.viete --turntable --frames 1-2 -o t_##.png"};
  std::vector<render::Image> plain;
  for (const std::string& command : commands) plain.push_back(drawn(command));
  CHECK(difference(plain[0], plain[1], 12) > 0.005);
  const auto shows_no_tool = [&] {
    for (std::size_t i = 0; i < plain.size(); ++i) {
      CAPTURE(commands[i]);
      CHECK(difference(drawn(commands[i]), plain[i], 12) == 0);
    }
  };
  session.handling.soft.on = true;
  session.handling.pivot = document::Pivot::point;
  session.handling.point = mesh::Point{0, 0, 0};
  session.handling.mirror = document::MirrorPlane::x;
  for (const auto kind :
       {document::ElementKind::vertex, document::ElementKind::edge, document::ElementKind::face}) {
    CAPTURE(static_cast<int>(kind));
    session.selection = document::Selection(kind, std::vector<std::uint32_t>{0, 1});
    shows_no_tool();
  }
  session.probes.all.emplace_back();
  session.selection = document::Selection(document::ElementKind::probe, std::vector<std::uint32_t>{0});
  shows_no_tool();
}

TEST_CASE("a_picture_of_a_session_shows_its_frame_or_another_and_is_the_same_every_time") {
  const AnimatedFiles files;
  const auto drawn = [&](const std::string& more) {
    const std::string loop = quoted(assets_dir() / "dragon" / "loop.viete");
    const Outcome outcome = run("render " + loop + " --size 200x150 --force -o p.png " + more,
                                "cd " + quoted(files.path()) + " &&");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    return read_png(files / "p.png");
  };
  const render::Image first = drawn("");
  CHECK(drawn("").rgba == first.rgba);
  CHECK(drawn("--frame 1").rgba == first.rgba);  // the session was saved at frame 1
  CHECK(difference(drawn("--frame 20"), first, 12) > 0.005);
  const Outcome refused = run("render model.obj -o q.png --frame 2", "cd " + quoted(files.path()) + " &&");
  CHECK(refused.code == 1);
  CHECK(mentions(refused, "the timeline has no keys"));
}

TEST_CASE("animate_writes_models_caches_morph_targets_and_pictures") {
  const AnimatedFiles files;
  Outcome outcome = files.animate("-o f_##.ply --step 4");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "f_##.ply: 5 frames, deformed in double precision"));
  CHECK(names_of(files.path(), ".ply") ==
        std::set<std::string>{"f_01.ply", "f_05.ply", "f_09.ply", "f_13.ply", "f_17.ply"});
  for (const char* name : {"a.pc2", "a.mdd"}) {
    outcome = files.animate(std::string("-o ") + name + " --frames 3-12");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK(formats::PointCache(files / name).head().frames == 10);
  }
  outcome = files.animate("-o a.glb --tolerance 0.001");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "morph targets with linear interpolation, error up to "));
  outcome = files.animate("-o s_##.png --frames 4-5 --size 64x48 --no-grid");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(names_of(files.path(), ".png") == std::set<std::string>{"s_04.png", "s_05.png"});
  CHECK(file_bytes(files / "s_04.png") != file_bytes(files / "s_05.png"));
  CHECK(mentions(files.animate("-o s_##.png --frames 4-5 --size 64x48 --no-grid --turntable --force"),
                 "s_%02d.png' -vf "));
  CHECK(files.animate("-o g_##.obj --linear").code == 0);
  CHECK(files.animate("-o h_##.obj").code == 0);
  CHECK(file_bytes(files / "g_09.obj") == file_bytes(files / "h_09.obj"));
  CHECK(file_bytes(files / "g_05.obj") != file_bytes(files / "h_05.obj"));
}

TEST_CASE("keyed_weights_are_exported_as_the_window_shows_them_to_the_bit") {
  const AnimatedFiles files;
  workspace::Workspace w = opened({files.model, files.cage});
  document::Document& document = w.document;
  document.changed_timeline() = files.document.timeline();
  document.changed_library().poses = {{"wide", whole(turned_cage(*document.cage(), 30, 0, 1))},
                                      {"far", whole(turned_cage(*document.cage(), -20, 2))}};
  document::set_weight_key(document, 0, 3, 0.1);
  document::set_weight_key(document, 0, 11, 0.7);
  document::set_weight_key(document, 1, 7, 0.3);
  REQUIRE(save_session(w, files / "s.viete"));
  const Outcome outcome =
      run("animate s.viete -o f_##.ply --frames 3-11 --step 4", "cd " + quoted(files.path()) + " &&");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  workspace::Workspace again = opened({files / "s.viete"});
  workspace::follow_time(again, 0);
  for (const int frame : {3, 7, 11}) {
    go_to_frame(again, frame);
    const viete::files::Export one = viete::files::export_of(again.document, files / "one.ply");
    write_deformed(one);
    const auto shown = formats::read(one.file).surface.positions;
    CHECK(shown != document.model().surface->positions);
    CHECK(formats::read(files / base::formatted("f_%02d.ply", frame)).surface.positions == shown);
  }
}

TEST_CASE("keyed_shapes_are_morph_targets_with_their_weights_if_the_model_is_linear_in_them") {
  const CubeFiles files;
  workspace::Workspace w = opened({files.model});
  document::Document& document = w.document;
  for (const double angle : {20.0, 70.0}) {
    const auto positions = turned(document.model().surface->positions, angle);
    document::add_shapes(document, {{base::formatted("by %g", angle),
                                     std::make_shared<const std::vector<mesh::Point>>(positions)}});
  }
  document.changed_timeline().last = 12;
  document::set_key(document, 1);
  apply_pose(document, 0);
  document::set_key(document, 12);
  document::set_weight_key(document, 1, 3, 0.25);
  document::set_weight_key(document, 1, 9, 0.75);
  for (const bool linear : {true, false}) {
    CAPTURE(linear);
    document.changed_timeline().linear = linear;
    REQUIRE(save_session(w, files / "s.viete"));
    const Outcome outcome = run("animate s.viete -o a.glb --force", "cd " + quoted(files.path()) + " &&");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    const auto read = formats::read(files / "a.glb");
    const auto clip = read.original->morphs();
    std::vector<std::size_t> own;  // for each vertex of the file, the vertex of the model
    for (const mesh::Point& p : read.surface.positions) {
      const auto to_p = [&](const mesh::Point& q) { return mesh::norm(p - q); };
      const auto& rest = document.model().surface->positions;
      own.push_back(static_cast<std::size_t>(std::ranges::min_element(rest, {}, to_p) - rest.begin()));
    }
    if (linear) CHECK(clip->targets() == std::vector<std::string>{"frame 12", "by 70"});
    if (!linear) CHECK(clip->targets().size() > 2);
    for (const int frame : {1, 3, 6, 8, 12}) {
      go_to_frame(w, frame);
      REQUIRE(document.shape());
      const auto shown = mesh::picked<mesh::Point>(*document.shape(), own);
      CHECK(largest_distance(shown, clip->at((frame - 1) / 24.0)) < (linear ? 1e-6 : 4e-4));
    }
  }
}

TEST_CASE("an_animation_that_was_killed_has_whole_frames") {
  const AnimatedDragon d;
  for (const char* signal : {"INT", "HUP", "KILL"}) {
    CAPTURE(signal);
    const std::string out = std::string(signal) + "_##.ply";
    const Outcome ended = ended_by(signal, d.path(), d.line("-o '" + out + "'"),
                                   std::string(signal) + "_03.ply", std::string(signal) + "_*");
    if (std::string(signal) != "KILL") {
      CHECK_MESSAGE(mentions(ended, "stopped; files written so far are complete"), ended.text);
      CHECK(names_of(d.path(), ".part").empty());
    }
    const base::NumberedName name(d / out);
    const auto there = name.find();
    CHECK(there.size() >= 3);
    CHECK(there.size() < 41);
    for (const auto& file : there) CHECK(formats::read(file.path).surface.positions.size() == 3000);
  }
}

TEST_CASE("existing_frames_need_force_and_those_of_an_earlier_run_are_noted") {
  const AnimatedFiles files;
  CHECK_FALSE(mentions(files.animate("-o f_##.ply --frames 1-6"), "existed"));
  const Outcome refused = files.animate("-o f_##.ply --frames 1-5");
  CHECK(refused.code == 1);
  CHECK(mentions(refused, "--force"));
  CHECK_FALSE(mentions(files.animate("-o f_##.ply", "VIETE_PROGRESS=1"),
                       "--force"));  // not for a child process of the window
  CHECK(mentions(files.animate("-o f_##.ply --frames 1-5 --force"), "f_06.ply already existed"));
  CHECK(mentions(files.animate("-o f_##.ply --frames 2-6 --step 2 --force"),
                 "3 files from f_01.ply to f_05.ply already existed"));
  CHECK_FALSE(mentions(files.animate("-o s_##.png --frames 4-6 --size 64x48 --no-grid"), "existed"));
  CHECK(mentions(files.animate("-o s_##.png --frames 4-5 --size 64x48 --no-grid --force"),
                 "s_06.png already existed"));
}

TEST_CASE("several_programs_share_the_frames") {
  const AnimatedFiles files;
  put_file(files / "share.sh", "for r in 1-6 7-12 13-17; do '" + build_dir().string() +
                                   "/viete' animate model.obj cage.obj --keys 'p_##.obj' -o 'f_##.ply' "
                                   "--frames $r & done; wait");
  run("--version >/dev/null; cd " + quoted(files.path()) + " && sh share.sh");
  CHECK(base::NumberedName(files / "f_##.ply").find().size() == 17);
}

TEST_CASE("partial_files_of_a_killed_command_are_deleted_by_the_next_one") {
  const AnimatedFiles files;
  const fs::path part = files / "b.obj.999999999-1-0.part";
  put_file(part, "half");
  CHECK(files.animate("-o p_##.obj").code == 1);  // the command fails, but deletes the partial file
  CHECK_FALSE(fs::exists(part));
}

TEST_CASE("animate_reports_invalid_requests_before_the_work") {
  const AnimatedFiles files;
  const auto says = [&](const std::string& rest, int code, const std::string& text) {
    const Outcome outcome = files.animate(rest);
    CHECK(outcome.code == code);
    CHECK_MESSAGE(mentions(outcome, text), outcome.text);
  };
  says("-o a.pc2 --frames 5-1", 2, "needs FIRST-LAST, such as 1-48, not 5-1");
  says("-o a.pc2 --frames x", 2, "needs FIRST-LAST");
  says("-o a.png", 1, "write numbered pictures");
  says("-o f_##.mp4", 1, "a film stores all frames in one file");
  says("-o p_##.obj", 1, "p_01.obj: this is an input file (the keys)");
  CHECK(mentions(run("animate model.obj cage.obj -o a.pc2", "cd " + quoted(files.path()) + " &&"),
                 "--keys is required"));
}
