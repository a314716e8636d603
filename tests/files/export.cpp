#include "files/export.h"

#include "files/animation_export.h"
#include "formats/read.h"
#include "support/files.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;

namespace {

Document posed(const test::CubeFiles& files) {
  Document document = open_document(files.model, files.cage);
  document.changed_pose().positions[0][0] -= 0.25;
  return document;
}

}  // namespace

TEST_CASE("a_deformed_model_is_written_in_every_format") {
  const test::CubeFiles files;
  const Document document = posed(files);
  std::vector<mesh::Point> first;
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    CAPTURE(name);
    base::Progress progress;
    Export all = export_of(document, files / name);
    all.digits.kind = formats::Digits::Kind::all;
    CHECK(write_deformed(all, &progress).empty());
    CHECK(progress.done() >= 0.5);
    const auto written = formats::read(files / name).surface;
    CHECK(written.triangles.size() == document.model().surface->triangles.size());
    if (std::string(name) == "a.stl") continue;
    CHECK(written.triangles == document.model().surface->triangles);
    CHECK(written.positions != document.model().surface->positions);
    if (first.empty()) first = written.positions;
    CHECK(written.positions == first);
  }
}

TEST_CASE("a_model_at_rest_is_exported_byte_for_byte") {
  const test::CubeFiles files;
  const Document document = open_document(files.model, files.cage);
  for (const char* name : {"same.obj", "model.obj"}) {  // model.obj is the opened file
    const std::string before = test::file_bytes(files.model);
    CHECK(write_deformed(export_of(document, files.model.parent_path() / name)).empty());
    CHECK(test::file_bytes(files.model.parent_path() / name) == before);
  }
}

TEST_CASE("at_rest_a_stitched_model_is_exported_to_the_last_bit_too") {
  const test::CubeFiles files;
  Export all = export_of(open_document(files.model, files.cage), files / "same.ply");
  mesh::Surface third = *all.model;
  for (auto& p : third.positions) p = {p[0] / 3, p[1] / 7, p[2] / 11};
  all.model = std::make_shared<const mesh::Surface>(third);
  all.original.reset();
  all.attributes.reset();
  all.deformer.iterations = 3;
  write_deformed(all);
  CHECK(formats::read(files / "same.ply").surface.positions == third.positions);
}

TEST_CASE("an_export_is_a_snapshot_at_the_request") {
  const test::CubeFiles files;
  Document document = posed(files);
  const Export before = export_of(document, files / "before.ply");
  write_deformed(export_of(document, files / "at_once.ply"));
  document.changed_pose().positions[0][0] -= 3;
  document.put_method(sym3::Method::diag);
  document.put_deformer(pose::deformer_of(pose::Preset::mean_value));
  write_deformed(before);
  CHECK(test::file_bytes(files / "before.ply") == test::file_bytes(files / "at_once.ply"));
}

TEST_CASE("an_export_that_is_stopped_or_fails_leaves_the_file_as_it_was") {
  const test::CubeFiles files;
  const Document document = posed(files);
  const std::string before = test::file_bytes(files.cage);
  base::Progress progress;
  progress.cancel();
  CHECK_THROWS_AS(write_deformed(export_of(document, files.cage), &progress), base::Cancelled);
  CHECK(test::file_bytes(files.cage) == before);
  CHECK_THROWS_AS(write_deformed(export_of(document, files / "none" / "a.obj")), base::Error);
  CHECK_THROWS_AS(write_deformed(export_of(document, files / "a.xyz")), base::Error);
}

TEST_CASE("a_method_is_named_with_its_error_only_where_that_matters") {
  CHECK(method_notes(sym3::Method::fast, 0).empty());
  CHECK(method_notes(sym3::Method::sd, 1e-10).empty());
  const std::string note = method_notes(sym3::Method::sd, 2.84e-6).at(0);
  for (const char* part : {"method sd", "2.9e-06", "fast"}) CHECK_MESSAGE(test::mentions(note, part), note);
  CHECK(test::mentions(method_notes(sym3::Method::improved_sd, INFINITY).at(0), "gives NaN"));
}

TEST_CASE("captures_are_refused_before_they_are_deformed") {
  const test::CubeFiles files;
  const auto file = files / "capture.ply";
  test::put_file(
      file,
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float scale_0\nproperty float rot_0\nend_header\n0 0 0 -4 1\n0.5 0 0 -4 1\n");
  const Document document = open_document(file, files.cage);
  const auto refused = doctest::Contains("is a capture (Gaussian splats)");
  CHECK_THROWS_WITH_AS(check_deformable(document), refused, base::Error);
  CHECK_THROWS_WITH_AS(write_deformed(export_of(document, files / "out.ply")), refused, base::Error);
  for (const char* name : {"out.pc2", "out.glb", "out_####.obj"})
    CHECK_THROWS_WITH_AS(check_animation_export(animation_export_of(document, files / name)), refused,
                         base::Error);
}
