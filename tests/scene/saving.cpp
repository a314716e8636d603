#include "scene/saving.h"

#include <doctest/doctest.h>

#include "mesh/read.h"
#include "scene/edit.h"
#include "scene/files.h"

using namespace viete;
using namespace viete::scene;
namespace fs = std::filesystem;

namespace {

Workspace edited(const test::CubeFiles& files) {
  Workspace w;
  REQUIRE(load_model(w, files.model, files.cage));
  CHECK_FALSE(has_unsaved_edits(w));
  w.document.history.record("move", {w.document.pose, w.document.selection});
  w.document.pose.positions[0][0] -= 0.25;
  CHECK(has_unsaved_edits(w));
  return w;
}

}  // namespace

TEST_CASE("saving_a_session_or_a_pose_makes_edits_saved_and_undo_makes_them_unsaved_again") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(has_unsaved_edits(w));
  undo(w.document);
  CHECK(has_unsaved_edits(w));
  redo(w.document);
  CHECK_FALSE(has_unsaved_edits(w));
  undo(w.document);
  REQUIRE(save_pose(w, files / "p.ply"));
  CHECK_FALSE(has_unsaved_edits(w));
}

TEST_CASE("undoing_to_what_was_opened_leaves_nothing_to_save") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  undo(w.document);
  CHECK_FALSE(has_unsaved_edits(w));
}

TEST_CASE("posed_cage_and_deformed_model_are_written_in_every_format") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  auto positions = w.document.model.surface->positions;
  positions[2][1] += 1.0 / 3;
  for (const char* extension : {".obj", ".ply", ".off", ".stl"}) {
    CAPTURE(extension);
    const bool exact = std::string(extension) != ".stl";
    REQUIRE(save_pose(w, files / (std::string("pose") + extension)));
    REQUIRE(save_model(w, files / (std::string("model") + extension), positions));
    const auto pose = mesh::read(files / (std::string("pose") + extension)).surface;
    const auto model = mesh::read(files / (std::string("model") + extension)).surface;
    CHECK(pose.triangles.size() == w.document.cage->surface.triangles.size());
    CHECK(model.triangles.size() == w.document.model.surface->triangles.size());
    if (exact) CHECK(pose.positions == w.document.pose.positions);
    if (exact) CHECK(model.positions == positions);
  }
}

TEST_CASE("a_failed_save_leaves_file_and_edits_as_they_were") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  const std::string before = test::file_bytes(files.model);
  CHECK_FALSE(save_session(w, files / "none" / "a.viete"));
  CHECK_FALSE(save_pose(w, files / "a.xyz"));
  CHECK_FALSE(save_model(w, files / "none" / "a.obj", w.document.model.surface->positions));
  CHECK(w.messages.all().back().severity == Severity::error);
  CHECK(has_unsaved_edits(w));
  CHECK(w.saved.session.empty());
  CHECK(test::file_bytes(files.model) == before);
}
