#include "scene/files/json_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/encoding.h"
#include "base/error.h"
#include "mesh/formats/foreign_content.h"
#include "mesh/formats/source.h"

namespace viete::scene {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

bool is_flat(const ordered_json& value) {
  return std::none_of(value.begin(), value.end(), [](const ordered_json& v) { return v.is_structured(); });
}

void put(std::string& out, const ordered_json& value, const std::string& indent) {
  const bool object = value.is_object();
  if (value.empty() || !value.is_structured() || (!object && is_flat(value))) {
    out += value.dump();
    return;
  }
  const std::string inner = indent + "  ";
  out += object ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, item] : value.items()) {
    out += separator + inner;
    if (object) out += ordered_json(key).dump() + ": ";
    put(out, item, inner);
    separator = ",\n";
  }
  out += '\n' + indent + (object ? '}' : ']');
}

std::string line_of(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return std::to_string(1 + std::count(text.begin(), end, '\n'));
}

// Parses without building a tree, to check whether the file is within the limits.
class Survey : public nlohmann::json_sax<json> {
public:
  std::size_t error_at = 0;                ///< byte after the syntax error
  std::size_t too_large_at = 0, size = 0;  ///< first number that exceeds double; size 0: none
  bool too_deep = false;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return enter(); }
  bool key(string_t&) override { return true; }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t position, const std::string& token, const json::exception& problem) override {
    error_at = position;
    if (dynamic_cast<const json::out_of_range*>(&problem) && token.size() <= position) {
      size = token.size();
      too_large_at = position - size;
    }
    return false;
  }

private:
  bool enter() {
    too_deep = ++depth_ > most_json_depth;
    return !too_deep;
  }
  bool leave() {
    --depth_;
    return true;
  }

  std::size_t depth_ = 0;
};

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view text, std::size_t byte,
                         const std::string& problem) {
  throw base::Error(file.string() + ":" + line_of(text, byte), problem,
                    "correct the file or use an older copy");
}

void check_length(std::size_t bytes, const std::filesystem::path& file) {
  if (bytes <= most_json_bytes) return;
  throw base::Error(file.string(),
                    std::to_string(bytes) + " bytes exceed the limit of " + std::to_string(most_json_bytes),
                    "choose another file");
}

// The same text with numbers in the range of double, and checked against the limits.
std::string surveyed(std::string_view bytes, const std::filesystem::path& file) {
  constexpr int most_corrected = 16;
  std::string text(bytes);
  for (int corrected = 0;; ++corrected) {
    Survey survey;
    if (json::sax_parse(text, &survey)) return text;
    if (survey.too_deep) {
      throw base::Error(
          file.string(),
          "lists and objects are nested more than " + std::to_string(most_json_depth) + " levels deep",
          "choose another file");
    }
    if (survey.size == 0) refuse(file, text, survey.error_at, "this is not valid JSON");
    if (corrected == most_corrected) refuse(file, text, survey.error_at, "this number is too large");
    text.replace(survey.too_large_at, survey.size, text[survey.too_large_at] == '-' ? "-1e300" : "1e300");
  }
}

std::string described(const json& value) {
  if (value.is_number()) return "a number";
  if (value.is_string()) return "a text";
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  return value.is_object() ? "an object" : "null";
}

bool is_utf8(const std::string& text) {
  try {
    (void)ordered_json(text).dump();
    return true;
  } catch (const ordered_json::type_error&) {
    return false;
  }
}

bool stands_as_it_is(char c) {
  return c > ' ' && c < 0x7f && c != '%';
}

constexpr const char* encoded_key = "percent_encoded";

}  // namespace

std::string readable(const ordered_json& value, const std::filesystem::path& file) {
  std::string out;
  try {
    put(out, value, "");
  } catch (const ordered_json::type_error&) {
    throw base::Error(file.string(), "a file name in it is not UTF-8", "rename the file");
  }
  out += '\n';
  check_length(out.size(), file);
  return out;
}

ordered_json path_json(const std::filesystem::path& path) {
  const std::string name = path.generic_string();
  if (is_utf8(name)) return name;
  return {{encoded_key, base::percent_encoded(name, stands_as_it_is)}};
}

json read_json(const std::filesystem::path& path) {
  std::error_code code;
  const auto size = std::filesystem::file_size(path, code);
  if (!code) check_length(size, path);  // for other file types, reading gives a better error
  const mesh::FileBytes bytes(path, nullptr);
  mesh::refuse_foreign(path.string(), bytes.view());
  const std::string text = surveyed(bytes.view(), path);
  return json::parse(text);
}

std::optional<JsonReader> JsonReader::find(const std::string& key) const {
  if (!value_.is_object()) expected("an object");
  const auto found = value_.find(key);
  if (found == value_.end() || found->is_null()) return std::nullopt;
  return JsonReader(*found, file_, key_.empty() ? key : key_ + "." + key);
}

JsonReader JsonReader::at(const std::string& key) const {
  if (auto found = find(key)) return *std::move(found);
  fail("the key \"" + key + "\" is missing", "add it to the file");
}

std::vector<std::string> JsonReader::keys() const {
  if (!value_.is_object()) expected("an object");
  std::vector<std::string> keys;
  for (const auto& [key, value] : value_.items()) keys.push_back(key);
  return keys;
}

std::size_t JsonReader::size() const {
  if (!value_.is_array()) expected("a list");
  return value_.size();
}

JsonReader JsonReader::item(std::size_t index) const {
  return JsonReader(value_.at(index), file_, key_ + "[" + std::to_string(index) + "]");
}

bool JsonReader::boolean() const {
  if (!value_.is_boolean()) expected("true or false");
  return value_.get<bool>();
}

double JsonReader::number() const {
  if (!value_.is_number()) expected("a number");
  return value_.get<double>();
}

double JsonReader::number(double least, double most, const char* problem) const {
  const double value = number();
  if (!(value >= least && value <= most)) fail(problem);
  return value;
}

std::array<double, 3> JsonReader::place(double farthest) const {
  const auto place = numbers<3>();
  for (const double x : place)
    if (!(std::abs(x) <= farthest)) fail("this coordinate is too large");
  return place;
}

std::vector<std::uint32_t> JsonReader::indices() const {
  std::vector<std::uint32_t> all(size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = item(i).index();
  return all;
}

std::uint32_t JsonReader::index() const {
  const bool fits =
      value_.is_number_unsigned() && value_.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
  if (!fits) expected("a whole number from 0 on");
  return value_.get<std::uint32_t>();
}

std::string JsonReader::text() const {
  if (!value_.is_string()) expected("a text");
  const auto& text = value_.get_ref<const std::string&>();
  if (text.size() > longest_text) {
    fail("a text of " + std::to_string(text.size()) + " bytes is longer than allowed (" +
         std::to_string(longest_text) + ")");
  }
  return text;
}

std::string JsonReader::base64() const {
  if (!value_.is_string()) expected("a text");
  auto bytes = base::bytes_of_base64(value_.get_ref<const std::string&>());
  if (!bytes) fail("this is not base64");
  return *std::move(bytes);
}

std::filesystem::path JsonReader::path() const {
  if (value_.is_string()) return text();
  const auto encoded = value_.is_object() ? find(encoded_key) : std::nullopt;
  if (!encoded) expected("the name of a file");
  bool whole = true;
  const std::string name = base::percent_decoded(encoded->text(), &whole);
  if (!whole) encoded->fail("each % must be followed by two hexadecimal digits");
  return name;
}

// Avoids building the key path of each element: these lists are long.
std::optional<mesh::Vec3> JsonReader::point(std::size_t index, double limit) const {
  const json& values = value_[index];
  if (!values.is_array() || values.size() != 3) return std::nullopt;
  mesh::Vec3 point;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!values[i].is_number()) return std::nullopt;
    point[i] = values[i].get<double>();
    if (!(std::abs(point[i]) <= limit)) return std::nullopt;
  }
  return point;
}

void JsonReader::check_size(std::size_t n) const {
  if (!value_.is_array() || value_.size() != n)
    expected(("a list of " + std::to_string(n) + " numbers").c_str());
}

void JsonReader::fail(const std::string& problem, const std::string& advice) const {
  throw base::Error(key_.empty() ? file_ : file_ + ": " + key_, problem, advice);
}

void JsonReader::expected(const char* what) const {
  fail("found " + described(value_) + " where " + what + " belongs");
}

}  // namespace viete::scene
