#include "workspace/workspace.h"

#include <doctest/doctest.h>

#include "workspace/command.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

TEST_CASE("cancelling_a_slider_restores_every_bit") {
  Workspace w;
  w.document = test::cube_document();
  set_radius(w.document, 0.3);
  set_radius(w.document, 0.5123456789);
  undo(w.document);
  REQUIRE(w.document.history().can_redo());
  const pose::Deformer deformer = w.document.deformer();
  const std::string label = w.document.history().undo_label();
  begin_widget_edit(w);
  for (const double radius : {0.4, 0.2}) set_radius(w.document, radius);
  w.view.handling.soft.radius = 0.7;
  w.view.brush.radius = 99;
  w.making.wish.triangles = 444;
  w.preferences.layout.width[1] = 400;
  cancel_widget_edit(w);
  CHECK(w.document.deformer() == deformer);
  CHECK(w.document.history().undo_label() == label);
  CHECK(w.document.history().can_redo());
  const Workspace fresh;
  CHECK(w.view.handling == fresh.view.handling);
  CHECK(w.view.brush.radius == fresh.view.brush.radius);
  CHECK(w.making.wish.triangles == fresh.making.wish.triangles);
  CHECK(w.preferences.layout == fresh.preferences.layout);
}

TEST_CASE("a_file_without_a_folder_is_browsed_in_the_current_folder") {
  Workspace w;
  w.document = test::cube_document();
  w.document.put_saved_model("model.obj");
  w.preferences.folder = "/";  // the folder of an older document
  for (const char* command : {"open_cage", "import_animation", "save_model"}) {
    find_command(command)->run(w);
    CHECK(w.files.browser.folder == std::filesystem::canonical("."));
  }
}

TEST_CASE("cancelling_merged_steps_keeps_the_older_edit_and_leaves_another_document_alone") {
  Workspace w;
  w.document = test::cube_document();
  set_radius(w.document, 0.3);
  begin_widget_edit(w);
  set_radius(w.document, 0.4);  // becomes part of the previous edit
  cancel_widget_edit(w);
  CHECK(w.document.deformer().weighting.radius == 0.3);
  CHECK(w.document.history().can_undo());
  undo(w.document);
  CHECK_FALSE(w.document.history().can_undo());
  begin_widget_edit(w);
  ++w.files.opened;  // simulates that another document was opened
  w.view.brush.radius = 99;
  cancel_widget_edit(w);
  CHECK(w.view.brush.radius == 99);
}

TEST_CASE("a_repeated_message_is_counted_and_visible_again_and_the_last_200_stay") {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.warn("again");
  messages.info("other");
  messages.warn("again");
  REQUIRE(messages.all().size() == 2);
  CHECK(messages.all().back().text == "again");
  CHECK(messages.all().back().times == 1001);
  messages.dismiss(1);
  messages.warn("again");
  CHECK(messages.all().back().visible);
  CHECK(messages.all().back().times == 1002);
  messages.dismiss(1);
  messages.info("other");
  messages.warn("again");  // added, because the equal message is hidden and not the last
  CHECK(messages.all().size() == 3);
  CHECK(messages.revision() == 1005);
  for (int i = 0; i < 1000; ++i) messages.info(std::to_string(i));
  CHECK(messages.all().size() == 200);
  CHECK(messages.all().back().text == "999");
}

TEST_CASE("undo_hides_infos_and_warnings_but_not_errors_and_logged_messages_are_never_visible") {
  Messages messages;
  messages.info("Added 2 poses.");
  messages.warn("Poses are gone.");
  messages.error("cannot write", {"export"});
  messages.hide_messages();
  messages.log(Severity::warning, "off by 1e-4");
  REQUIRE(messages.all().size() == 4);
  for (const Message& message : messages.all())
    CHECK(message.visible == (message.severity == Severity::error));
}

TEST_CASE("an_info_is_visible_for_four_seconds_and_stays_in_the_list") {
  Messages messages;
  messages.info("Saved");
  const double said = messages.all().back().said;
  CHECK(messages.next_end() > said + 3.9);
  CHECK(messages.next_end() < said + 4.1);
  messages.expire(said + 4.1);
  CHECK_FALSE(messages.all().back().visible);
  CHECK_FALSE(messages.next_end() < said + 4.1);
  CHECK(messages.all().size() == 1);
}

TEST_CASE("an_error_is_visible_until_the_action_succeeds_or_it_is_dismissed") {
  Messages messages;
  messages.error("cannot write", {"export"});
  messages.error("cannot read", {"open"});
  messages.expire(messages.all().back().said + 1e6);
  CHECK(messages.all()[0].visible);
  messages.succeeded("export");
  CHECK_FALSE(messages.all()[0].visible);
  CHECK(messages.all()[1].visible);
  messages.dismiss(1);
  CHECK_FALSE(messages.all()[1].visible);
}

TEST_CASE("messages_about_a_cage_disappear_with_it") {
  Messages messages;
  messages.warn("open edges", {.scope = Scope::cage});
  messages.warn("no normals", {.scope = Scope::model});
  messages.info("Saved");
  const unsigned before = messages.revision();
  messages.warn("of the next cage", {.scope = Scope::cage});
  messages.forget(Scope::cage, before);
  REQUIRE(messages.all().size() == 3);
  CHECK(messages.all().front().text == "no normals");
  CHECK(messages.all().back().text == "of the next cage");
  messages.forget(Scope::model, messages.revision());
  REQUIRE(messages.all().size() == 1);
  CHECK(messages.all().front().text == "Saved");
}
