// Reads and writes JSON files. Errors contain the file and the key. Each type has one function code(field,
// value, ...) for both directions. When reading, code() sets the value. When writing, code() sets the field.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <vector>

#include "base/choice.h"
#include "formats/text_cursor.h"
#include "mesh/vector.h"
#include "weights/binding.h"

namespace viete::files {

/// Limits of a file, checked before memory is allocated. most_json_bytes allows shapes with eight million
/// vertices in total. longest_text, in bytes, allows a percent-encoded file name.
inline constexpr std::size_t most_json_bytes = 128 << 20, most_json_depth = 32, longest_text = 3 * 4096;

/// Returns the text of a JSON file with one key per line. If an array contains arrays or objects, each item
/// has its own line. Other arrays are on one line. Reading the text gives exactly the same doubles. In
/// strings, bytes that are not UTF-8 become U+FFFD. If the text exceeds most_json_bytes, throws base::Error.
std::string readable(const nlohmann::ordered_json& value, const std::filesystem::path& file);

/// Converts a file name to a JSON string. If the name is not UTF-8, converts the name to an object:
/// {"percent_encoded": "caf%E9"}. JsonReader::path() reads both forms.
nlohmann::ordered_json path_json(const std::filesystem::path& path);

/// Reads a file. If the syntax is wrong, throws base::Error with the line.
nlohmann::json read_json(const std::filesystem::path& path);

/// A JSON value with its key in the file, such as time.keys[3].frame. If the value has the wrong type, each
/// function throws base::Error, `file: key: problem`. `value` must outlive this object.
class JsonReader {
public:
  JsonReader(const nlohmann::json& value, std::string file)
      : JsonReader(value, std::move(file), "", std::make_shared<Found>()) {}

  /// These functions need an object. For a missing key or a null, find() returns nullopt and at() throws.
  std::optional<JsonReader> find(const std::string& key) const;
  JsonReader at(const std::string& key) const;
  std::vector<std::string> keys() const;
  /// Returns the keys inside this value for which nobody has called find() or at().
  std::set<std::string> ignored_keys() const;
  /// These functions need an array.
  std::size_t size() const;
  JsonReader item(std::size_t index) const;

  bool boolean() const;
  double number() const;                           ///< a finite number
  double number(double least, double most) const;  ///< a number in this range
  std::uint32_t index() const;
  std::string text() const;            ///< at most longest_text bytes
  std::string base64() const;          ///< decoded bytes
  std::filesystem::path path() const;  ///< a path written by path_json()
  /// Reads an array of exactly N numbers.
  template <std::size_t N>
  std::array<double, N> numbers() const {
    check_size(N);
    std::array<double, N> all;
    for (std::size_t i = 0; i < N; ++i) all[i] = item(i).number();
    return all;
  }
  /// Reads [x, y, z]. Absolute values must be at most `farthest`.
  std::array<double, 3> place(double farthest) const;
  std::vector<std::uint32_t> indices() const;  ///< reads an array, then sorts it and removes duplicates
  /// Reads an array of [x, y, z].
  std::vector<mesh::Vec3> places(double farthest) const;

  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "correct it in the file") const;
  [[noreturn]] void expected(const char* what) const;

private:
  using Found = std::unordered_set<const nlohmann::json*>;  // the values that find() has found
  JsonReader(const nlohmann::json& value, std::string file, std::string key, std::shared_ptr<Found> found)
      : value_(value), file_(std::move(file)), key_(std::move(key)), found_(std::move(found)) {}
  void check_size(std::size_t n) const;
  void add_ignored(const nlohmann::json& value, std::set<std::string>& keys) const;

  const nlohmann::json& value_;
  std::string file_, key_;
  std::shared_ptr<Found> found_;  // shared by all values of the file
};

/// A list of shapes. Other values of the file refer to a shape by its index.
struct ShapeTable {
  std::vector<weights::SharedShape> all;
  std::map<const void*, std::uint32_t> numbers;  ///< for the address of each shape, its index in `all`
};

/// The range of a number. The file contains the number times `factor`.
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

/// A JSON value to read or to write. Reading throws base::Error with file and key.
class JsonField {
public:
  /// `shapes` is needed for values that refer to shapes.
  explicit JsonField(const JsonReader& from, ShapeTable* shapes = nullptr) : in_(from), shapes_(shapes) {}
  explicit JsonField(nlohmann::ordered_json& to, ShapeTable* shapes = nullptr) : out_(&to), shapes_(shapes) {}

  bool reads() const { return in_.has_value(); }
  const JsonReader& in() const { return *in_; }
  nlohmann::ordered_json& out() const { return *out_; }
  ShapeTable& shapes() const { return *shapes_; }

  /// Returns a member of an object. When writing, adds the member. When reading, and the member is missing,
  /// returns nullopt or, if `needed`, throws base::Error.
  std::optional<JsonField> child(const char* key, bool needed = false) const;
  /// When reading, returns the number of items. If there are more than `most`, throws base::Error. When
  /// writing, starts an empty list and returns `count`.
  std::size_t list(std::size_t count, std::size_t most) const;
  /// When reading, returns item `index`. When writing, appends an item.
  JsonField item(std::size_t index) const;

  /// Reads or writes a member of an object. When reading, a missing member leaves the value unchanged.
  template <class T, class... Form>
  void member(const char* key, T& value, const Form&... form) const {
    if (const auto field = child(key)) code(*field, value, form...);
  }
  template <class T, class... Form>
  void needed(const char* key, T& value, const Form&... form) const {
    code(*child(key, true), value, form...);
  }
  /// Works like member(), but does not write the value `usual`.
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
/// The file contains the path in the form of path_json().
void code(const JsonField& field, std::filesystem::path& value);
void code(const JsonField& field, std::uint32_t& value);
void code(const JsonField& field, double& value, const Limits& limits);
/// Writes the fewest digits from which reading gives exactly the same float.
void code(const JsonField& field, float& value, const Limits& limits);
/// When reading, rounds to an integer.
void code(const JsonField& field, int& value, const Limits& limits);
void code(const JsonField& field, mesh::Vec3& value, const Reach& reach);
void code(const JsonField& field, glm::vec3& value, const Reach& reach);
void code(const JsonField& field, std::vector<mesh::Vec3>& value, const Reach& reach);
/// The array [width, height] of a window.
void code(const JsonField& field, glm::ivec2& window);
/// A list of indices. Reading sorts the list and removes duplicates.
void code(const JsonField& field, std::vector<std::uint32_t>& value);
/// The file contains a text of 16 hexadecimal digits.
void code(const JsonField& field, std::uint64_t& value);
/// The file contains the index of the shape in field.shapes(). Writing adds new shapes to field.shapes().
void code(const JsonField& field, weights::SharedShape& value);
/// A list of shapes. Each shape is {"float32": BYTES} or, if floats cannot store the exact coordinates,
/// {"float64": BYTES}. BYTES: x, y, z of each vertex, little-endian, in base64.
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
/// The file contains `word` in place of `value`. find(text) returns the value with this word, or nullopt.
template <class T, class Find>
void code_word(const JsonField& field, T& value, std::string_view word, const Find& find) {
  if (!field.reads()) return write_word(field, word);
  const std::string text = field.in().text();
  const auto found = find(text);
  if (!found) field.in().fail("unknown value " + formats::in_quotes(text));
  value = *found;
}
/// An enumeration with the values 0, 1, 2 ... The file contains words[value].
template <class T, std::size_t n>
void code_listed(const JsonField& field, T& value, const std::array<std::string_view, n>& words) {
  code_word(field, value, words[static_cast<std::size_t>(value)], [&](std::string_view word) {
    const auto found = std::ranges::find(words, word);
    return found == words.end() ? std::nullopt : std::optional(static_cast<T>(found - words.begin()));
  });
}

/// An enumeration with a table choices(), see base/choice.h.
template <class T>
requires requires(T value) {
  choices(value);
}
void code(const JsonField& field, T& value) {
  code_word(field, value, base::entry_of(value).word, base::value_of_word<T>);
}

}  // namespace viete::files
