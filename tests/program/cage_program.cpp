// viete cage: makes cages. Other commands must accept these cages.

#include "formats/read.h"
#include "formats/write.h"
#include "program/command_line.h"
#include "support/cube.h"

using namespace viete;
using namespace viete::test;

namespace {

struct CageFolder : WorkFolder {
  CageFolder() { formats::write(*this / "model.obj", cube(1)); }
};

}  // namespace

TEST_CASE("a_generated_cage_deforms_its_model_and_passes_the_checks") {
  const CageFolder files;
  const Outcome made = files.done("cage " + quoted(dragon) + " -o made.obj --triangles 120");
  CHECK(mentions(made, "made a cage of 1"));
  const mesh::Surface read = formats::read(files / "made.obj").surface;
  CHECK(read.triangles.size() <= 120);
  CHECK(mesh::summarize(read).closed());
  CHECK_FALSE(mentions(files.done("info " + quoted(dragon) + " --cage made.obj"), "outside"));
  files.done("deform " + quoted(dragon) + " made.obj --pose made.obj -o same.ply");
}

TEST_CASE("boxes_and_quads_are_written_in_every_format") {
  const CageFolder files;
  for (const char* name : {"box.obj", "box.ply", "box.off", "box.stl"}) {
    files.done(std::string("cage model.obj --kind box --cells 2x3x1 --margin 5 -o ") + name);
    CHECK(formats::read(files / name).surface.triangles.size() == 44);
  }
  files.done("cage model.obj --quads --triangles 60 -o quads.obj");
  const mesh::Surface quads = formats::read(files / "quads.obj").surface;
  CHECK(quads.polygon_count() < quads.triangles.size());
}

TEST_CASE("a_cage_beyond_the_files_precision_is_not_written") {
  const CageFolder files;
  mesh::Surface far = formats::read(files / "model.obj").surface;
  for (auto& p : far.positions) p[0] += 1e7;
  formats::write(files / "far.obj", far);
  for (auto& p : far.positions) p = {1e50 * (p[0] - 1e7), 1e50 * p[1], 1e50 * p[2]};
  formats::write(files / "large.obj", far);
  for (const char* model : {"far.obj", "large.obj"}) {
    files.refused(std::string("cage ") + model + " --kind box -o made.glb", 1,
                  "made.glb: glTF stores coordinates with 7 digits");
    CHECK_FALSE(fs::exists(files / "made.glb"));
    files.done(std::string("cage ") + model + " --triangles 60 -o made.ply --force");
  }
  files.done("cage model.obj --kind box -o made.glb");
}

TEST_CASE("invalid_cage_settings_and_models_give_an_error") {
  const CageFolder files;
  put_file(files / "point.obj", "v 1 2 3\n");
  put_file(files / "empty.obj", "");
  const std::pair<const char*, const char*> cases[] = {
      {"model.obj --triangles 11", "12 to 20,000"},
      {"model.obj --triangles 20001", "12 to 20,000"},
      {"model.obj --margin 0.01", "0.05 to 20"},
      {"model.obj --gap 21", "0 to 20"},
      {"model.obj --kind sphere", "automatic"},
      {"model.obj --symmetry w", "auto"},
      {"model.obj --kind box --cells 0x1x1", "from 1 to 32"},
      {"model.obj --kind box --cells 2x2", "as 2x3x2"},
      {"model.obj --kind box --cells 1x1x33", "from 1 to 32"},
      {"model.obj --cells 2x2x2", "--cells: has no effect with --kind automatic"},
      {"model.obj --kind box --triangles 50", "has no effect with --kind box"},
      {"point.obj", "single point"},
      {"empty.obj", "empty.obj"},
      {"missing.obj", "there is no such file"},
  };
  for (const auto& [arguments, said] : cases) {
    const Outcome outcome = files.viete(std::string("cage ") + arguments + " -o made.obj");
    CHECK_MESSAGE(outcome.code != 0, arguments);
    CHECK_MESSAGE(outcome.code != 128, arguments);
    CHECK_MESSAGE(mentions(outcome, said), arguments << '\n' << outcome.text);
    CHECK_FALSE(fs::exists(files / "made.obj"));
  }
}
