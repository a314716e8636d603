#include "formats/text_cursor.h"

#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;

namespace {

Source source_of(std::string_view bytes) {
  return {"a.txt", "txt", bytes, nullptr};
}

double number(const std::string& text) {
  const Source source = source_of(text);
  return TextCursor(source, {}).coordinate();
}

}  // namespace

TEST_CASE("numbers_are_read_with_all_their_digits") {
  CHECK(number("-0.1234567890123456") == -0.1234567890123456);
  CHECK(number("1.000000000000000000000000000001") == 1);
  CHECK(number("+1.") == 1);
  CHECK(number("+.5e-3") == .5e-3);
  CHECK(number("5E+3") == 5e3);
  CHECK(std::signbit(number("-0")));
  CHECK(number("4.9406564584124654e-324") == 4.9406564584124654e-324);
  CHECK(number("1e100") == 1e100);
}

TEST_CASE("a_number_too_small_for_double_is_zero") {
  CHECK(number("1e-400") == 0);
  CHECK(number("-1e-400") == 0);
  CHECK(number("+1e-99999999999999999999") == 0);
  CHECK(number("0." + std::string(400, '0') + "7") == 0);
  CHECK(number("0." + std::string(400, '0') + "7e401") == doctest::Approx(7));
}

TEST_CASE("non_finite_numbers_are_rejected") {
  for (const char* text : {"nan", "inf", "-inf", "1e400", "1e101", "1e99999", "0x10", "1,5", "1.5f", "+-1",
                           "--1", "+", ".", "e5", "1d5", ""}) {
    CHECK_THROWS_AS_MESSAGE(number(text), base::Error, text);
  }
}

TEST_CASE("lines_end_with_lf_crlf_or_cr_and_are_counted") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "1" + end + end + "  # note" + end + "2 3";
    const Source source = source_of(text);
    TextCursor cursor(source, {.comment = '#'});
    CHECK(cursor.word() == "1");
    CHECK(cursor.at_line_end());
    cursor.next_line();
    REQUIRE(cursor.next_filled_line());
    CHECK(cursor.line() == 4);
    CHECK(cursor.word() == "2");
    CHECK(cursor.word() == "3");
    CHECK(cursor.word().empty());
    CHECK(cursor.at_end());
  }
}

TEST_CASE("a_backslash_before_the_line_end_joins_lines_where_the_format_says_so") {
  const Source source = source_of("a \\\nb\\\r\nc \\ d\ne");
  TextCursor joined(source, {.continued_lines = true});
  for (const char* expected : {"a", "b", "c", "\\", "d", ""}) CHECK(joined.word() == expected);
  CHECK(joined.line() == 3);
  TextCursor plain(source, {});
  for (const char* expected : {"a", "\\", ""}) CHECK(plain.word() == expected);
}

TEST_CASE("words_in_messages_are_cut_and_printable") {
  CHECK(in_quotes("abc") == "\"abc\"");
  CHECK(in_quotes(std::string("a\0\x1b[2J\xff", 7)) == "\"a??[2J?\"");
  CHECK(in_quotes(std::string(1000, 'x')).size() == 37);
}

TEST_CASE("a_long_comment_is_cut_between_characters") {
  CHECK(clipped("  ## hello") == "hello");
  std::string text(199, 'x');
  text += "\xC3\xA9 and more";
  CHECK(clipped(text) == std::string(199, 'x'));
  CHECK(clipped("###").empty());
}

TEST_CASE("malformed_numbers_get_specific_advice") {
  const std::pair<const char*, const char*> words[] = {{"3,5", "decimal point"},
                                                       {"\xE2\x88\x92"
                                                        "3.5",
                                                        "ASCII minus sign"},
                                                       {"3.1e\xE2\x88\x92"
                                                        "2",
                                                        "ASCII minus sign"},
                                                       {"3.1e+-2", "two signs"},
                                                       {"--3.1", "two signs"},
                                                       {"+-3.1", "two signs"},
                                                       {"3.1d+2", "Fortran"},
                                                       {"3.1+2", "it contains + or -"},
                                                       {"0.5-0.25", "it contains + or -"},
                                                       {"1.#QNAN", "invalid number"},
                                                       {"0x1p3", "hexadecimal"},
                                                       {"abc", "repair or export"}};
  for (const auto& [word, advice] : words) {
    const std::string text = test::refusal("v 0 0 " + std::string(word) + "\n", "obj");
    CHECK_MESSAGE(test::mentions(text, "is not a number"), text);
    CHECK_MESSAGE(test::mentions(text, advice), text);
  }
  CHECK(test::read_text("v +3.1e+2 -3.1E-2 .5\n", "obj").surface.positions[0] == Point{310, -0.031, 0.5});
}
