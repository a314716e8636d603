// Reads a text file word by word. Errors contain the line number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/source.h"

namespace viete::formats {

struct TextRules {
  char comment = '\0';           ///< starts a comment up to the line end; '\0': no comments
  bool continued_lines = false;  ///< a backslash at the line end joins the next line (OBJ)
};
inline constexpr TextRules obj_rules{.comment = '#',
                                     .continued_lines = true};  ///< also of material libraries

/// Lines end with LF, CR LF or CR. A UTF-8 byte order mark is skipped. The locale has no effect.
class TextCursor {
public:
  TextCursor(const Source& source, TextRules rules) : TextCursor(source.bytes, rules, source.name) {}
  /// `name` is for messages. Both views must outlive this object.
  explicit TextCursor(std::string_view bytes, TextRules rules = {}, std::string_view name = {});

  bool at_end() const { return at_ == end_; }
  std::size_t line() const { return line_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  /// Returns the fraction that has been read, in [0, 1].
  double done() const { return static_cast<double>(at_ - begin_) / static_cast<double>(end_ - begin_ + 1); }

  /// Skips blanks. Returns true if a line end, a comment or the end of the text follows.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || *at_ == '\n' || *at_ == '\r' || (*at_ == rules_.comment && rules_.comment);
  }

  /// Moves past the end of this line and its continuation lines.
  void next_line();

  /// Moves to the next word, which may be in a later line. At the end of the text, returns false.
  bool next_filled_line();

  /// Like next_filled_line(), but throws base::Error at the end of the text. `what` is the missing word.
  void need_word(std::string_view what);

  /// Reads the next word of this line. If the line has no more words, returns an empty text.
  std::string_view word();

  /// Reads the rest of this line without blanks at the ends. Includes comments, but no continuation lines.
  std::string_view rest_of_line();

  /// Reads the next word as a number from -1e100 to 1e100, so that volumes stay finite.
  double coordinate();

  /// Reads numbers of this line until `to` is full or a word is not a number. Returns the count of numbers.
  /// are_whole[i] becomes true if number i has no decimal point and no exponent; are_whole can be shorter.
  std::size_t numbers(std::span<double> to, std::span<bool> are_whole = {});

  /// Reads the next word as an integer. `what` is its name in messages, such as "face index".
  std::int64_t integer(std::string_view what);

  /// Reads the integer at the start of the next word and leaves the rest of the word.
  std::int64_t leading_integer(std::string_view what);

  /// Reads the characters up to the next blank, without skipping blanks first.
  std::string_view rest_of_word();

  /// Returns the place for messages, `name:line`.
  std::string place() const { return place(line_); }
  std::string place(std::size_t line) const;
  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "export the model again") const;

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

  std::string_view name_;
  TextRules rules_;
  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
};

/// Returns the word as a number, or nullopt if the word is not a finite number.
std::optional<double> number_in(std::string_view word);

/// Returns true if the text has a comment that starts with '#'.
bool has_comments(std::string_view text);

/// Returns the word in quotes, cut after 32 bytes. '?' replaces bytes that are not printable ASCII.
std::string in_quotes(std::string_view word);

/// Returns the comment without blanks and '#' at the start, cut to at most 200 bytes.
std::string clipped(std::string_view comment);

}  // namespace viete::formats
