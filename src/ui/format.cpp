#include "ui/format.h"

#include <cmath>
#include <cstdio>

#include "scene/quantity.h"

namespace viete::ui {

namespace {

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string significant(double value) {
  const double a = std::abs(value);
  if (a < 9.995) return print("%.2f", value);
  return print(a < 99.95 ? "%.1f" : "%.0f", value);
}

}  // namespace

std::string milliseconds(double ms) {
  return std::abs(ms) < 999.5 ? significant(ms) + " ms" : significant(ms * 1e-3) + " s";
}

std::string nanoseconds(double ns) {
  return std::abs(ns) < 999.5 ? significant(ns) + " ns" : significant(ns * 1e-3) + " us";
}

std::string count(std::size_t n) {
  return scene::with_thousands(n);
}

std::string error(double relative) {
  if (std::isnan(relative)) return "NaN";
  return relative == 0 ? "0" : print("%.1e", relative);
}

std::string length(double value) {
  return print("%.3g", value);
}

std::string ratio(double value) {
  return significant(value) + " x";
}

}  // namespace viete::ui
