#include "scene/messages.h"

#include <doctest/doctest.h>

using namespace viete::scene;

TEST_CASE("a_message_that_repeats_is_counted_not_listed") {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.warn("again");
  messages.info("other");
  messages.warn("again");
  REQUIRE(messages.all().size() == 3);
  CHECK(messages.all()[0].times == 1000);
  CHECK(messages.revision() == 1002);
}

TEST_CASE("old_messages_are_dropped") {
  Messages messages;
  for (int i = 0; i < 1000; ++i) messages.info(std::to_string(i));
  CHECK(messages.all().size() == 200);
  CHECK(messages.all().back().text == "999");
}
