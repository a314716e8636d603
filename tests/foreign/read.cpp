// The reader of foreign files with programs that replace viete-import: they crash, hang or send other bytes.
#include "foreign/read.h"

#include <atomic>
#include <thread>

#include "base/error.h"
#include "foreign/full_scene.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;
using test::mentions;

namespace {

// A folder with a file a.fbx and a shell script that reads it.
struct Import : test::TemporaryFolder {
  explicit Import(const std::string& script) {
    test::put_file(*this / "a.fbx", "any content");
    test::put_file(*this / "import", "#!/bin/sh\ncd \"${0%/*}\"\n" + script + "\n");
    std::filesystem::permissions(*this / "import", std::filesystem::perms::owner_all);
    test::set_environment("VIETE_IMPORT", (*this / "import").string());
  }
  ~Import() { unsetenv("VIETE_IMPORT"); }

  formats::ReadResult read(base::Progress* progress = nullptr, double most_seconds = 60) const {
    return foreign::read(*this / "a.fbx", progress, false, most_seconds);
  }
  std::string problem(double most_seconds = 60) const {
    return test::problem_of([&] { read(nullptr, most_seconds); });
  }
};

}  // namespace

TEST_CASE("a_scene_becomes_a_surface_with_attributes_notes_and_morph_targets") {
  const Import import("cat scene");
  foreign::Scene scene = test::full_scene();
  test::put_file(import / "scene", bytes_of(scene));
  CHECK(mentions(import.problem(), "an image is not in the folder of the file"));
  scene.attributes.images[0].path = import / "a.png";
  test::put_file(import / "a.png", "an image");
  test::put_file(import / "scene", bytes_of(scene));
  const formats::ReadResult read = import.read();
  CHECK(read.format == "FBX");
  CHECK(read.surface.triangles.size() == 3);
  CHECK(read.attributes->materials[1].name == "wood");
  CHECK(read.warnings == std::vector{(import / "a.fbx").string() + ": a note"});
  CHECK(read.original->beyond_attributes() == std::vector<std::string>{"skins"});
  CHECK(read.original->files_beside() == std::vector{import / "a.png"});
  const auto morphs = read.original->morphs();
  CHECK(morphs->targets() == std::vector<std::string>{"smile"});
  CHECK(morphs->at_target(0)[4][2] == 3);
  CHECK(morphs->at(0) == read.surface.positions);
}

TEST_CASE("a_child_that_crashes_hangs_or_sends_garbage_is_an_error_of_the_file") {
  for (const char* script : {"kill -SEGV $$", "exit 3", "kill -KILL $$", "cat scene; exit 1"})
    CHECK(mentions(Import(script).problem(),
                   "a.fbx: Assimp could not read this FBX file: it crashed, or used too much memory or time; "
                   "convert it to glTF or OBJ in another program"));
  CHECK(mentions(Import("sleep 100").problem(0.05), "it took longer than 0.05 seconds"));
  CHECK(mentions(Import("echo Hello").problem(), "sent no valid scene: the output has no signature"));
  CHECK(mentions(Import("true").problem(), "sent no valid scene"));
  const Import half("head -c 300 scene");
  test::put_file(half / "scene", bytes_of(test::full_scene()));
  CHECK(mentions(half.problem(), "sent no valid scene: the output ends early"));
}

TEST_CASE("the_reason_of_assimp_is_part_of_the_error") {
  const Import import("cat scene");
  foreign::Scene failed;
  failed.failure = "no \x1b[1mvertices\n";
  test::put_file(import / "scene", bytes_of(failed));
  CHECK(mentions(import.problem(), "Assimp could not read this FBX file: no \\x1B[1mvertices\\n; convert"));
  test::put_file(import / "scene", bytes_of([] {
                   foreign::Scene empty;
                   empty.polygon_starts = {0};
                   return empty;
                 }()));
  CHECK(mentions(import.problem(), "no vertices found in this FBX file"));
}

TEST_CASE("a_missing_program_or_file_is_named") {
  const Import import("true");
  std::filesystem::remove(import / "import");
  CHECK(mentions(import.problem(),
                 "a.fbx: FBX files are read by viete-import: this program is not installed; install Assimp"));
  std::filesystem::remove(import / "a.fbx");
  CHECK(mentions(import.problem(), "there is no such file"));
}

TEST_CASE("progress_moves_and_cancelling_ends_the_child") {
  const Import import("echo $$ > number; echo '50 %' >&2; sleep 100");
  base::Progress progress;
  std::atomic<bool> cancelled = false;
  std::thread reader([&] {
    try {
      import.read(&progress);
    } catch (const base::Cancelled&) {
      cancelled = true;
    }
  });
  while (progress.done() < 0.39) std::this_thread::yield();
  progress.cancel();
  reader.join();
  CHECK(cancelled);
  std::string number = test::file_bytes(import / "number");
  number.pop_back();
  const std::string state = test::file_bytes("/proc/" + number + "/stat");
  CHECK((state.empty() || mentions(state, ") Z")));
}

TEST_CASE("other_formats_are_read_without_a_child") {
  const Import import("kill -SEGV $$");
  test::put_file(import / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(foreign::read(import / "a.obj").surface.positions.size() == 3);
}
