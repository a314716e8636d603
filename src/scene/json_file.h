// JSON files that people read and may have written: laid out for the eye, and read with errors that name file
// and key.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace viete::scene {

/// One key a line; an array stands on one line unless it holds arrays or objects, which get a line each.
/// Numbers with the digits that read back as the same double. Throws base::Error naming `file` if a string is
/// not UTF-8.
std::string readable(const nlohmann::ordered_json& value, const std::filesystem::path& file);

/// The name of a file: a string; where it is not UTF-8, which JSON strings are, {"percent_encoded":
/// "caf%E9"}. JsonReader::path() reads both back to the same bytes.
nlohmann::ordered_json path_json(const std::filesystem::path& path);

/// Throws base::Error naming the file, and the line of a mistake.
nlohmann::json read_json(const std::filesystem::path& path);

/// A value and the key that leads to it. Everything throws base::Error, `file: key: problem`, if the value is
/// not what is asked for. Refers to the JSON, which must outlive it.
class JsonReader {
public:
  JsonReader(const nlohmann::json& value, std::string file, std::string key = "")
      : value_(value), file_(std::move(file)), key_(std::move(key)) {}

  /// Of an object. find: nothing if the key is missing or its value is null.
  std::optional<JsonReader> find(const std::string& key) const;
  JsonReader at(const std::string& key) const;
  /// Of an array.
  std::size_t size() const;
  JsonReader item(std::size_t index) const;

  bool boolean() const;
  double number() const;  ///< finite
  std::uint32_t index() const;
  std::string text() const;
  std::filesystem::path path() const;  ///< as path_json() writes it
  /// An array of exactly N numbers.
  template <std::size_t N>
  std::array<double, N> numbers() const {
    check_size(N);
    std::array<double, N> all;
    for (std::size_t i = 0; i < N; ++i) all[i] = quick_number(i);
    return all;
  }

  [[noreturn]] void fail(const std::string& problem,
                         const std::string& advice = "correct it in the file") const;
  [[noreturn]] void expected(const char* what) const;

private:
  void check_size(std::size_t n) const;
  double quick_number(std::size_t i) const;

  const nlohmann::json& value_;
  std::string file_, key_;
};

}  // namespace viete::scene
