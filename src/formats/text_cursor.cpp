#include "formats/text_cursor.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "mesh/surface.h"

namespace viete::formats {

namespace {

// `number` must be outside the range of double. Returns true if the number is too close to 0, and false if
// the number is too large. The error code of std::from_chars is the same for both.
bool is_tiny(std::string_view number) {
  long double value = 0;
  const auto code = std::from_chars(number.data(), number.data() + number.size(), value).ec;
  return code == std::errc() ? std::abs(value) < 1
                             : number.find("e-") != number.npos || number.find("E-") != number.npos;
}

std::string advice_on(std::string_view word) {
  const auto holds = [&](std::string_view part) { return word.find(part) != std::string_view::npos; };
  if (holds(",")) return "use a decimal point";
  if (holds("\xE2\x88\x92") || holds("\xE2\x80\x93"))
    return "its sign is a typographic dash: use the ASCII minus sign -";
  if (holds("#") || holds("ind") || holds("IND"))
    return "it means an invalid number: repair it, or export the file again";
  if (word.starts_with("0x") || word.starts_with("-0x")) return "it is hexadecimal: write a decimal number";
  const std::string_view signs = "+-";
  for (std::size_t i = 1; i < word.size(); ++i) {
    if (signs.find(word[i]) == std::string_view::npos) continue;
    if (signs.find(word[i - 1]) != std::string_view::npos) return "it has two signs: keep one";
    if (word[i - 1] == 'd' || word[i - 1] == 'D') return "it has a Fortran exponent: replace d by e";
    if (word[i - 1] != 'e' && word[i - 1] != 'E')
      return "it contains + or -: put a blank between two numbers, or e before an exponent";
  }
  return "repair or export the file again";
}

// Returns the word as a number. Accepts a plus sign, which from_chars rejects. A number too close to 0 is 0,
// and a number that is too large is infinite.
std::optional<double> any_number_in(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [to, code] = std::from_chars(word.data(), end, value);
  if (to != end || code == std::errc::invalid_argument) return std::nullopt;
  if (code == std::errc::result_out_of_range) return is_tiny(word) ? 0.0 : HUGE_VAL;
  return value;
}

}  // namespace

TextCursor::TextCursor(std::string_view bytes, TextRules rules, std::string_view name)
    : name_(name), rules_(rules), begin_(bytes.data()), at_(begin_), end_(begin_ + bytes.size()) {
  if (bytes.starts_with("\xEF\xBB\xBF")) at_ += 3;
}

// Also accepts blanks after the backslash, because editors do not show blanks.
std::size_t TextCursor::continuation_length() const {
  const char* to = at_ + 1;
  while (to != end_ && is_blank(*to)) ++to;
  if (to == end_ || (*to != '\n' && *to != '\r')) return 0;
  to += *to == '\r' && to + 1 != end_ && to[1] == '\n' ? 2 : 1;
  return static_cast<std::size_t>(to - at_);
}

void TextCursor::next_line() {
  bool in_comment = at_line_end();
  for (; at_ != end_ && *at_ != '\n' && *at_ != '\r'; ++at_) {
    in_comment |= *at_ == rules_.comment && rules_.comment;
    if (in_comment || !continues()) continue;
    at_ += continuation_length() - 1;
    ++line_;
  }
  if (at_ == end_) return;
  if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
  ++at_;
  ++line_;
}

bool TextCursor::next_filled_line() {
  while (at_line_end()) {
    if (at_ == end_) return false;
    next_line();
  }
  return true;
}

void TextCursor::need_word(std::string_view what) {
  if (!next_filled_line())
    fail("the file ends before " + std::string(what), "it seems to be truncated: export or copy it again");
}

std::string_view TextCursor::word() {
  if (at_line_end()) return {};
  return rest_of_word();
}

std::string_view TextCursor::rest_of_word() {
  const char* const from = at_;
  while (!ends_word(at_)) ++at_;
  if (at_ == from && at_ != end_ && *at_ == '\\' && !continues()) ++at_;
  return {from, static_cast<std::size_t>(at_ - from)};
}

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* const from = at_;
  const char* last = at_;
  const bool comment = at_ != end_ && *at_ == rules_.comment && rules_.comment;
  for (; at_ != end_ && *at_ != '\n' && *at_ != '\r' && (comment || !continues()); ++at_)
    if (!is_blank(*at_)) last = at_ + 1;
  return {from, static_cast<std::size_t>(last - from)};
}

double TextCursor::coordinate() {
  if (at_line_end()) fail("a coordinate is missing", "write x, y and z for every vertex");
  const char* const from = at_;
  double value = 0;
  const auto [to, code] = std::from_chars(from, end_, value);
  if (code == std::errc() && ends_word(to)) {
    at_ = to;
  } else {
    const std::string_view text = rest_of_word();
    const auto unusual = any_number_in(text);
    if (!unusual) fail(in_quotes(text) + " is not a number", advice_on(text));
    value = *unusual;
  }
  if (!(std::abs(value) <= mesh::largest_coordinate)) {
    at_ = from;
    fail("coordinate " + in_quotes(rest_of_word()) + " is not a finite number up to 1e100",
         "repair the vertex");
  }
  return value;
}

std::size_t TextCursor::numbers(std::span<double> to, std::span<bool> are_whole) {
  for (std::size_t count = 0; count < to.size(); ++count) {
    const std::string_view text = at_line_end() ? std::string_view() : word();
    const auto value = number_in(text);
    if (!value) return count;
    to[count] = *value;
    if (count < are_whole.size()) are_whole[count] = text.find_first_of(".eE") == text.npos;
  }
  return to.size();
}

std::int64_t TextCursor::leading_integer(std::string_view what) {
  if (at_line_end()) {
    const bool vowel = std::string_view("aeiou").find(what[0]) != std::string_view::npos;
    fail((vowel ? "an " : "a ") + std::string(what) + " is missing", "repair or export the file again");
  }
  const char* const from = at_ + (*at_ == '+' ? 1 : 0);
  std::int64_t value = 0;
  const auto [to, code] = std::from_chars(from, end_, value);
  if (code == std::errc::result_out_of_range)
    fail(std::string(what) + " " + in_quotes(rest_of_word()) + " is too large",
         "repair or export the file again");
  if (code != std::errc())
    fail(in_quotes(rest_of_word()) + " is not a " + std::string(what), "repair or export the file again");
  at_ = to;
  return value;
}

std::int64_t TextCursor::integer(std::string_view what) {
  const std::int64_t value = leading_integer(what);
  if (!ends_word(at_))
    fail(std::to_string(value) + std::string(rest_of_word().substr(0, 16)) + " is not a " + std::string(what),
         "repair or export the file again");
  return value;
}

std::string TextCursor::place(std::size_t line) const {
  return std::string(name_) + ":" + std::to_string(line);
}

void TextCursor::fail(const std::string& problem, const std::string& advice) const {
  throw base::Error(place(), problem, advice);
}

std::optional<double> number_in(std::string_view word) {
  const auto value = any_number_in(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool has_comments(std::string_view text) {
  for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
    if (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t' || text[at - 1] == '\n') return true;
  return false;
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t most = 32;
  std::string text(1, '"');
  text.append(word.substr(0, most)).append(word.size() > most ? "...\"" : "\"");
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c >= 127; }, '?');
  return text;
}

std::string clipped(std::string_view comment) {
  const std::size_t from = std::min(comment.find_first_not_of("# \t"), comment.size());
  return base::cut(comment.substr(from), 200);
}

}  // namespace viete::formats
