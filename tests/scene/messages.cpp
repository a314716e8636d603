#include "scene/workspace/messages.h"

#include <doctest/doctest.h>

using namespace viete::scene;

TEST_CASE("a_message_that_repeats_is_counted_not_listed") {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.warn("again");
  messages.info("other");
  messages.dismiss(0);
  messages.warn("again");
  REQUIRE(messages.all().size() == 3);
  CHECK(messages.all()[0].times == 1000);
  CHECK(messages.revision() == 1002);
}

TEST_CASE("a_message_that_stands_is_not_said_twice") {
  Messages messages;
  messages.warn("again");
  messages.info("other");
  messages.warn("again");
  REQUIRE(messages.all().size() == 2);
  CHECK(messages.all().back().text == "again");
  CHECK(messages.all().back().times == 2);
}

TEST_CASE("an_undo_takes_infos_and_warnings_out_of_sight_but_no_error") {
  Messages messages;
  messages.info("Added 2 poses.");
  messages.warn("Poses are gone.");
  messages.error("cannot write", {"export"});
  messages.leave_sight();
  REQUIRE(messages.all().size() == 3);
  for (const Message& message : messages.all())
    CHECK(message.in_sight == (message.severity == Severity::error));
}

TEST_CASE("what_is_only_logged_is_in_the_list_and_not_in_sight") {
  Messages messages;
  messages.log(Severity::warning, "off by 1e-4");
  REQUIRE(messages.all().size() == 1);
  CHECK_FALSE(messages.all().back().in_sight);
}

TEST_CASE("old_messages_are_dropped") {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.info(std::to_string(i));
  CHECK(messages.all().size() == 200);
  CHECK(messages.all().back().text == "999");
}

TEST_CASE("a_success_is_in_sight_for_four_seconds_and_stays_in_the_list") {
  Messages messages;
  messages.info("Saved");
  const double said = messages.all().back().said;
  CHECK_FALSE(messages.due(said + 3.9));
  CHECK(messages.due(said + 4.1));
  messages.expire(said + 4.1);
  CHECK_FALSE(messages.all().back().in_sight);
  CHECK_FALSE(messages.due(said + 4.1));
  CHECK(messages.all().size() == 1);
}

TEST_CASE("an_error_stays_in_sight_until_the_same_thing_succeeds_or_it_is_dismissed") {
  Messages messages;
  messages.error("cannot write", {"export"});
  messages.error("cannot read", {"open"});
  messages.expire(messages.all().back().said + 1e6);
  CHECK(messages.all()[0].in_sight);
  messages.succeeded("export");
  CHECK_FALSE(messages.all()[0].in_sight);
  CHECK(messages.all()[1].in_sight);
  messages.dismiss(1);
  CHECK_FALSE(messages.all()[1].in_sight);
}

TEST_CASE("what_was_said_of_a_cage_goes_with_it_and_what_is_said_of_the_next_one_stays") {
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

TEST_CASE("what_is_said_again_is_in_sight_again") {
  Messages messages;
  messages.info("Saved");
  messages.dismiss(0);
  messages.info("Saved");
  CHECK(messages.all().back().in_sight);
  CHECK(messages.all().back().times == 2);
}
