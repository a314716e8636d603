// Human-readable JSON files: formatting, and reading with errors that name file and key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace viete::scene
