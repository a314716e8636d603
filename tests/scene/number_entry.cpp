#include "scene/hand/number_entry.h"

#include <doctest/doctest.h>

using viete::scene::number_of;
using viete::scene::NumberEntry;

namespace {

NumberEntry typed(const char* text) {
  NumberEntry entry;
  for (; *text; ++text) entry.type(*text);
  return entry;
}

}  // namespace

TEST_CASE("digits_and_a_point_or_comma_make_a_number") {
  CHECK(typed("12.5").value() == 12.5);
  CHECK(typed("12,5").value() == 12.5);
  CHECK(typed(".25").value() == 0.25);
  CHECK(typed("1.2.3").value() == 1.23);
  CHECK(typed("7.").value() == 7);
}

TEST_CASE("the_text_of_a_field_means_what_the_same_keys_mean_during_a_drag") {
  CHECK(number_of("12,5") == 12.5);
  CHECK(number_of("12.5") == typed("12,5").value());
  CHECK(number_of(",25") == 0.25);
  CHECK(number_of("+7") == 7);
  CHECK(number_of("-1e-3") == -1e-3);
  for (const char* text : {"", "-", "1.234,5", "1,234.5", "12 5", "1e999", "nan", "inf", "+-3", "++3", "3x"})
    CHECK_FALSE_MESSAGE(number_of(text), text);
}

TEST_CASE("minus_changes_the_sign_wherever_it_is_typed") {
  CHECK(typed("90-").value() == -90);
  CHECK(typed("-90-").value() == 90);
  CHECK(typed("-4").text() == "-4");
}

TEST_CASE("there_is_no_value_before_the_first_digit") {
  CHECK_FALSE(typed("").value());
  CHECK_FALSE(typed("-").value());
  CHECK_FALSE(typed(".").value());
  CHECK(typed("").empty());
  CHECK_FALSE(typed("-").empty());
}

TEST_CASE("backspace_takes_back_the_last_digit_and_at_last_the_sign") {
  NumberEntry entry = typed("-45");
  entry.backspace();
  CHECK(entry.value() == -4);
  entry.backspace();
  entry.backspace();
  CHECK(entry.empty());
  entry.backspace();
  CHECK(entry.empty());
}

TEST_CASE("other_characters_mean_nothing") {
  NumberEntry entry;
  CHECK_FALSE(entry.type('g'));
  CHECK_FALSE(entry.type(' '));
  CHECK(entry.empty());
}

TEST_CASE("very_long_numbers_are_cut_and_stay_finite") {
  CHECK(typed("123456789012345678901234567890").text().size() == 15);
}
