#include "scene/json_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "mesh/source.h"

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

// As in file URIs (RFC 3986): what is not plain ASCII by two hexadecimal digits, the percent sign too.
std::string percent_encoded(const std::string& bytes) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 0x7f && c != '%') {
      text += c;
    } else {
      text += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return text;
}

// Nothing where two digits are missing.
std::optional<std::string> percent_decoded(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      bytes += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    unsigned byte = 0;
    const char* const end = text.data() + i + 3;
    if (std::from_chars(text.data() + i + 1, end, byte, 16).ptr != end) return std::nullopt;
    bytes += static_cast<char>(byte);
    i += 2;
  }
  return bytes;
}

constexpr const char* encoded_key = "percent_encoded";

}  // namespace

std::string readable(const ordered_json& value, const std::filesystem::path& file) {
  std::string out;
  try {
    put(out, value, "");
  } catch (const ordered_json::type_error&) {
    throw base::Error(file.string(), "the name of a file in it is not UTF-8", "rename that file");
  }
  return out + '\n';
}

ordered_json path_json(const std::filesystem::path& path) {
  const std::string name = path.generic_string();
  if (is_utf8(name)) return name;
  return {{encoded_key, percent_encoded(name)}};
}

json read_json(const std::filesystem::path& path) {
  const mesh::FileBytes bytes(path, nullptr);
  try {
    return json::parse(bytes.view());
  } catch (const json::parse_error& error) {
    throw base::Error(path.string() + ":" + line_of(bytes.view(), error.byte), "this is not valid JSON",
                      "correct the file or take an older copy of it");
  } catch (const json::exception&) {
    throw base::Error(path.string(), "it holds a number that is too large", "correct it in the file");
  }
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

std::uint32_t JsonReader::index() const {
  const bool fits =
      value_.is_number_unsigned() && value_.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
  if (!fits) expected("a whole number from 0 on");
  return value_.get<std::uint32_t>();
}

std::string JsonReader::text() const {
  if (!value_.is_string()) expected("a text");
  return value_.get<std::string>();
}

std::filesystem::path JsonReader::path() const {
  if (value_.is_string()) return text();
  const auto encoded = value_.is_object() ? find(encoded_key) : std::nullopt;
  if (!encoded) expected("the name of a file");
  const auto name = percent_decoded(encoded->text());
  if (!name) encoded->fail("two hexadecimal digits belong behind each %");
  return *name;
}

// Without the cost of naming each element, for the long lists.
double JsonReader::quick_number(std::size_t i) const {
  const json& value = value_[i];
  return value.is_number() ? value.get<double>() : item(i).number();
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
