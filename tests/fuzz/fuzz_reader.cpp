// One input, one reader: it must answer with a sound surface or with base::Error, and nothing else.
//
// Built once per format (VIETE_FUZZ_READ is the reader). With VIETE_LIBFUZZER and clang, libFuzzer calls it;
// else driver.cpp.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "mesh/gltf.h"
#include "mesh/obj.h"
#include "mesh/off.h"
#include "mesh/ply.h"
#include "mesh/stl.h"
#include "mesh/summary.h"

using namespace viete::mesh;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_invariants(const Surface& s, std::size_t bytes) {
  for (const auto& p : s.positions) {
    for (const double x : p) require(std::isfinite(x) && std::abs(x) <= 1e100);
  }
  require(s.polygon_starts.empty() || s.polygon_starts.back() == s.corners.size());
  require(s.triangles.size() == s.triangle_polygon.size());
  for (const auto c : s.corners) require(c < s.positions.size());
  for (const auto& t : s.triangles) {
    for (const auto v : t) require(v < s.positions.size());
  }
  // No more than the file can hold, or place by its nodes.
  constexpr std::size_t placed = VIETE_FUZZ_PLACED;
  require(s.positions.size() <= bytes + placed && s.corners.size() <= 4 * (bytes + placed) + 64);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Source source{"fuzz", "", std::string_view(reinterpret_cast<const char*>(data), size), nullptr};
  try {
    const ReadResult read = VIETE_FUZZ_READ(source);
    check_invariants(read.surface, size);
    if (size < 20000) summarize(read.surface);
  } catch (const viete::base::Error& error) {
    require(!error.place().empty());
  }
  return 0;
}
