// What one unit of a file measures: guessed, chosen, kept, and said.
#include "scene/document/length_unit.h"

#include <doctest/doctest.h>

#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "scene/files.h"
#include "scene/files/export.h"
#include "scene/files/open.h"
#include "scene/workspace/saving.h"
#include "scene/workspace/taking.h"
#include "support/commands.h"
#include "support/text.h"

using namespace viete;
using namespace viete::scene;
using test::mentions;

namespace {

LengthUnit unit_said_by(const std::string& comment) {
  return guessed_unit("OBJ", {"3ds Max Wavefront OBJ Exporter v0.97b", comment, "File Created: 01.02.2013"});
}

Workspace opened(const std::filesystem::path& model, const std::filesystem::path& cage = {}) {
  Workspace w;
  std::vector<std::filesystem::path> files{model};
  if (!cage.empty()) files.push_back(cage);
  REQUIRE(open_now(w, {OpenRequest::What::model, files}));
  return w;
}

}  // namespace

TEST_CASE("a_comment_at_the_head_of_a_file_names_its_unit") {
  const std::pair<const char*, LengthUnit> said[] = {{"File units = centimeters", LengthUnit::centimetre},
                                                     {"File units = inches", LengthUnit::inch},
                                                     {" Units: mm", LengthUnit::millimetre},
                                                     {"units are in Meters.", LengthUnit::metre},
                                                     {"1 unit = 1 ft", LengthUnit::foot},
                                                     {"one unit is 1.0 millimetre", LengthUnit::millimetre},
                                                     {"Unit of length: (cm)", LengthUnit::centimetre},
                                                     {"UNITS=in", LengthUnit::inch},
                                                     {"units m", LengthUnit::metre}};
  for (const auto& [comment, unit] : said) {
    CAPTURE(comment);
    CHECK(unit_said_by(comment) == unit);
  }
}

TEST_CASE("what_does_not_name_a_unit_is_not_taken_for_one") {
  for (const char* comment :
       {"", "mm", "in metres", "units", "Unit scale: 1.0", "1 unit = 2 cm", "units unknown",
        "units in the file: 1", "united m", "number of units: 3", "0.01 units per m"}) {
    CAPTURE(comment);
    CHECK(unit_said_by(comment) == LengthUnit::unknown);
  }
  CHECK(guessed_unit("OBJ", {}) == LengthUnit::unknown);
  CHECK(guessed_unit("glTF binary", {}) == LengthUnit::metre);
  CHECK(guessed_unit("glTF text", {"units: mm"}) == LengthUnit::metre);
}

TEST_CASE("numbers_are_said_with_their_unit_or_alone") {
  CHECK(with_unit("12.4", LengthUnit::centimetre) == "12.4 cm");
  CHECK(with_unit("12.4", LengthUnit::foot, 2) == "12.4 ft\u00b2");
  CHECK(with_unit("12.4", LengthUnit::metre, 3) == "12.4 m\u00b3");
  CHECK(with_unit("12.4", LengthUnit::unknown, 3) == "12.4");
}

TEST_CASE("the_unit_comes_with_the_file_stays_with_the_model_and_is_kept_in_sessions") {
  const test::CubeFiles files;
  mesh::write(files / "cm.obj", test::cube(1), {"File units = centimeters"});
  mesh::write(files / "m.glb", test::cube(1));
  CHECK(opened(files.model).document.model.unit == LengthUnit::unknown);
  CHECK(opened(files / "m.glb").document.model.unit == LengthUnit::metre);
  Workspace w = opened(files / "cm.obj");
  CHECK(w.document.model.unit == LengthUnit::centimetre);
  REQUIRE(test::run_command(w, "unit_in"));
  REQUIRE(open_now(w, {OpenRequest::What::cage, {files.cage}}));
  CHECK(w.document.model.unit == LengthUnit::inch);
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(opened(files / "a.viete").document.model.unit == LengthUnit::inch);
  REQUIRE(test::run_command(w, "unit_none"));
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(opened(files / "a.viete").document.model.unit == LengthUnit::unknown);
}

TEST_CASE("a_session_without_a_unit_or_with_one_that_is_not_known_takes_what_the_file_says") {
  const test::CubeFiles files;
  mesh::write(files.model, test::cube(1), {"units: ft"});
  const std::string head = R"({"format": "viete session", "version": 1, "model": "model.obj")";
  test::put_file(files / "a.viete", head + "}");
  CHECK(opened(files / "a.viete").document.model.unit == LengthUnit::foot);
  test::put_file(files / "a.viete", head + R"(, "unit": "furlong"})");
  const Workspace w = opened(files / "a.viete");
  CHECK(w.document.model.unit == LengthUnit::foot);
  CHECK(mentions(w.messages.all().front().text, "furlong"));
}

TEST_CASE("a_new_gltf_file_comes_with_a_word_where_others_will_read_its_numbers_differently") {
  CHECK(gltf_note(LengthUnit::unknown, UpAxis::y).empty());
  CHECK(gltf_note(LengthUnit::metre, UpAxis::y).empty());
  CHECK(mentions(gltf_note(LengthUnit::millimetre, UpAxis::y), "scale by 0.001"));
  CHECK(mentions(gltf_note(LengthUnit::metre, UpAxis::z), "turn by -90 degrees about X"));
  const std::string both = gltf_note(LengthUnit::inch, UpAxis::z);
  CHECK(mentions(both, "0.0254"));
  CHECK(mentions(both, "turn by -90"));

  const test::CubeFiles files;
  mesh::write(files.model, test::cube(1), {"units: cm"});
  const Document document = open_document(files.model, files.cage);
  for (const char* name : {"a.glb", "a.gltf"}) {
    const auto notes = write_deformed(export_of(document, files / name));
    REQUIRE(notes.size() == 1);
    CHECK(mentions(notes[0], "scale by 0.01"));
    const mesh::Bounds written = mesh::used_bounds(mesh::read(files / name).surface);
    CHECK(written.low == document.model.bounds.low);  // not scaled
    CHECK(written.high == document.model.bounds.high);
  }
  CHECK(write_deformed(export_of(document, files / "a.ply")).empty());
  const Document back = open_document(files / "a.glb", files.cage);  // its numbers are taken as metres
  CHECK(write_deformed(export_of(back, files / "b.glb")).empty());
}
