#include "app/file_desk.h"

#include "support/files.h"

using namespace viete;

namespace {

struct Exports {
  test::CubeFiles files;
  workspace::Workspace workspace;
  workspace::Messages messages;
  app::Exporter exporter;

  Exports() { REQUIRE(test::load_model(workspace, files.model, files.cage)); }
  void add(const std::string& name) { exporter.add(files::export_of(workspace.document, files / name)); }
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
  REQUIRE(e.messages.all().size() == 2);
  CHECK(e.messages.all()[0].text == "Saved a.obj.");
  CHECK(e.messages.all()[1].text == "Saved b.ply.");
}

TEST_CASE("notes_on_an_export_are_only_listed_and_those_of_the_pose_not_repeated") {
  Exports e;
  pose::Pose& pose = e.workspace.document.changed_pose();
  for (auto& p : pose.positions)
    if (p[1] > 0) p = {-p[0], p[1], -p[2]};  // turns the top half by 180 degrees
  e.workspace.document.put_method(sym3::Method::sd);
  const files::Export what = files::export_of(e.workspace.document, e.files / "a.obj");
  const std::vector<std::string> notes = files::write_deformed(what);
  REQUIRE_FALSE(notes.empty());
  const auto export_with = [&](std::vector<std::string> told) {
    e.messages.clear();
    e.exporter.add(what, std::move(told));
    REQUIRE_FALSE(e.exporter.follow(e.messages, true));
    for (const auto& message : e.messages.all())
      CHECK(message.visible == (message.severity == workspace::Severity::info));
    return e.messages.all();
  };
  const auto all = export_with({});
  CHECK(all.size() == notes.size() + 1);
  CHECK(all.back().text.starts_with("Saved a.obj ("));
  const auto known = export_with(notes);
  REQUIRE(known.size() == 1);
  CHECK(known.back().text == "Saved a.obj.");
}

TEST_CASE("a_failed_export_is_returned_and_the_next_one_runs") {
  Exports e;
  for (const char* name : {"no/such/folder.obj", "b.ply"}) e.add(name);
  const auto failure = e.exporter.follow(e.messages, true);
  REQUIRE(failure);
  CHECK(failure->file == e.files / "no/such/folder.obj");
  CHECK(e.messages.all().empty());
  CHECK_FALSE(e.exporter.follow(e.messages, true));
  CHECK(std::filesystem::exists(e.files / "b.ply"));
}
