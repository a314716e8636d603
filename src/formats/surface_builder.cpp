#include "formats/surface_builder.h"

#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "mesh/triangulation.h"

namespace viete::formats {

constexpr std::size_t most_indices = std::numeric_limits<std::uint32_t>::max();

void SurfaceBuilder::position(const mesh::Point& p) {
  if (vertex_count() >= most_indices)
    throw base::Error(source_.name, "the file has more than 4294967295 vertices", "split the model");
  result_.surface.positions.push_back(p);
}

void SurfaceBuilder::end_polygon() {
  mesh::Surface& s = result_.surface;
  if (s.corners.size() > most_indices)
    throw base::Error(source_.name, "the file has more than 4294967295 polygon corners", "split the model");
  if (s.corners.size() < s.polygon_starts.back() + std::size_t{3}) {
    s.corners.resize(s.polygon_starts.back());
    ++short_polygons_;
    return;
  }
  s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
}

void SurfaceBuilder::comment(std::string_view text) {
  if (result_.comments.size() >= 64) return;
  std::string kept = clipped(text);
  if (!kept.empty()) result_.comments.push_back(std::move(kept));
}

void SurfaceBuilder::comments(TextCursor& text) {
  for (; !text.at_end() && text.at_line_end(); text.next_line()) comment(text.rest_of_line());
}

ReadResult SurfaceBuilder::finish(std::string format, Attributes attributes) {
  for (std::string& warning : result_.warnings) warning = base::printable(warning);
  if (result_.surface.positions.empty())
    throw base::Error(source_.name, "no vertices found in this " + format + " file",
                      "export the model again");
  if (short_polygons_ > 0)
    warn("ignored " + base::counted(short_polygons_, "face") + " with fewer than three corners");
  if (result_.surface.polygon_count() == 0 && !result_.splats)
    warn("the file has no faces, only a set of points");
  result_.format = std::move(format);
  if (!attributes.empty()) result_.attributes = std::make_shared<const Attributes>(std::move(attributes));
  triangulate(result_.surface);
  source_.report(1);
  return std::move(result_);
}

}  // namespace viete::formats
