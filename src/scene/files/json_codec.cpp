#include "scene/files/json_codec.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/encoding.h"
#include "mesh/formats/byte_order.h"
#include "scene/document/range.h"

namespace viete::scene {

using deform::SharedShape;
using nlohmann::ordered_json;

std::optional<JsonField> JsonField::child(const char* key, bool needed) const {
  if (!reads()) return JsonField((*out_)[key], *shapes_);
  if (needed) return JsonField(in_->at(key), *shapes_);
  const auto found = in_->find(key);
  return found ? std::optional(JsonField(*found, *shapes_)) : std::nullopt;
}

std::size_t JsonField::list(std::size_t count, std::size_t most) const {
  if (!reads()) return *out_ = ordered_json::array(), count;
  if (in_->size() > most) in_->fail("there are more than " + std::to_string(most));
  return in_->size();
}

JsonField JsonField::item(std::size_t index) const {
  if (reads()) return JsonField(in_->item(index), *shapes_);
  out_->push_back(ordered_json::object());
  return JsonField(out_->back(), *shapes_);
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
  if (!is_window(width, height)) field.in().fail("this is not a valid window size");
  window = {static_cast<int>(width), static_cast<int>(height)};
}

void write_word(const JsonField& field, std::string_view word) {
  field.out() = word;
}

// Written rounded, as typed by the user, if that reads back as the same number: 29 instead of
// 28.999999999999996.
void code(const JsonField& field, double& value, const Limits& limits) {
  const auto [least, most, factor] = limits;
  if (field.reads()) {
    value = field.in().number(factor * least, factor * most) / factor;
  } else {
    const double typed = std::round(1e6 * factor * value) / 1e6;
    field.out() = typed / factor == value ? typed : factor * value;
  }
}

void code(const JsonField& field, float& value, const Limits& limits) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double shortest = value;
  std::from_chars(text, end, shortest);
  if (static_cast<float>(shortest) != value) shortest = value;
  const auto [least, most, factor] = limits;
  constexpr double rounding = 1e-6;  // the limit itself may have been written with fewer digits
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
    field.in().fail("these are not 16 hexadecimal digits");
}

void code(const JsonField& field, SharedShape& value) {
  auto& [all, numbers] = field.shapes();
  if (field.reads()) {
    const std::uint32_t number = field.in().index();
    if (number >= all.size()) field.in().fail("there is no such shape");
    value = all[number];
  } else {
    const auto [entry, is_new] = numbers.try_emplace(value.get(), static_cast<std::uint32_t>(all.size()));
    if (is_new) all.push_back(value);
    field.out() = entry->second;
  }
}

namespace {

// The bytes of numbers as T, little-endian.
template <class T>
std::string bytes_of(const std::vector<mesh::Point>& points) {
  std::string bytes;
  bytes.reserve(points.size() * 3 * sizeof(T));
  for (const mesh::Point& p : points)
    for (const double x : p)
      for (const char byte : mesh::bytes_of_number(static_cast<T>(x))) bytes.push_back(byte);
  return bytes;
}

template <class T>
SharedShape shape_of_bytes(const JsonReader& json) {
  const std::string bytes = json.base64();
  if (bytes.size() % (3 * sizeof(T)) != 0) json.fail("its size is not three numbers for each vertex");
  std::vector<mesh::Point> points(bytes.size() / (3 * sizeof(T)));
  for (std::size_t n = 0; n < 3 * points.size(); ++n) {
    const auto x = static_cast<double>(mesh::number_of_bytes<T>(bytes.data() + n * sizeof(T)));
    if (!(std::abs(x) <= largest_coordinate)) json.fail("a number is too large");
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
    for (const SharedShape& shape : shapes.all) {
      const bool floats = std::ranges::all_of(*shape, is_float);
      field.out().push_back({{floats ? "float32" : "float64",
                              base::base64(floats ? bytes_of<float>(*shape) : bytes_of<double>(*shape))}});
    }
  }
}

}  // namespace viete::scene
