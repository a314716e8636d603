#include "scene/document/document.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "mesh/formats/write.h"
#include "scene/cube.h"
#include "scene/document/edit.h"
#include "scene/files.h"
#include "scene/workspace/taking.h"
#include "support/open.h"

using namespace viete;
using namespace viete::scene;
namespace fs = std::filesystem;

namespace {

struct Files {
  fs::path folder = fs::temp_directory_path() / "viete-test-document";
  fs::path model = folder / "model.obj", cage = folder / "cage.obj", pose = folder / "pose.obj",
           broken = folder / "broken.obj";

  Files() {
    fs::create_directories(folder);
    mesh::write(model, test::cube(1));
    mesh::write(cage, test::cube(1.5));
    mesh::write(pose, test::cube(2));
    std::ofstream(broken) << "v 0 0 0\nf 1 2 3\n";
  }
  ~Files() { fs::remove_all(folder); }
};

}  // namespace

TEST_CASE("sizes_that_float_can_draw_are_told_from_those_that_it_cannot") {
  const test::CubeFiles files;
  for (const double size : {1e-60, 1e-30, 1.0, 1e30, 1e60}) {
    mesh::write(files / "sized.obj", test::cube(size));
    const auto document = open_document(files / "sized.obj", {});
    if (size > 1e-31 && size < 1e31) {
      CHECK_NOTHROW(check_drawable(document));
    } else {
      CHECK_THROWS_WITH_AS(check_drawable(document), doctest::Contains("sized.obj: a size of"), base::Error);
      Workspace w;
      CHECK_FALSE(test::load_model(w, files / "sized.obj", {}));
      CHECK_FALSE(w.document.model.surface);
    }
  }
}

TEST_CASE("sizes_that_double_can_deform_are_told_from_those_that_it_cannot") {
  const test::CubeFiles files;
  const fs::path model = files / "sized.obj", cage = files / "sized_cage.obj";
  for (const double size : {1e-61, 1e-59, 1.0, 1e59, 1e61}) {
    mesh::write(model, test::cube(size));
    mesh::write(cage, test::cube(1.5 * size));
    auto document = open_document(model, cage);
    if (size > 1e-60 && size < 1e60) {
      CHECK_NOTHROW(check_deformable(document));
      document.pose.positions[0][1] = 1e61;
      CHECK_THROWS_WITH_AS(check_deformable(document), doctest::Contains("sized_cage.obj: a size"),
                           base::Error);
    } else {
      CHECK_THROWS_WITH_AS(check_deformable(document), doctest::Contains("sized.obj: a size of"),
                           base::Error);
    }
  }
  auto point = test::cube(0);  // but far away
  for (auto& p : point.positions) p[2] = 1e70;
  mesh::write(model, point);
  CHECK_THROWS_AS(check_deformable(open_document(model, {})), base::Error);
}

TEST_CASE("a_pose_that_cannot_be_drawn_is_refused_and_the_old_one_stays") {
  const test::CubeFiles files;
  Workspace w;
  REQUIRE(test::load_model(w, files.model, files.cage));
  mesh::write(files / "far.obj", test::cube(1e40));
  const auto before = w.document.pose.positions;
  CHECK_FALSE(open_now(w, {OpenRequest::What::pose, {files / "far.obj"}}));
  CHECK(w.messages.all().back().text.find("cannot be drawn") != std::string::npos);
  CHECK(w.document.pose.positions == before);
}

TEST_CASE("opening_a_model_and_a_cage_fills_a_document") {
  const Files files;
  const Document document = open_document(files.model, files.cage);
  CHECK(document.model.summary.vertices == 8);
  CHECK(document.has_cage());
  CHECK_FALSE(differs_from_rest(document));
  CHECK_FALSE(open_document(files.model, {}).has_cage());
}

TEST_CASE("a_broken_file_leaves_the_open_document_as_it_was_and_says_why") {
  const Files files;
  Workspace w;
  REQUIRE(test::load_model(w, files.model, files.cage));
  const auto* surface = w.document.model.surface.get();
  w.document.pose.positions[0][0] += 1;
  const auto pose = w.document.pose.positions;
  const auto topology = w.document.revisions().surfaces;
  CHECK_FALSE(test::load_model(w, files.broken, {}));
  CHECK_FALSE(test::load_model(w, files.model, files.broken));
  CHECK_FALSE(test::load_cage(w, files.broken));
  CHECK_FALSE(test::load_cage(w, files.folder / "missing.obj"));
  CHECK_FALSE(test::load_pose(w, files.broken));
  CHECK(w.document.model.surface.get() == surface);
  CHECK(w.document.pose.positions == pose);
  CHECK(w.document.revisions().surfaces == topology);
  CHECK(w.messages.all().back().severity == Severity::error);
  for (const char* name : {"broken.obj", "missing.obj"})
    CHECK(std::ranges::any_of(w.messages.all(),
                              [&](const Message& m) { return m.text.find(name) != std::string::npos; }));
}

TEST_CASE("a_pose_is_one_undoable_edit") {
  const Files files;
  Workspace w;
  REQUIRE(test::load_model(w, files.model, files.cage));
  REQUIRE(test::load_pose(w, files.pose));
  CHECK(w.document.pose.positions == test::cube(2).positions);
  undo(w.document);
  CHECK_FALSE(differs_from_rest(w.document));
}

TEST_CASE("a_pose_or_a_cage_without_a_document_is_refused_with_advice") {
  const Files files;
  Workspace w;
  CHECK_FALSE(test::load_cage(w, files.cage));
  CHECK_FALSE(test::load_pose(w, files.pose));
  CHECK(w.messages.all().back().text.find("open the cage first") != std::string::npos);
}

TEST_CASE("loading_keeps_method_way_and_radius") {
  const Files files;
  Workspace w;
  w.document.method = sym3::Method::diag;
  w.document.scheme = deform::scheme_of(deform::Way::mean_value);
  w.document.scheme.weighting.radius = 0.3;
  REQUIRE(test::load_model(w, files.model, files.cage));
  CHECK(w.document.method == sym3::Method::diag);
  CHECK(w.document.scheme == deform::scheme_of(deform::Way::mean_value));
  CHECK(w.document.scheme.weighting.radius == 0.3);
}
