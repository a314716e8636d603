#include "formats/text_writer.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text.h"

namespace viete::formats {

namespace {

constexpr int most_decimals = 330;

constexpr auto powers_of_ten = [] {
  std::array<double, 16> powers{};
  double power = 1;
  for (double& p : powers) {
    p = power;
    power *= 10;
  }
  return powers;
}();

// A double represents every integer up to this limit exactly.
constexpr double largest_whole = 9007199254740992.0;

// Prints `value` with fixed decimals, from the integer value * 10^decimals. This is ten times as fast as
// std::to_chars, but can round ties differently.
char* print_whole(double value, int decimals, char* to) {
  if (std::signbit(value)) *to++ = '-';
  auto whole = static_cast<std::uint64_t>(std::abs(value) * powers_of_ten[decimals] + 0.5);
  char digits[24];
  char* const end = digits + sizeof digits;
  char* at = end;
  for (int i = 0; i < decimals; ++i, whole /= 10) *--at = static_cast<char>('0' + whole % 10);
  if (decimals > 0) *--at = '.';
  do {
    *--at = static_cast<char>('0' + whole % 10);
    whole /= 10;
  } while (whole > 0);
  return std::copy(at, end, to);
}

char* print_fixed(double value, int decimals, std::span<char> room) {
  const bool quick = decimals < static_cast<int>(powers_of_ten.size()) &&
                     std::abs(value) * powers_of_ten[decimals] < largest_whole / 2;
  if (quick) return print_whole(value, decimals, room.data());
  char* const end = room.data() + room.size();
  if (std::abs(value) >= largest_whole) return std::to_chars(room.data(), end, value).ptr;
  return std::to_chars(room.data(), end, value, std::chars_format::fixed, decimals).ptr;
}

char* without_zeros(char* from, char* to) {
  if (std::find(from, to, '.') == to) return to;
  while (to[-1] == '0') --to;
  return to[-1] == '.' ? to - 1 : to;
}

[[noreturn]] void refuse(const std::string& place, std::size_t vertex, const mesh::Point& p, double largest) {
  if (!is_place(p))
    throw base::Error(
        place,
        base::formatted("the position of vertex %zu is invalid (%.3g %.3g %.3g)", vertex, p[0], p[1], p[2]),
        "choose other weights, another blend, or a pose nearer to rest");
  throw base::Error(place,
                    base::formatted("the position of vertex %zu is beyond %.3g (%.3g %.3g %.3g)", vertex,
                                    largest, p[0], p[1], p[2]),
                    "scale the model, or save as .obj or .ply, which store larger numbers");
}

}  // namespace

void Printed::learn(std::string_view word) {
  if (word.empty()) return;
  const std::size_t exponent = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, exponent);
  const std::size_t point = mantissa.find('.');
  const auto size = point == std::string_view::npos ? 0 : mantissa.size() - point - 1;
  const int decimals = static_cast<int>(std::min<std::size_t>(size, most_decimals));
  if (exponent != std::string_view::npos) {
    ++with_exponent_;
    capital_ |= word[exponent] == 'E';
    most_mantissa_ = std::max(most_mantissa_, decimals);
    return;
  }
  ++plain_;
  most_ = std::max(most_, decimals);
  least_ = std::min(least_, decimals);
}

void Printed::keep(int significant, double size) {
  if (!(size > 0) || !std::isfinite(size)) return;
  const int magnitude = static_cast<int>(std::floor(std::log10(size)));
  needed_ = std::clamp(significant - 1 - magnitude, 0, most_decimals);
  needed_mantissa_ = significant - 1;
}

int Printed::decimals() const {
  if (digits_.kind == Digits::Kind::decimals) return digits_.decimals;
  return std::max(most_, needed_);
}

std::string_view Printed::print(double value, std::span<char> room) const {
  value += 0.0;  // -0 becomes 0
  char* const from = room.data();
  char* to = from;
  if (digits_.kind == Digits::Kind::all) {
    to = std::to_chars(from, from + room.size(), value).ptr;
  } else if (digits_.kind == Digits::Kind::as_printed && exponents()) {
    const int digits = std::min(16, std::max(most_mantissa_, needed_mantissa_));
    to = std::to_chars(from, from + room.size(), value, std::chars_format::scientific, digits).ptr;
    if (capital_) std::replace(from, to, 'e', 'E');
  } else {
    to = print_fixed(value, decimals(), room);
    const bool even = digits_.kind == Digits::Kind::decimals || (least_ == most_ && most_ >= needed_);
    if (!even && std::abs(value) < largest_whole) to = without_zeros(from, to);
  }
  return {from, static_cast<std::size_t>(to - from)};
}

bool Printed::same(double a, double b) const {
  std::array<char, 400> of_a, of_b;
  return print(a, of_a) == print(b, of_b);
}

void print_point(const mesh::Point& p, TextWriter& out) {
  if (out.digits().kind != Digits::Kind::decimals) {
    out.point(p);
    return;
  }
  const Printed printed(out.digits());
  std::array<char, 400> room;
  for (std::size_t i = 0; i < 3; ++i) out.text(i > 0 ? " " : "").text(printed.print(p[i], room));
}

void check_written(const std::string& place, std::size_t vertex, const mesh::Point& p, double largest) {
  if (!is_place(p, largest)) refuse(place, vertex, p, largest);
}

void check_written(const std::string& place, std::span<const mesh::Point> positions, double largest) {
  if (positions.empty())
    throw base::Error(place, "there are no vertices to write", "choose a mesh with vertices");
  for (std::size_t v = 0; v < positions.size(); ++v) check_written(place, v, positions[v], largest);
}

std::vector<std::string> rounding_notes(double error, double diagonal) {
  if (!(error > 5e-7 * diagonal)) return {};
  return {base::formatted(
      "the number type of the file rounds coordinates by up to %.2g (%.2g %% of the model's diagonal); to "
      "keep them exact, save as .obj or move the model to the origin",
      error, diagonal > 0 ? 100 * error / diagonal : 100)};
}

}  // namespace viete::formats
