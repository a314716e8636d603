#include "bench/frame_bars.h"

#include <algorithm>
#include <cmath>

namespace viete::bench {

namespace {

using namespace frame_names;

/// Of one number of vertices; null where it was not measured.
class Times {
public:
  Times(std::span<const FrameTime> all, std::size_t vertices) : all_(all), vertices_(vertices) {}

  std::size_t vertices() const { return vertices_; }

  const FrameTime* of(const std::string& name, std::size_t faces, bool threaded = false) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const FrameTime& t) {
      return t.vertices == vertices_ && t.name == name && t.faces == faces && (t.threads > 1) == threaded;
    });
    return found == all_.end() ? nullptr : &*found;
  }

  double worst_error(const std::string& name) const {
    double worst = -1;
    for (const auto& t : all_) {
      if (t.vertices == vertices_ && t.name == name) worst = std::fmax(worst, t.error);
    }
    return worst;
  }

private:
  std::span<const FrameTime> all_;
  std::size_t vertices_;
};

std::string at(std::size_t faces) {
  return ", " + std::to_string(faces) + " faces";
}

void check_ratio(const std::string& what, const FrameTime* over, const FrameTime* under, double bar,
                 bool at_least, Bars& bars) {
  if (over && under) bars.check(what, over->cpu_ms / under->cpu_ms, bar, at_least);
}

void check_speed(const Times& times, Bars& bars) {
  const struct {
    const char* name;
    std::array<double, 3> bars;
  } paths[] = {{dense, {16, 14, 12}}, {compressed, {26, 32, 45}}, {dragged, {35, 50, 110}}};
  constexpr std::array<std::size_t, 3> faces = {50, 100, 300};
  for (const auto& path : paths) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      check_ratio(std::string("reference / ") + path.name + at(faces[i]), times.of(reference, faces[i]),
                  times.of(path.name, faces[i]), path.bars[i], true, bars);
    }
  }
  check_ratio("one vertex dragged: 600 / 50 faces", times.of(dragged, 600), times.of(dragged, 50), 1.5, false,
              bars);
  check_ratio("compressed: 300 / 50 faces", times.of(compressed, 300), times.of(compressed, 50), 2.5, false,
              bars);
  check_ratio("exponentials alone / compressed" + at(300), times.of(exponential, 300),
              times.of(compressed, 300), 0.1, false, bars);
  for (const auto& [name, bar] : {std::pair{dense, 1.8}, {compressed, 1.5}}) {
    const auto* threaded = times.of(name, 300, true);
    if (!threaded) continue;
    check_ratio(std::string(name) + at(300) + ": one thread / " + std::to_string(threaded->threads),
                times.of(name, 300), threaded, bar, true, bars);
  }
}

// The larger of the two: what the slower of memory and arithmetic allows.
void check_floor(const Times& times, Bars& bars) {
  const auto *frame = times.of(dense, 300), *read = times.of(read_floor, 300),
             *sums = times.of(multiply_add_floor, 300);
  if (!frame || !read || !sums) return;
  const double fused = frame->links[deform::Link::fused], floor = std::max(read->cpu_ms, sums->cpu_ms);
  bars.check("fused pass, dense / the larger floor" + at(300), fused / floor, 1.6, false);
}

void check_errors(const Times& times, Bars& bars) {
  for (const auto& [name, bar] :
       {std::pair{dense, 1e-6}, {dragged, 2e-5}, {staged_fast, 1e-13}, {compressed, 2e-5}}) {
    const double error = times.worst_error(name);
    if (error >= 0) bars.check(std::string(name) + ": error in diagonals", error, bar, false);
  }
}

void check_memory(const Times& times, double bar, Bars& bars) {
  const auto *full = times.of(dense, 300), *small = times.of(compressed, 300);
  if (!full || !small) return;
  bars.check("bytes, compressed / dense, " + std::to_string(times.vertices()) + " vertices" + at(300),
             static_cast<double>(small->bytes) / static_cast<double>(full->bytes), bar, false);
}

}  // namespace

void check_frame(std::span<const FrameTime> times, Bars& bars) {
  if (times.empty()) return;
  const auto [least, most] = std::minmax_element(
      times.begin(), times.end(), [](const auto& a, const auto& b) { return a.vertices < b.vertices; });
  const Times small(times, least->vertices), large(times, most->vertices);
  check_speed(small, bars);
  check_floor(small, bars);
  check_errors(small, bars);
  check_memory(small, 1.0 / 4, bars);
  if (large.vertices() < 8 * small.vertices()) return;
  check_memory(large, 1.0 / 9, bars);
  const auto *a = small.of(compressed, 300), *b = large.of(compressed, 300);
  if (!a || !b) return;
  const double growth = static_cast<double>(large.vertices()) / static_cast<double>(small.vertices());
  bars.check("compressed, time a vertex: " + std::to_string(large.vertices()) + " / " +
                 std::to_string(small.vertices()) + " vertices",
             b->cpu_ms / a->cpu_ms / growth, 1.0, false);
}

}  // namespace viete::bench
