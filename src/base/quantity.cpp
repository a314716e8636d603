#include "base/quantity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace viete::base {

namespace {

std::string print(const char* format, double value) {
  char text[400];  // as long as any double without an exponent
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string with_thousands(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string memory_size(double bytes) {
  const double megabytes = std::max(1.0, bytes * 1e-6);
  return megabytes < 999.5 ? print("%.0f MB", megabytes) : print("%.1f GB", megabytes * 1e-3);
}

std::string few_digits(double value) {
  const double a = std::abs(value);
  if (a < 9.995) return print("%.2f", value);
  return print(a < 99.95 ? "%.1f" : "%.0f", value);
}

std::string milliseconds(double ms) {
  return std::abs(ms) < 999.5 ? few_digits(ms) + " ms" : few_digits(ms * 1e-3) + " s";
}

std::string nanoseconds(double ns) {
  return std::abs(ns) < 999.5 ? few_digits(ns) + " ns" : few_digits(ns * 1e-3) + " us";
}

}  // namespace viete::base
