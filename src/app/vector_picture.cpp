#include "app/vector_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <utility>
#include <vector>

#include "app/passes.h"
#include "base/base64.h"
#include "base/picture.h"
#include "scene/document/selection_sets.h"
#include "scene/hand/projector.h"

namespace viete::app {

namespace {

constexpr float step = 0.5F;  // of a line, logical pixels, between places where it is looked for
constexpr double hidden_opacity = 0.25, visible_opacity = 0.9;
constexpr float vertex_radius = 3;

std::string printed(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string printed(const char* format, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string hex(const glm::vec3& color) {
  const glm::ivec3 c(glm::round(255.0F * color));
  return printed("#%02x%02x%02x", c.x, c.y, c.z);
}

// Whether the model stands before places of the view.
class Sightline {
public:
  explicit Sightline(Viewer& viewer)
      : depth_(depth_of(viewer)),
        unit_(static_cast<float>(1 / viewer.workspace().document.space.scale)),
        size_(viewer.workspace().viewport.window) {}

  /// x, y in logical pixels, z the depth in view units.
  bool hidden(const glm::vec3& place) const {
    const int x = static_cast<int>(place.x / size_.x * static_cast<float>(depth_.width));
    const int y = static_cast<int>(place.y / size_.y * static_cast<float>(depth_.height));
    if (x < 0 || y < 0 || x >= depth_.width || y >= depth_.height) return false;
    const float model = depth_.depths[static_cast<std::size_t>(y) * static_cast<std::size_t>(depth_.width) +
                                      static_cast<std::size_t>(x)];
    return model > 0 && model < 0.998F * unit_ * place.z;
  }

private:
  DepthPicture depth_;
  float unit_;
  glm::vec2 size_;
};

std::string line(const glm::vec2& a, const glm::vec2& b, bool hidden) {
  return printed("<line class=\"%s\" x1=\"%.3f\" y1=\"%.3f\" x2=\"%.3f\" y2=\"%.3f\"/>\n",
                 hidden ? "hidden" : "seen", a.x, a.y, b.x, b.y);
}

// In pieces, hidden and seen in turn.
std::string pieces(const Sightline& sight, const std::array<glm::vec3, 2>& edge) {
  const glm::vec2 a(edge[0]), b(edge[1]);
  const int steps = std::clamp(static_cast<int>(glm::distance(a, b) / step), 1, 100'000);
  // Depths are not even along a line on the screen, their inverses are.
  const auto place = [&](int i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    return glm::vec3(glm::mix(a, b, t), 1 / glm::mix(1 / edge[0].z, 1 / edge[1].z, t));
  };
  std::string text;
  glm::vec2 begun = a;
  bool hidden = sight.hidden(place(0));
  for (int i = 1; i <= steps; ++i) {
    const glm::vec3 at = place(i);
    const bool now = i < steps ? sight.hidden(at) : !hidden;
    if (now == hidden) continue;
    text += line(begun, glm::vec2(at), hidden);
    begun = glm::vec2(at), hidden = now;
  }
  return text;
}

std::string cage_lines(Viewer& viewer, const Sightline& sight) {
  const scene::Workspace& w = viewer.workspace();
  const scene::Document& document = w.document;
  const scene::Projector project(document.space, w.camera, w.viewport);
  const auto hidden = scene::hidden_elements(document, scene::ElementKind::edge);
  std::string text;
  for (std::size_t e = 0; e < document.cage->edges.size(); ++e) {
    if (hidden[e]) continue;
    const auto [a, b] = document.cage->edges[e];
    if (const auto edge = project.segment(document.pose.positions[a], document.pose.positions[b]))
      text += pieces(sight, *edge);
  }
  return text;
}

std::string cage_vertices(Viewer& viewer, const Sightline& sight) {
  const scene::Workspace& w = viewer.workspace();
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  std::vector<char> skipped(w.document.pose.positions.size(), 0);
  for (const auto v : w.document.groups.hidden) skipped[v] = 1;
  std::string text;
  for (std::size_t v = 0; v < skipped.size(); ++v) {
    const auto at = project(w.document.pose.positions[v]);
    if (skipped[v] || !at) continue;
    text += printed("<circle class=\"%s\" cx=\"%.3f\" cy=\"%.3f\" r=\"%g\"/>\n",
                    sight.hidden(*at) ? "hidden" : "seen", at->x, at->y, vertex_radius);
  }
  return text;
}

}  // namespace

std::string svg_of(Viewer& viewer, float width) {
  scene::Workspace& w = viewer.workspace();
  const bool cage = std::exchange(w.view.cage, false) && w.document.has_cage();
  viewer.frame(0);
  const render::Image image = viewer.picture();
  const std::string png = base::encode_png("picture", image.width, image.height, 4, image.rgba);
  w.view.cage = cage;
  const glm::vec2 size = w.viewport.window;
  const render::Theme theme = w.view.dark ? render::dark_theme() : render::light_theme();
  std::string text =
      printed("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\">\n",
              size.x, size.y, size.x, size.y);
  text += printed(
      "<style>line{stroke:%s;stroke-width:%g;stroke-linecap:round}circle{fill:%s;stroke:%s;stroke-width:1}",
      hex(theme.cage).c_str(), width, hex(theme.cage).c_str(), hex(theme.outline).c_str());
  text += printed(".seen{opacity:%g}.hidden{opacity:%g}</style>\n", visible_opacity, hidden_opacity);
  text += printed("<image width=\"%g\" height=\"%g\" href=\"data:image/png;base64,", size.x, size.y) +
          base::base64(png) + "\"/>\n";
  if (cage) {
    const Sightline sight(viewer);
    text += cage_lines(viewer, sight) + cage_vertices(viewer, sight);
  }
  return text + "</svg>\n";
}

}  // namespace viete::app
