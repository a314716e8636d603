// Human-readable JSON files, with errors that name file and key. Reading and writing by the same function:
// each type has one function code(field, value, ...), which reads the value from the field or writes it
// there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/choice.h"
#include "deform/binding.h"
#include "formats/text_cursor.h"
#include "mesh/vector.h"

namespace viete::files {

/// Limits of a file; more is refused before memory is allocated. The bytes suffice for shapes of eight
/// million vertices in total; the longest text is a percent-encoded file name.
inline constexpr std::size_t most_json_bytes = 128 << 20, most_json_depth = 32, longest_text = 3 * 4096;

/// One key per line; arrays are on one line unless they contain arrays or objects, which get a line each.
/// Numbers have the digits that read back as the same double. Throws base::Error naming `file` if a string is
/// not UTF-8, or if the length exceeds the limit of read_json().
std::string readable(const nlohmann::ordered_json& value, const std::filesystem::path& file);

/// A file name as a string; if it is not UTF-8, which JSON strings require, {"percent_encoded": "caf%E9"}.
/// JsonReader::path() reads both back to the same bytes.
nlohmann::ordered_json path_json(const std::filesystem::path& path);

/// Throws base::Error naming the file, and the line of a syntax error.
nlohmann::json read_json(const std::filesystem::path& path);

/// A JSON value and its key path. All accessors throw base::Error, `file: key: problem`, if the value has the
/// wrong type. Refers to the JSON, which must outlive it.
class JsonReader {
public:
  JsonReader(const nlohmann::json& value, std::string file, std::string key = "")
      : value_(value), file_(std::move(file)), key_(std::move(key)) {}

  /// For objects. find: nullopt if the key is missing or its value is null.
  std::optional<JsonReader> find(const std::string& key) const;
  JsonReader at(const std::string& key) const;
  std::vector<std::string> keys() const;
  /// For arrays.
  std::size_t size() const;
  JsonReader item(std::size_t index) const;

  bool boolean() const;
  double number() const;                           ///< finite
  double number(double least, double most) const;  ///< in this range
  std::uint32_t index() const;
  std::string text() const;            ///< at most longest_text bytes
  std::string base64() const;          ///< decoded bytes
  std::filesystem::path path() const;  ///< written by path_json()
  /// An array of exactly N numbers.
  template <std::size_t N>
  std::array<double, N> numbers() const {
    check_size(N);
    std::array<double, N> all;
    for (std::size_t i = 0; i < N; ++i) all[i] = item(i).number();
    return all;
  }
  /// [x, y, z], each with an absolute value of at most `farthest`.
  std::array<double, 3> place(double farthest) const;
  std::vector<std::uint32_t> indices() const;  ///< sorted, without repetitions
  /// An array of places. Quick: these lists are long.
  std::vector<mesh::Vec3> places(double farthest) const;

  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "correct it in the file") const;
  [[noreturn]] void expected(const char* what) const;

private:
  void check_size(std::size_t n) const;

  const nlohmann::json& value_;
  std::string file_, key_;
};

/// Shapes that a file stores once and refers to by index.
struct ShapeTable {
  std::vector<deform::SharedShape> all;
  std::map<const void*, std::uint32_t> numbers;
};

/// The range of a number. The file has the number times `factor`.
struct Limits {
  double least, most, factor = 1;
};
constexpr Limits percent(double least, double most) {
  return {least, most, 100};
}
/// The largest absolute value of coordinates.
struct Reach {
  double most;
};

/// A JSON value to read or to write. Reading throws base::Error naming file and key.
class JsonField {
public:
  JsonField(const JsonReader& from, ShapeTable& shapes) : in_(from), shapes_(&shapes) {}
  JsonField(nlohmann::ordered_json& to, ShapeTable& shapes) : out_(&to), shapes_(&shapes) {}

  bool reads() const { return in_.has_value(); }
  const JsonReader& in() const { return *in_; }
  nlohmann::ordered_json& out() const { return *out_; }
  ShapeTable& shapes() const { return *shapes_; }

  /// A member of an object. Nullopt if it is read and missing; a `needed` one is an error then.
  std::optional<JsonField> child(const char* key, bool needed = false) const;
  /// The number of items to read; `count` if they are written. Throws base::Error if there are more than
  /// `most`.
  std::size_t list(std::size_t count, std::size_t most) const;
  /// Item `index` when reading; appends one when writing.
  JsonField item(std::size_t index) const;

  /// Codes a member of an object. If it is missing, the value stays.
  template <class T, class... Form>
  void member(const char* key, T& value, const Form&... form) const {
    if (const auto field = child(key)) code(*field, value, form...);
  }
  template <class T, class... Form>
  void needed(const char* key, T& value, const Form&... form) const {
    code(*child(key, true), value, form...);
  }
  /// Does not write the usual value.
  template <class T, class... Form>
  void unless(const std::type_identity_t<T>& usual, const char* key, T& value, const Form&... form) const {
    if (reads() || !(value == usual)) member(key, value, form...);
  }

private:
  std::optional<JsonReader> in_;
  nlohmann::ordered_json* out_ = nullptr;
  ShapeTable* shapes_;
};

void code(const JsonField& field, bool& value);
void code(const JsonField& field, std::string& value);
/// Also a name that is not UTF-8, see path_json().
void code(const JsonField& field, std::filesystem::path& value);
void code(const JsonField& field, std::uint32_t& value);
void code(const JsonField& field, double& value, const Limits& limits);
/// With the fewest digits that read back as the same float.
void code(const JsonField& field, float& value, const Limits& limits);
/// Rounded when reading.
void code(const JsonField& field, int& value, const Limits& limits);
void code(const JsonField& field, mesh::Vec3& value, const Reach& reach);
void code(const JsonField& field, glm::vec3& value, const Reach& reach);
void code(const JsonField& field, std::vector<mesh::Vec3>& value, const Reach& reach);
/// The size of a window.
void code(const JsonField& field, glm::ivec2& window);
/// Ascending and unique.
void code(const JsonField& field, std::vector<std::uint32_t>& value);
/// 16 hexadecimal digits.
void code(const JsonField& field, std::uint64_t& value);
/// The index of a shape in the field's table.
void code(const JsonField& field, deform::SharedShape& value);
/// [{"float32", or "float64" if float is not exact: base64 of x, y, z of each vertex, little-endian}, ...]
void code(const JsonField& field, ShapeTable& shapes);

template <class T, class... Form>
void code(const JsonField& field, std::optional<T>& value, const Form&... form) {
  if (field.reads()) value.emplace();
  code(field, *value, form...);
}

/// A list of at most `most` values.
template <class T>
void code(const JsonField& field, std::vector<T>& all, std::size_t most) {
  all.resize(field.list(all.size(), most));
  for (std::size_t i = 0; i < all.size(); ++i) code(field.item(i), all[i]);
}

void write_word(const JsonField& field, std::string_view word);
/// A value written as `word`; find: the value of a word, as std::optional.
template <class T, class Find>
void code_word(const JsonField& field, T& value, std::string_view word, const Find& find) {
  if (!field.reads()) return write_word(field, word);
  const std::string text = field.in().text();
  const auto found = find(text);
  if (!found) field.in().fail(formats::in_quotes(text) + " is not known");
  value = *found;
}
/// An enumeration whose values are the indices of these words.
template <class T, std::size_t n>
void code_listed(const JsonField& field, T& value, const std::array<std::string_view, n>& words) {
  code_word(field, value, words[static_cast<std::size_t>(value)], [&](std::string_view word) {
    const auto found = std::ranges::find(words, word);
    return found == words.end() ? std::nullopt : std::optional(static_cast<T>(found - words.begin()));
  });
}

/// An enumeration with choices.
template <class T>
requires requires(T value) {
  choices(value);
}
void code(const JsonField& field, T& value) {
  code_word(field, value, base::entry_of(value).word, base::value_of_word<T>);
}

}  // namespace viete::files
