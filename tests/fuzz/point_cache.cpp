#include <cmath>

#include "base/error.h"
#include "formats/point_cache.h"
#include "fuzz/checks.h"

void viete::fuzz::check_point_cache(std::string_view bytes) {
  const std::size_t size = bytes.size();
  try {
    const formats::PointCache cache("fuzz", bytes);
    const formats::PointCacheHead& head = cache.head();
    require(head.points > 0 && head.frames > 0);
    require(head.points <= size && head.frames <= size && 12 * head.points * head.frames <= size);
    require(head.seconds.size() == (head.format == formats::PointCacheFormat::mdd ? head.frames : 0));
    require(std::isfinite(head.start) && std::isfinite(head.rate) && head.rate > 0);
    for (const std::size_t i : {std::size_t{0}, head.frames - 1}) {
      const auto points = cache.frame(i);
      require(points.size() == head.points);
      for (const auto& p : points) require(std::isfinite(p[0] + p[1] + p[2]));
    }
  } catch (const base::Error& error) {
    require(!error.place().empty());
  }
}
