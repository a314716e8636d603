#include "app/passes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "base/atomic_file.h"
#include "mesh/formats/source.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

// Rows of floats, the lowest first, as PFM has them (P. Debevec).
void write_pfm(const fs::path& file, const DepthPicture& picture) {
  static_assert(std::endian::native == std::endian::little);
  char head[64];
  const int length = std::snprintf(head, sizeof head, "Pf\n%d %d\n-1.0\n", picture.width, picture.height);
  const auto row = static_cast<std::size_t>(picture.width);
  base::replace_file(file, [&](const base::ByteSink& sink) {
    sink({head, static_cast<std::size_t>(length)});
    for (int y = picture.height; y-- > 0;)
      sink({reinterpret_cast<const char*>(&picture.depths[row * static_cast<std::size_t>(y)]),
            row * sizeof(float)});
  });
}

struct Range {
  float near = 0, far = 0;
};

Range range_of(const DepthPicture& picture) {
  Range range{INFINITY, 0};
  for (const float depth : picture.depths) {
    if (depth <= 0) continue;
    range.near = std::min(range.near, depth), range.far = std::max(range.far, depth);
  }
  return range.far > 0 ? range : Range{};
}

render::Image grey_of(const DepthPicture& picture, const Range& range) {
  render::Image image = render::empty_image({picture.width, picture.height});
  const float width = std::max(range.far - range.near, 1e-30F);
  for (std::size_t i = 0; i < picture.depths.size(); ++i) {
    if (picture.depths[i] <= 0) continue;
    const float at = (picture.depths[i] - range.near) / width;
    std::fill_n(&image.rgba[4 * i], 3, static_cast<std::uint8_t>(std::lround(255 * (1 - at))));
    image.rgba[4 * i + 3] = 255;
  }
  return image;
}

std::string write_depth(Viewer& viewer, const fs::path& file) {
  const DepthPicture picture = depth_of(viewer);
  const Range range = range_of(picture);
  const bool floats = mesh::extension_of(file) == "pfm";
  floats ? write_pfm(file, picture) : render::write_png(file, grey_of(picture, range));
  char text[160];
  std::snprintf(text, sizeof text, "depth along the view: from %.9g%s to %.9g%s, in the model's units",
                range.near, floats ? "" : " (white)", range.far,
                floats ? ", 0 where the model is not" : " (black)");
  return text;
}

}  // namespace

DepthPicture depth_of(Viewer& viewer) {
  const render::Image coded = viewer.picture(render::Pass::depth);
  const ViewDrawing drawing = viewer.drawing();
  DepthPicture picture{coded.width, coded.height, std::vector<float>(coded.rgba.size() / 4, 0.0F)};
  if (drawing.parts.empty()) return picture;
  const glm::dvec2 range(depth_range(drawing.parts.front()));
  const double per_unit = 1 / viewer.workspace().document.space.scale;
  for (std::size_t i = 0; i < picture.depths.size(); ++i) {
    const std::uint8_t* c = &coded.rgba[4 * i];
    if (c[3] == 0) continue;
    const double at = (65536.0 * c[0] + 256.0 * c[1] + c[2]) / 16777215.0;
    picture.depths[i] = static_cast<float>(per_unit * (range.x + at * (range.y - range.x)));
  }
  return picture;
}

std::string write_pass(Viewer& viewer, render::Pass pass, const fs::path& file) {
  if (pass == render::Pass::depth) return write_depth(viewer, file);
  render::write_png(file, viewer.picture(pass));
  switch (pass) {
    case render::Pass::normals:
      return "normals: red, green, blue are half of x, y, z and a half, seen from the eye";
    case render::Pass::triangles:
      return "triangles: 65536 red + 256 green + blue is the number of one, from 1";
    default: return "";
  }
}

}  // namespace viete::app
