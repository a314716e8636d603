#include "ui/format.h"

#include <cmath>

namespace viete::ui {

std::string error(double relative) {
  if (std::isnan(relative)) return "NaN";
  return relative == 0 ? "0" : formatted("%.1e", relative);
}

std::string rough_error(double relative) {
  if (std::isnan(relative) || relative == 0) return error(relative);
  std::string text = formatted("%.0e", relative);
  if (const auto zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

}  // namespace viete::ui
