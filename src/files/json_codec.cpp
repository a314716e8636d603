#include "files/json_codec.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/byte_order.h"
#include "base/encoding.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/text.h"
#include "document/range.h"
#include "formats/source.h"

namespace viete::files {

using nlohmann::json, nlohmann::ordered_json;
using weights::SharedShape;

std::optional<JsonField> JsonField::child(const char* key, bool needed) const {
  if (!reads()) return JsonField((*out_)[key], shapes_);
  if (needed) return JsonField(in_->at(key), shapes_);
  const auto found = in_->find(key);
  return found ? std::optional(JsonField(*found, shapes_)) : std::nullopt;
}

std::size_t JsonField::list(std::size_t count, std::size_t most) const {
  if (!reads()) {
    *out_ = ordered_json::array();
    return count;
  }
  if (in_->size() > most)
    in_->fail("the list has " + std::to_string(in_->size()) + " entries, at most " + std::to_string(most) +
              " are allowed");
  return in_->size();
}

JsonField JsonField::item(std::size_t index) const {
  if (reads()) return JsonField(in_->item(index), shapes_);
  out_->push_back(ordered_json::object());
  return JsonField(out_->back(), shapes_);
}

namespace {

template <class T, class Read, class... Limit>
void code_by(const JsonField& field, T& value, Read (JsonReader::*read)(Limit...) const, Limit... limit) {
  if (field.reads()) {
    value = (field.in().*read)(limit...);
  } else {
    field.out() = value;
  }
}

}  // namespace

void code(const JsonField& field, bool& value) {
  code_by(field, value, &JsonReader::boolean);
}
void code(const JsonField& field, std::string& value) {
  code_by(field, value, &JsonReader::text);
}
void code(const JsonField& field, std::uint32_t& value) {
  code_by(field, value, &JsonReader::index);
}
void code(const JsonField& field, std::vector<std::uint32_t>& value) {
  code_by(field, value, &JsonReader::indices);
}

void code(const JsonField& field, std::filesystem::path& value) {
  if (field.reads()) {
    value = field.in().path();
  } else {
    field.out() = path_json(value);
  }
}

void code(const JsonField& field, glm::ivec2& window) {
  if (!field.reads()) {
    field.out() = {window.x, window.y};
    return;
  }
  const auto [width, height] = field.in().numbers<2>();
  if (!document::is_window(width, height)) field.in().fail("the window size is invalid");
  window = {static_cast<int>(width), static_cast<int>(height)};
}

void write_word(const JsonField& field, std::string_view word) {
  field.out() = word;
}

// If a rounded number gives exactly `value` when it is read, writes this number: 29, not 28.999999999999996.
void code(const JsonField& field, double& value, const Limits& limits) {
  const auto [least, most, factor] = limits;
  if (field.reads()) {
    value = field.in().number(factor * least, factor * most) / factor;
  } else {
    const double rounded = std::round(1e6 * factor * value) / 1e6;
    field.out() = rounded / factor == value ? rounded : factor * value;
  }
}

void code(const JsonField& field, float& value, const Limits& limits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double shortest = value;
  std::from_chars(text, end, shortest);
  if (static_cast<float>(shortest) != value) shortest = value;
  const auto [least, most, factor] = limits;
  constexpr double rounding = 1e-6;  // the shortest digits of a limit can exceed the limit
  code(field, shortest, {least - rounding * std::abs(least), most + rounding * std::abs(most), factor});
  value = static_cast<float>(std::clamp(shortest, least, most));
}

void code(const JsonField& field, int& value, const Limits& limits) {
  double number = value;
  code(field, number, limits);
  if (field.reads()) {
    value = static_cast<int>(std::lround(number));
  } else {
    field.out() = value;
  }
}

void code(const JsonField& field, mesh::Vec3& value, const Reach& reach) {
  code_by(field, value, &JsonReader::place, reach.most);
}

void code(const JsonField& field, glm::vec3& value, const Reach& reach) {
  const Limits limits{-reach.most, reach.most};
  const std::size_t count = field.list(3, 3);
  if (count != 3) field.in().expected("a list of 3 numbers");
  for (int i = 0; i < 3; ++i) code(field.item(static_cast<std::size_t>(i)), value[i], limits);
}

void code(const JsonField& field, std::vector<mesh::Vec3>& value, const Reach& reach) {
  code_by(field, value, &JsonReader::places, reach.most);
}

void code(const JsonField& field, std::uint64_t& value) {
  if (!field.reads()) {
    char digits[16];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, 16).ptr;
    field.out() = std::string(16 - static_cast<std::size_t>(end - digits), '0') + std::string(digits, end);
    return;
  }
  const std::string text = field.in().text();
  const char* const end = text.data() + text.size();
  if (text.size() != 16 || std::from_chars(text.data(), end, value, 16).ptr != end)
    field.in().fail("the text must have 16 hexadecimal digits");
}

void code(const JsonField& field, weights::SharedShape& value) {
  auto& [all, numbers] = field.shapes();
  if (field.reads()) {
    const std::uint32_t number = field.in().index();
    if (number >= all.size())
      field.in().fail("shape " + std::to_string(number) + " does not exist, the file has " +
                      std::to_string(all.size()) + " shapes, counted from 0");
    value = all[number];
  } else {
    const auto [entry, is_new] = numbers.try_emplace(value.get(), static_cast<std::uint32_t>(all.size()));
    if (is_new) all.push_back(value);
    field.out() = entry->second;
  }
}

namespace {

// Returns the coordinates as numbers of type T, little-endian.
template <class T>
std::string bytes_of(const std::vector<mesh::Point>& points) {
  std::string bytes;
  bytes.reserve(points.size() * 3 * sizeof(T));
  for (const mesh::Point& p : points)
    for (const double x : p)
      for (const char byte : base::bytes_of_number(static_cast<T>(x))) bytes.push_back(byte);
  return bytes;
}

template <class T>
weights::SharedShape shape_of_bytes(const JsonReader& json) {
  const std::string bytes = json.base64();
  if (bytes.size() % (3 * sizeof(T)) != 0) json.fail("there must be three numbers for each vertex");
  std::vector<mesh::Point> points(bytes.size() / (3 * sizeof(T)));
  for (std::size_t n = 0; n < 3 * points.size(); ++n) {
    const auto x = static_cast<double>(base::number_of_bytes<T>(bytes.data() + n * sizeof(T)));
    if (!(std::abs(x) <= mesh::largest_coordinate))
      json.fail("a coordinate is not a finite number up to 1e100");
    points[n / 3][n % 3] = x;
  }
  return std::make_shared<const std::vector<mesh::Point>>(std::move(points));
}

bool is_float(const mesh::Point& p) {
  return std::ranges::all_of(p, [](double x) { return static_cast<double>(static_cast<float>(x)) == x; });
}

}  // namespace

void code(const JsonField& field, ShapeTable& shapes) {
  if (field.reads()) {
    for (std::size_t i = 0; i < field.in().size(); ++i) {
      const JsonReader item = field.in().item(i);
      const auto floats = item.find("float32");
      shapes.all.push_back(floats ? shape_of_bytes<float>(*floats)
                                  : shape_of_bytes<double>(item.at("float64")));
    }
  } else {
    for (const weights::SharedShape& shape : shapes.all) {
      const bool floats = std::ranges::all_of(*shape, is_float);
      field.out().push_back({{floats ? "float32" : "float64",
                              base::base64(floats ? bytes_of<float>(*shape) : bytes_of<double>(*shape))}});
    }
  }
}

namespace {

bool is_flat(const ordered_json& value) {
  return std::none_of(value.begin(), value.end(), [](const ordered_json& v) { return v.is_structured(); });
}

std::string in_one_line(const ordered_json& value) {
  return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void put(std::string& out, const ordered_json& value, const std::string& indent) {
  const bool object = value.is_object();
  if (value.empty() || !value.is_structured() || (!object && is_flat(value))) {
    out += in_one_line(value);
    return;
  }
  const std::string inner = indent + "  ";
  out += object ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, item] : value.items()) {
    out += separator + inner;
    if (object) out += in_one_line(key) + ": ";
    put(out, item, inner);
    separator = ",\n";
  }
  out += '\n' + indent + (object ? '}' : ']');
}

std::string line_of(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return std::to_string(1 + std::count(text.begin(), end, '\n'));
}

void check_length(std::size_t bytes, const std::filesystem::path& file, const char* advice) {
  if (bytes <= most_json_bytes) return;
  throw base::Error(file.string(),
                    std::to_string(bytes) + " bytes exceed the limit of " + std::to_string(most_json_bytes),
                    advice);
}

json parsed(std::string_view text, const std::filesystem::path& file) {
  const auto check_depth = [&](int depth, json::parse_event_t, const json&) {
    if (depth <= static_cast<int>(most_json_depth)) return true;
    throw base::Error(
        file.string(),
        "lists and objects are nested more than " + std::to_string(most_json_depth) + " levels deep",
        "choose another file");
  };
  const char* const advice = "correct the file or use an older copy";
  try {
    return json::parse(text, check_depth);
  } catch (const json::parse_error& error) {
    throw base::Error(file.string() + ":" + line_of(text, error.byte), "this is not valid JSON", advice);
  } catch (const json::out_of_range&) {
    throw base::Error(file.string(), "the file contains a number that is too large", advice);
  }
}

std::string described(const json& value) {
  if (value.is_number()) return "a number";
  if (value.is_string()) return "a text";
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_array()) return "a list of length " + std::to_string(value.size());
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

constexpr const char* encoded_key = "percent_encoded";

}  // namespace

std::string readable(const ordered_json& value, const std::filesystem::path& file) {
  std::string out;
  put(out, value, "");
  out += '\n';
  check_length(out.size(), file, "delete shapes or poses that you do not need");
  return out;
}

ordered_json path_json(const std::filesystem::path& path) {
  const std::string name = path.generic_string();
  if (is_utf8(name)) return name;
  const auto is_plain = [](char c) { return c > ' ' && c < 0x7f && c != '%'; };
  return {{encoded_key, base::percent_encoded(name, is_plain)}};
}

json read_json(const std::filesystem::path& path) {
  std::error_code code;
  const auto size = std::filesystem::file_size(path, code);
  if (!code) check_length(size, path, "choose another file");
  const base::FileBytes bytes(path);
  formats::refuse_foreign(path.string(), bytes.view());
  return parsed(bytes.view(), path);
}

std::optional<JsonReader> JsonReader::find(const std::string& key) const {
  if (!value_.is_object()) expected("an object");
  const auto found = value_.find(key);
  if (found == value_.end()) return std::nullopt;
  found_->insert(&*found);
  if (found->is_null()) return std::nullopt;
  return JsonReader(*found, file_, key_.empty() ? key : key_ + "." + key, found_);
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

std::set<std::string> JsonReader::ignored_keys() const {
  std::set<std::string> keys;
  add_ignored(value_, keys);
  return keys;
}

// Visits no numbers and texts in lists, so that long lists are fast.
void JsonReader::add_ignored(const json& value, std::set<std::string>& keys) const {
  if (value.is_object())
    for (const auto& [key, inner] : value.items())
      found_->contains(&inner) ? add_ignored(inner, keys) : void(keys.insert(key));
  for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
    if (value[i].is_structured()) add_ignored(value[i], keys);
}

std::size_t JsonReader::size() const {
  if (!value_.is_array()) expected("a list");
  return value_.size();
}

JsonReader JsonReader::item(std::size_t index) const {
  return JsonReader(value_.at(index), file_, key_ + "[" + std::to_string(index) + "]", found_);
}

bool JsonReader::boolean() const {
  if (!value_.is_boolean()) expected("true or false");
  return value_.get<bool>();
}

double JsonReader::number() const {
  if (!value_.is_number()) expected("a number");
  return value_.get<double>();
}

double JsonReader::number(double least, double most) const {
  const double value = number();
  if (!(value >= least && value <= most))
    fail(base::formatted("the number %.6g must be from %.6g to %.6g", value, least, most));
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
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  return all;
}

std::uint32_t JsonReader::index() const {
  const bool fits =
      value_.is_number_unsigned() && value_.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max();
  if (!fits) expected("a whole number of 0 or more");
  return value_.get<std::uint32_t>();
}

std::string JsonReader::text() const {
  if (!value_.is_string()) expected("a text");
  const auto& text = value_.get_ref<const std::string&>();
  if (text.size() > longest_text)
    fail("the text has " + std::to_string(text.size()) + " bytes, at most " + std::to_string(longest_text) +
         " are allowed");
  return text;
}

std::string JsonReader::base64() const {
  if (!value_.is_string()) expected("a text");
  auto bytes = base::bytes_of_base64(value_.get_ref<const std::string&>());
  if (!bytes) fail("the text is not base64");
  return *std::move(bytes);
}

std::filesystem::path JsonReader::path() const {
  if (value_.is_string()) return text();
  const auto encoded = value_.is_object() ? find(encoded_key) : std::nullopt;
  if (!encoded) expected("a file name");
  bool whole = true;
  const std::string name = base::percent_decoded(encoded->text(), &whole);
  if (!whole) encoded->fail("each % must be followed by two hexadecimal digits");
  return name;
}

// Creates a JsonReader only for an invalid item, so that long lists are fast.
std::vector<mesh::Vec3> JsonReader::places(double farthest) const {
  std::vector<mesh::Vec3> all(size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const json& place = value_[i];
    const auto fits = [&](const json& x) { return x.is_number() && std::abs(x.get<double>()) <= farthest; };
    const bool valid = place.is_array() && place.size() == 3 && std::ranges::all_of(place, fits);
    all[i] = valid ? place.get<std::array<double, 3>>() : item(i).place(farthest);
  }
  return all;
}

void JsonReader::check_size(std::size_t n) const {
  if (!value_.is_array() || value_.size() != n)
    expected(("a list of " + std::to_string(n) + " numbers").c_str());
}

void JsonReader::fail(const std::string& problem, const std::string& advice) const {
  throw base::Error(key_.empty() ? file_ : file_ + ": " + key_, problem, advice);
}

void JsonReader::expected(const char* what) const {
  fail(std::string("expected ") + what + ", found " + described(value_));
}

}  // namespace viete::files
