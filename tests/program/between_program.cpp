// viete between, viete mix and viete pose: these commands interpolate, mix and pose shapes.

#include "base/numbered_files.h"
#include "formats/morph_keys.h"
#include "formats/read.h"
#include "program/command_line.h"
#include "support/files.h"
#include "support/pictures.h"
#include "support/posed_cube.h"
#include "workspace/command.h"
#include "workspace/open_save.h"
#include "workspace/playing.h"

using namespace viete;
using namespace viete::test;

namespace {

using Points = std::vector<mesh::Point>;

// Files of a cube at rest and of its shapes a.obj and b.obj. s_1 to s_3 are copies of these files.
struct ShapeFiles : WorkFolder {
  mesh::Surface cube = CubeFiles::subdivided_cube();

  ShapeFiles() {
    write("rest.obj", cube.positions);
    write("a.obj", shape(100));
    write("b.obj", shape(170, 1));
    write("s_1.obj", cube.positions);
    write("s_2.obj", shape(100));
    write("s_3.obj", shape(170, 1));
  }
  Points shape(double degrees, double pull = 0) const {
    Points points = cube.positions;
    points[7][2] += pull;
    return turned(points, degrees);
  }
  void write(const std::string& name, const Points& points) const {
    formats::write(*this / name, {cube, points, {}}, nullptr, {});
  }
  Points read(const std::string& name) const { return formats::read(*this / name).surface.positions; }
};

}  // namespace

TEST_CASE("between_two_shapes_a_turn_is_halfway_at_half_of_its_angle") {
  const ShapeFiles f;
  f.write("half.obj", f.shape(180));
  f.write("less.obj", f.shape(178));
  CHECK(f.done("between rest.obj less.obj -o m.ply --at 0.5").text == "");
  CHECK(distance(f.read("m.ply"), f.shape(89)) < 1e-6);
  f.done("between rest.obj half.obj -o m.ply --at 0.5 --linear");
  for (const auto& p : f.read("m.ply")) CHECK(std::hypot(p[0], p[1]) < 1e-6);
  f.done("between rest.obj a.obj --rest half.obj -o m.ply --at 0.25");
  CHECK(distance(f.read("m.ply"), f.shape(25)) < 1e-6);
}

TEST_CASE("shapes_that_were_named_come_out_with_their_very_numbers") {
  const ShapeFiles f;
  for (const char* option : {"", " --linear", " --constant-speed", " --rest b.obj"}) {
    CAPTURE(option);
    int at = 0;
    for (const char* name : {"rest.obj", "a.obj", "b.obj"}) {
      f.done("between rest.obj a.obj b.obj -o m.obj --digits all --at " + std::to_string(at++) + option);
      CHECK(f.read("m.obj") == f.read(name));
    }
    f.done(std::string("between rest.obj a.obj b.obj -o 'f_#.obj' --frames 5 --digits all --force") + option);
    CHECK(f.read("f_1.obj") == f.read("rest.obj"));
    CHECK(f.read("f_3.obj") == f.read("a.obj"));
    CHECK(f.read("f_5.obj") == f.read("b.obj"));
  }
  f.done("between rest.obj a.obj --loop -o 'l_#.obj' --frames 7");
  CHECK(file_bytes(f / "l_1.obj") == file_bytes(f / "l_7.obj"));
  CHECK(file_bytes(f / "l_1.obj") == file_bytes(f / "rest.obj"));
  CHECK(file_bytes(f / "l_2.obj") != file_bytes(f / "l_1.obj"));
}

TEST_CASE("between_writes_numbered_models_caches_and_morph_targets_of_any_shapes") {
  const ShapeFiles f;
  CHECK(
      mentions(f.done("between s_#.obj -o 'f_##.ply'"), "f_##.ply: 25 frames, deformed in double precision"));
  CHECK(base::NumberedName(f / "f_##.ply").find().size() == 25);
  for (const std::string name : {"c.pc2", "c.mdd"}) {
    f.done("between rest.obj a.obj b.obj -o " + name + " --frames 9 --rate 12");
    const formats::PointCache cache(f / name);
    CHECK(cache.head().frames == 9);
    CHECK(distance(cache.frame(4), f.shape(100)) < 1e-6);
    f.done("between --rest rest.obj " + name + " -o 'n_#.obj' --frames 9 --force");
    CHECK(distance(f.read("n_9.obj"), f.shape(170, 1)) < 1e-6);
  }
  CHECK(mentions(f.done("between rest.obj a.obj b.obj -o c.glb"), "morph targets with linear interpolation"));
  f.done("between rest.obj c.glb -o m.obj --at 1");
  CHECK(distance(f.read("m.obj"), f.cube.positions) > 1e-3);
  f.done("between s_#.obj -o smooth.pc2 --frames 9");
  f.done("between s_#.obj -o even.pc2 --frames 9 --constant-speed");
  CHECK(file_bytes(f / "smooth.pc2") == file_bytes(f / "c.pc2"));
  CHECK(file_bytes(f / "smooth.pc2") != file_bytes(f / "even.pc2"));
}

TEST_CASE("attributes_of_the_model_are_kept_between_shapes") {
  const ShapeFiles f;
  const std::string
      begin = "# mine\r\nmtllib m.mtl\r\no Cloth\r\nv 0 0 0 1 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n",
      end = "v 9 9 9\r\nvt 0 0\r\nvt 1 0\r\nvt 1 1\r\ng left\r\nusemtl red\r\nf 1/1 2/2 3/3 4/1\r\np 5\r\n";
  put_file(f / "m.mtl", "newmtl red\nKd 1 0 0\n");
  put_file(f / "quad.obj", begin + end);
  std::string lifted = begin;
  lifted.replace(lifted.find("v 1 1 0"), 7, "v 1 1 4");
  put_file(f / "lifted.obj", lifted + end);
  f.done("between quad.obj lifted.obj -o m.obj --at 0");
  CHECK(file_bytes(f / "m.obj") == file_bytes(f / "quad.obj"));
  f.done("mix quad.obj --shape lifted.obj=0.5 -o m.obj --linear");
  lifted.replace(lifted.find("v 1 1 4"), 7, "v 1 1 2");
  CHECK(file_bytes(f / "m.obj") == lifted + end);
}

TEST_CASE("the_shapes_of_a_mix_are_options_with_their_weights_and_any_name") {
  const ShapeFiles f;
  f.done("mix --shape a.obj=2.5 rest.obj -o m.ply");
  CHECK(distance(f.read("m.ply"), f.shape(250)) < 1e-6);
  f.done("mix rest.obj --shape a.obj=-1 --shape=a.obj=0.25 -o m.ply");
  CHECK(distance(f.read("m.ply"), f.shape(-75)) < 1e-6);
  f.write("a b=c:d.obj", f.shape(100));
  f.done("mix rest.obj --shape 'a b=c:d.obj=1' -o 'm m.obj' --digits all");
  CHECK(f.read("m m.obj") == f.read("a.obj"));
}

TEST_CASE("a_shape_of_a_file_that_holds_several_is_named_behind_a_colon") {
  const ShapeFiles f;
  const Points smile = f.shape(20, 0.5), frown = f.shape(-30);
  test::write_morphs(f / "face.glb", {f.cube, f.cube.positions, {}}, nullptr,
                     test::MorphAnimation{"", {{0, "smile", smile}, {1, "a:b=c", frown}}});
  f.done("mix rest.obj --shape face.glb:smile=1 -o m.ply");
  CHECK(distance(f.read("m.ply"), smile) < 1e-6);
  f.done("mix rest.obj --shape face.glb:a:b=c=1 -o m.ply");
  CHECK(distance(f.read("m.ply"), frown) < 1e-6);
  f.refused("mix rest.obj --shape face.glb=1 -o m.ply", 1,
            "face.glb: it contains several shapes; append one of these names after a colon: smile, a:b=c");
  f.refused("mix rest.obj --shape face.glb:grin=1 -o m.ply", 1,
            "it contains no shape named grin; append one");
  f.done("between rest.obj a.obj -o c.pc2 --frames 20");
  f.done("mix rest.obj --shape 'c.pc2:frame 20=1' -o m.ply");
  CHECK(distance(f.read("m.ply"), f.shape(100)) < 1e-6);
  f.refused("mix rest.obj --shape c.pc2=1 -o m.ply", 1, "frame 11, frame 12 ...");
}

TEST_CASE("shapes_that_are_none_and_files_that_are_read_are_refused") {
  const ShapeFiles f;
  formats::write(f / "other.obj", test::cube(1));
  put_file(f / "broken.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  put_file(f / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  put_file(f / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  put_file(f / "s.viete", R"({"format": "viete session", "version": 1, "model": "rest.obj"})");
  const std::pair<const char*, const char*> cases[] = {
      {"between rest.obj other.obj -o m.ply --at 1", "other.obj: the file has 8 vertices"},
      {"between rest.obj broken.obj -o m.ply --at 1", "broken.obj:2: coordinate \"nan\""},
      {"between broken.obj rest.obj -o m.ply --at 1", "broken.obj:2: coordinate \"nan\""},
      {"between rest.obj none.obj -o m.ply --at 1", "none.obj: there is no such file"},
      {"between rest.obj 'none_#.obj' -o m.ply --at 1", "no file matches this name"},
      {"between 'none_#.obj' -o m.ply --at 1", "no file matches this name"},
      {"between points.obj points.obj -o m.ply --at 1",
       "points.obj: shapes need a model with faces, and this model has only points"},
      {"mix flat.obj --shape flat.obj=1 -o m.ply", "flat.obj: all faces of this model have zero area"},
      {"between c.pc2 -o m.ply --at 1",
       "c.pc2: a point cache has no faces; name the mesh file of the rest shape"},
      {"between s.viete a.obj -o m.ply --at 1", "s.viete: this is a session"},
      {"mix s.viete --shape a.obj=1 -o m.ply", "s.viete: this is a session"},
      {"between rest.obj -o m.ply --at 1", "a single shape cannot be interpolated"},
      {"between rest.obj a.obj -o rest.obj --at 1", "an input file (the model)"},
      {"between rest.obj a.obj -o a.obj --at 1", "an input file (a shape)"},
      {"mix rest.obj --shape a.obj=1 -o a.obj", "an input file (a shape)"},
      {"between rest.obj 's_#.obj' -o 's_#.obj' --force", "s_1.obj: this is an input file"},
      {"between rest.obj a.obj -o m.obj", "this format stores only one frame per file; use a numbered name"},
      {"between rest.obj a.obj -o m.png", "unknown extension .png"},
      {"between rest.obj a.obj -o m.pc2 --at 1", "unknown extension .pc2"},
      {"between rest.obj a.obj b.obj -o m.pc2 --frames 2", "2 frames are too few for 3 shapes"},
      {"between rest.obj a.obj -o m.ply --at 1.5", "is beyond the last shape, which is at 1"}};
  for (const auto& [words, said] : cases) f.refused(words, 1, said);
  Points large = f.cube.positions;
  for (auto& p : large) p = 1e12 * p;
  f.write("large.obj", large);
  f.refused("mix rest.obj --shape large.obj=3 -o m.ply", 1, "m.ply: the mix is too large to draw");
  CHECK_FALSE(fs::exists(f / "m.ply"));
}

TEST_CASE("between_and_mix_report_wrong_words_before_reading") {
  const ShapeFiles f;
  f.refused("between -o m.pc2", 2, "SHAPES is required");
  f.refused("between rest.obj a.obj", 2, "--output is required");
  f.refused("between rest.obj a.obj -o m.pc2 --frames 1", 2, "needs a whole number from 2 to 100,000, not 1");
  f.refused("between rest.obj a.obj -o m.ply --at -1", 2, "--at: needs a number from 0 to 100,000, not -1");
  f.refused("between rest.obj a.obj -o m.ply --at 1 --frames 3", 2, "excludes");
  f.refused("between rest.obj a.obj -o m.pc2 --rate 0", 2, "needs a number from 1 to 240, not 0");
  f.refused("mix rest.obj -o m.ply", 2, "--shape is required");
  f.refused("mix rest.obj --shape a.obj=1 b.obj=1 -o m.ply", 2, "unexpected arguments of viete mix: b.obj=1");
  for (const char* bad : {"a.obj", "a.obj=", "=1", "a.obj=x", "a.obj=nan", "a.obj=4", "a.obj=-2.5", "''"})
    f.refused("mix rest.obj -o m.ply --shape " + std::string(bad), 2,
              "needs FILE=WEIGHT, such as smile.obj=0.5, with a weight from -2 to 3, not ");
}

TEST_CASE("pose_finds_the_example_that_its_pins_are_of") {
  const ShapeFiles f;
  const Points bent = f.shape(100);
  std::string pins;
  for (const int v : {0, 3, 5, 6, 8}) {
    char text[100];
    std::snprintf(text, sizeof text, " --pin %d=%.17g,%.17g,%.17g", v, bent[v][0], bent[v][1], bent[v][2]);
    pins += text;
  }
  const Outcome outcome = f.done("pose --examples a.obj --examples b.obj" + pins +
                                 " --restraint 0 -o p.obj --digits all rest.obj");
  CHECK(mentions(outcome, "largest distance of a pin to its target 0.00 %"));
  CHECK(mentions(outcome, "  b"));
  CHECK(distance(f.read("p.obj"), bent) < 1e-4);
  f.done("pose rest.obj --pin 0=5,5,5 --pull 7=9,9,9 -o q.ply");
  f.done("pose rest.obj --examples 's_#.obj' --pin 0=5,5,5 -o r.glb");
}

TEST_CASE("pose_says_what_is_wrong_with_its_pins") {
  const ShapeFiles f;
  const struct {
    const char* pins;
    int code;
    const char* said;
  } cases[] = {{"", 2, "--pin"},
               {"--pin 0=1,2", 2, "VERTEX=x,y,z"},
               {"--pin 0=1,2,nan", 2, "VERTEX=x,y,z"},
               {"--pin -1=1,2,3", 2, ""},
               {"--pin 1=1,2,3 --freedom 2", 2, "--freedom"},
               {"--pin 999=1,2,3", 1, "vertex 999"},
               {"--pin 1=1,2,3 --pull 1=3,2,1", 1, "pinned twice"},
               {"--pin 1=1e60,2,3 --pin 2=0,0,0", 1, "too large to draw"}};
  for (const auto& c : cases) f.refused(std::string("pose rest.obj -o p.obj ") + c.pins, c.code, c.said);
  f.refused("pose rest.obj --pin 1=1,2,3 -o rest.obj", 1, "rest.obj");
  CHECK(!fs::exists(f / "p.obj"));
}

TEST_CASE("a_session_with_shapes_is_deformed_animated_and_drawn_as_the_window_has_it") {
  const ShapeFiles f;
  workspace::Workspace w;
  REQUIRE(open_now(w, {files::OpenRequest::What::model, {f / "rest.obj"}}));
  document::add_shapes(w.document, {{"a", std::make_shared<const Points>(f.shape(100))}});
  REQUIRE(document::set_weight(w.document, w.playback.vectors, 0, 0.5));
  REQUIRE(workspace::save_session(w, f / "mixed.viete"));
  f.done("deform mixed.viete -o d.ply");
  CHECK(distance(f.read("d.ply"), f.shape(50)) < 1e-6);
  REQUIRE(document::set_weight(w.document, w.playback.vectors, 0, 0));
  workspace::find_command("set_key")->run(w);
  workspace::apply_pose(w, 0);
  w.document.put_frame(11);
  workspace::find_command("set_key")->run(w);
  REQUIRE(w.document.timeline().keys.size() == 2);
  REQUIRE(workspace::save_session(w, f / "keyed.viete"));
  f.done("animate keyed.viete -o 'k_##.obj' --frames 1-11");
  CHECK(f.read("k_01.obj") == f.cube.positions);
  CHECK(distance(f.read("k_06.obj"), f.shape(50)) < 1e-5);
  CHECK(distance(f.read("k_11.obj"), f.shape(100)) < 1e-5);
  f.done("animate keyed.viete -o 's_##.obj' --frames 6-6 --linear");
  CHECK(distance(f.read("s_06.obj"), f.shape(50)) > 0.05);
  f.done("render mixed.viete --size 200x150 -o mixed.png");
  f.done("render rest.obj --size 200x150 -o rest.png");
  CHECK(difference(read_png(f / "mixed.png"), read_png(f / "rest.png"), 8) > 0.01);
}
