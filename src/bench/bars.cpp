#include "bench/bars.h"

#include <cmath>
#include <cstdio>

namespace viete::bench {

void Bars::check(const std::string& what, double measured, double bar, bool at_least) {
  const bool met = at_least ? measured >= bar : measured <= bar;
  const char* format =
      std::abs(measured) < 0.01 ? "  %-58s %8.1e   %s %-6g %s\n" : "  %-58s %8.2f   %s %-6g %s\n";
  std::printf(format, what.c_str(), measured, at_least ? ">=" : "<=", bar, met ? "met" : "NOT MET");
  rows.push_back({{"what", what}, {"measured", measured}, {"bar", bar}, {"met", met}});
}

}  // namespace viete::bench
