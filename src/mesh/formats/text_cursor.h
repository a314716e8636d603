// Walks through a text file word by word, knows its line, and says clearly what it met instead of a number.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/formats/source.h"

namespace viete::mesh {

/// What differs between text formats.
struct TextRules {
  char comment = '\0';           ///< starts a comment that ends with the line; none if zero
  bool continued_lines = false;  ///< a backslash at the line end joins the next line (OBJ)
};

/// Lines end with LF, CR LF or CR. A UTF-8 byte order mark is skipped. Nothing depends on the locale.
class TextCursor {
public:
  TextCursor(const Source& source, TextRules rules);

  bool at_end() const { return at_ == end_; }
  std::size_t line() const { return line_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  /// The part of the text that lies behind, in [0, 1].
  double done() const { return static_cast<double>(at_ - begin_) / static_cast<double>(end_ - begin_ + 1); }

  /// Skips blanks. True where the line, its uncommented part or the text ends.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || *at_ == '\n' || *at_ == '\r' || (*at_ == rules_.comment && rules_.comment);
  }

  /// Goes behind the end of this line and of those that continue it.
  void next_line();

  /// Goes to the next line that holds a word, starting with this one; false at the end of the text.
  bool next_filled_line();

  /// Like next_filled_line, for text where a line end is a blank like any other. Throws at the end of the
  /// text.
  void need_word(std::string_view what);

  /// The next word of this line, empty if there is none.
  std::string_view word();

  /// What is left of this line, comment included, without blanks at either end and what continues it. Stays
  /// in the line.
  std::string_view rest_of_line();

  /// The next word as a position coordinate: finite, at most 1e100 in size (so that volumes are finite as
  /// well).
  double coordinate();

  /// The next word as a whole number. what: for the message, "face index".
  std::int64_t integer(std::string_view what);

  /// The whole number at the start of the next word; the rest of the word stays.
  std::int64_t leading_integer(std::string_view what);

  /// What follows here up to the next blank. Does not skip blanks first.
  std::string_view rest_of_word();

  /// `name:line`.
  std::string place() const;
  std::string place(std::size_t line) const;
  [[noreturn]] void fail(const std::string& problem, const std::string& advice) const;

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  bool continues() const { return rules_.continued_lines && *at_ == '\\' && continuation_length() > 0; }
  std::size_t continuation_length() const;
  bool ends_word(const char* p) const {
    return p == end_ || is_blank(*p) || *p == '\n' || *p == '\r' || (*p == '\\' && rules_.continued_lines);
  }
  void skip_blanks() {
    while (at_ != end_) {
      if (is_blank(*at_)) {
        ++at_;
      } else if (continues()) {
        at_ += continuation_length();
        ++line_;
      } else {
        return;
      }
    }
  }
  double unusual_number(const char* from);

  std::string_view name_;
  TextRules rules_;
  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
};

/// A word as a finite number, or nothing.
std::optional<double> number_in(std::string_view word);

/// A word as it may stand in a message: quoted, cut after 32 bytes, what cannot be printed replaced by '?'.
std::string in_quotes(std::string_view word);

/// A comment as it is kept: without blanks and marks at its start, at most 200 bytes.
std::string clipped(std::string_view comment);

}  // namespace viete::mesh
