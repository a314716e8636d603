// Reads a text file word by word, with line numbers and precise errors.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/source.h"

namespace viete::formats {

/// Differences between text formats.
struct TextRules {
  char comment = '\0';           ///< starts a comment up to the line end; '\0': no comments
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
  /// The part already read, in [0, 1].
  double done() const { return static_cast<double>(at_ - begin_) / static_cast<double>(end_ - begin_ + 1); }

  /// Skips blanks. True at the end of the line, of its uncommented part or of the text.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || *at_ == '\n' || *at_ == '\r' || (*at_ == rules_.comment && rules_.comment);
  }

  /// Moves past the end of this line and its continuation lines.
  void next_line();

  /// Moves to the next non-empty line, starting with the current one; false at the end of the text.
  bool next_filled_line();

  /// As next_filled_line(), for text where line ends are ordinary blanks. Throws at the end of the text.
  void need_word(std::string_view what);

  /// The next word of this line, empty if there is none.
  std::string_view word();

  /// The rest of this line, trimmed, with comments, without continuation lines. Stops before the line end.
  std::string_view rest_of_line();

  /// The next word as a coordinate: finite, at most 1e100 in size so that volumes stay finite.
  double coordinate();

  /// Reads at most to.size() numbers of this line, up to the first other word. Returns their number.
  std::size_t numbers(std::span<double> to);

  /// The next word as an integer. what: its name in messages, "face index".
  std::int64_t integer(std::string_view what);

  /// The integer at the start of the next word; leaves the rest of the word.
  std::int64_t leading_integer(std::string_view what);

  /// The characters up to the next blank. Does not skip blanks first.
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

/// A word as a finite number; empty if it is not a finite number.
std::optional<double> number_in(std::string_view word);

/// A word for messages: quoted, cut after 32 bytes, unprintable characters replaced by '?'.
std::string in_quotes(std::string_view word);

/// A comment to keep: trimmed, without leading marks, at most 200 bytes.
std::string clipped(std::string_view comment);

}  // namespace viete::formats
