// Human-readable JSON files: formatting, and reading with errors that name file and key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/choice.h"
#include "base/error.h"
#include "mesh/formats/text_cursor.h"
#include "mesh/vector.h"

namespace viete::scene {

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

/// Numbers beyond double become 1e300 or -1e300, which every range check rejects. Throws base::Error naming
/// the file, and the line of a syntax error.
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
  double number() const;  ///< finite
  double number(double least, double most,
                const char* problem = "this number is out of range") const;  ///< in this range
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
  std::vector<std::uint32_t> indices() const;
  /// For an array of points: item `index`; nullopt unless it is [x, y, z] with |x|, |y|, |z| <= limit.
  std::optional<mesh::Vec3> point(std::size_t index, double limit) const;

  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "correct it in the file") const;
  [[noreturn]] void expected(const char* what) const;

private:
  void check_size(std::size_t n) const;

  const nlohmann::json& value_;
  std::string file_, key_;
};

/// Reads an optional part. If it is damaged, keeps its default and appends a warning.
template <class Part, class Read>
void take_part(const JsonReader& json, const char* key, Part& part, Read read, const char* instead,
               std::vector<std::string>& warnings) {
  try {
    if (const auto value = json.find(key)) part = std::invoke(read, *value);
  } catch (const base::Error& error) {
    warnings.emplace_back(base::Error(error.place(), error.problem(), instead).what());
  }
}

/// A word that `parse` recognizes.
template <class Parse>
auto word_of(const JsonReader& json, Parse parse) {
  const auto value = parse(json.text());
  if (!value) json.fail(mesh::in_quotes(json.text()) + " is not known");
  return *value;
}

/// A value of an enumeration with choices.
template <class Value>
Value choice_of(const JsonReader& json) {
  return word_of(json, base::value_of_word<Value>);
}

/// Reads each item of a list; damaged items are skipped with a warning.
template <class Read>
void take_items(const JsonReader& json, std::size_t most, const char* instead,
                std::vector<std::string>& warnings, Read read) {
  if (json.size() > most) json.fail("there are more than " + std::to_string(most));
  for (std::size_t i = 0; i < json.size(); ++i) {
    try {
      read(json.item(i));
    } catch (const base::Error& error) {
      warnings.emplace_back(base::Error(error.place(), error.problem(), instead).what());
    }
  }
}

}  // namespace viete::scene
