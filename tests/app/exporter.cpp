#include "app/exporter.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "scene/files.h"
#include "scene/files/open.h"
#include "support/open.h"

using namespace viete;

namespace {

struct Exports {
  test::CubeFiles files;
  scene::Workspace workspace;
  scene::Messages messages;
  app::Exporter exporter;

  Exports() { REQUIRE(test::load_model(workspace, files.model, files.cage)); }
  void add(const std::string& name) { exporter.add(scene::export_of(workspace.document, files / name)); }
};

}  // namespace

TEST_CASE("exports_are_written_in_turn_and_each_is_said") {
  Exports e;
  for (const char* name : {"a.obj", "b.ply"}) e.add(name);
  CHECK(e.exporter.state().what == "Exporting a.obj, then b.ply");
  for (int i = 0; i < 2; ++i) CHECK_FALSE(e.exporter.follow(e.messages, true));
  CHECK_FALSE(e.exporter.running());
  CHECK(std::filesystem::exists(e.files / "a.obj"));
  CHECK(std::filesystem::exists(e.files / "b.ply"));
  CHECK(e.messages.all().size() == 2);
}

TEST_CASE("one_that_fails_is_returned_and_the_next_is_written") {
  Exports e;
  for (const char* name : {"no/such/folder.obj", "b.ply"}) e.add(name);
  const auto failure = e.exporter.follow(e.messages, true);
  REQUIRE(failure);
  CHECK(failure->file == e.files / "no/such/folder.obj");
  CHECK(e.messages.all().empty());
  CHECK_FALSE(e.exporter.follow(e.messages, true));
  CHECK(std::filesystem::exists(e.files / "b.ply"));
}
