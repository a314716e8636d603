// Pictures for papers: in tiles, what passes tell of each pixel, and a cage of lines.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "app/passes.h"
#include "app/vector_picture.h"
#include "base/error.h"
#include "program/driver.h"
#include "scene/hand/projector.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;
using test::Driver;

namespace {

app::ViewerOptions options_of(int samples, int longest_tile = 0) {
  auto options = Driver::default_options();
  options.size = {640, 400};
  options.samples = samples;
  options.longest_tile = longest_tile;
  return options;
}

void show(Driver& d, bool panels) {
  d.open_dragon("pose_alert");
  d.workspace().view.panels = panels;
  d.frame();
  scene::frame_all(d.workspace(), false);
  d.settle();
}

// Which part of the pixels differs by more than so many levels.
double differing(const render::Image& a, const render::Image& b, int levels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int here = 0;
    for (std::size_t k = 0; k < 4; ++k) here = std::max(here, std::abs(a.rgba[i + k] - b.rgba[i + k]));
    count += here > levels;
  }
  return 4.0 * static_cast<double>(count) / static_cast<double>(a.rgba.size());
}

}  // namespace

TEST_CASE("a_picture_in_tiles_is_the_picture") {
  for (const bool panels : {false, true}) {
    for (const bool orthographic : {false, true}) {
      CAPTURE(panels);
      CAPTURE(orthographic);
      const auto picture = [&](int longest_tile) {
        Driver d(options_of(0, longest_tile), test::with_pixels);
        show(d, panels);
        d.workspace().remembered.layout.folded = {false, true};  // timings differ in every run
        d.workspace().camera.set_orthographic(orthographic);
        d.settle();
        return d.picture();
      };
      const render::Image whole = picture(0), tiles = picture(97);
      REQUIRE(whole.rgba.size() == tiles.rgba.size());
      // A sample on an edge may fall on its other side by a rounding, and light may round to the next level.
      CHECK(differing(whole, tiles, 0) < 0.01);
      CHECK(differing(whole, tiles, 2) < 5e-4);
    }
  }
}

TEST_CASE("depth_is_how_far_what_is_seen_is_along_the_view") {
  for (const bool orthographic : {false, true}) {
    CAPTURE(orthographic);
    Driver d(options_of(0, 150), test::with_pixels);
    show(d, false);
    d.workspace().camera.set_orthographic(orthographic);
    d.settle();
    const app::DepthPicture picture = app::depth_of(d.viewer());
    REQUIRE(picture.width == 640);
    const scene::Workspace& w = d.workspace();
    const double scale = w.document.space.scale;
    const scene::Projector project(w.document.space, w.camera, w.viewport);
    const auto positions = d.exact_positions();
    std::size_t seen = 0, behind = 0;
    for (const auto& p : positions) {
      const glm::vec3 at = *project(p);
      const float depth =
          picture.depths[static_cast<std::size_t>(at.y) * 640 + static_cast<std::size_t>(at.x)];
      const double own = at.z / scale;
      if (depth == 0) continue;  // at the outline
      // A pixel is as wide as a thousandth of the model: what slants is nearer or farther in it by some of
      // that.
      if (depth < own - 0.02 * own) ++behind;
      if (std::abs(depth - own) < 0.004 * own) ++seen;
    }
    CHECK(static_cast<double>(seen) > 0.25 * static_cast<double>(positions.size()));
    CHECK(static_cast<double>(behind) > 0.1 * static_cast<double>(positions.size()));
    CHECK(static_cast<double>(seen + behind) > 0.6 * static_cast<double>(positions.size()));
  }
}

TEST_CASE("each_pixel_tells_its_triangle_and_where_it_faces") {
  Driver d(options_of(0), test::with_pixels);
  show(d, false);
  const scene::Workspace& w = d.workspace();
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  const auto positions = d.exact_positions();
  const auto& triangles = w.document.model.surface->triangles;
  const render::Image numbers = d.viewer().picture(render::Pass::triangles);
  const render::Image normals = d.viewer().picture(render::Pass::normals);
  std::size_t count = 0, away = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 640; ++x) {
      const auto c = numbers.pixel(x, y);
      REQUIRE((c[3] == 0 || c[3] == 255));
      CHECK(normals.pixel(x, y)[3] == c[3]);
      if (c[3] == 0) continue;
      ++count;
      const std::size_t number = 65536u * c[0] + 256u * c[1] + c[2];
      REQUIRE(number >= 1);
      REQUIRE(number <= triangles.size());
      glm::vec2 low(1e9f), high(-1e9f);
      for (const auto v : triangles[number - 1]) {
        const glm::vec2 at(*project(positions[v]));
        low = glm::min(low, at), high = glm::max(high, at);
      }
      const glm::vec2 middle(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      CHECK(glm::all(glm::lessThan(low - 0.01f, middle)));
      CHECK(glm::all(glm::lessThan(middle, high + 0.01f)));
      const auto n = normals.pixel(x, y);
      const glm::vec3 normal = 2.0f * glm::vec3(n[0], n[1], n[2]) / 255.0f - 1.0f;
      CHECK(glm::length(normal) == doctest::Approx(1).epsilon(0.02));
      away += normal.z < -0.3f;
    }
  }
  CHECK(count > 10000);
  CHECK(away < count / 50);
}

TEST_CASE("a_cage_of_lines_is_whole_and_fainter_where_the_model_stands_before_it") {
  Driver d(options_of(4), test::with_pixels);
  show(d, false);
  const std::string svg = app::svg_of(d.viewer(), 1.5f);
  const scene::Workspace& w = d.workspace();
  CHECK(w.view.cage);
  CHECK(svg.starts_with("<svg xmlns"));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(test::mentions(svg, "stroke-width:1.5"));
  std::istringstream lines(svg);
  double length[2] = {0, 0};
  std::size_t circles = 0;
  for (std::string line; std::getline(lines, line);) {
    double a = 0, b = 0, x = 0, y = 0;
    char name[8] = {};
    circles += line.starts_with("<circle");
    if (std::sscanf(line.c_str(), "<line class=\"%6[a-z]\" x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf\"/>",
                    name, &a, &b, &x, &y) == 5)
      length[std::strcmp(name, "hidden") == 0] += std::hypot(x - a, y - b);
  }
  const scene::Projector project(w.document.space, w.camera, w.viewport);
  double all = 0;
  for (const auto& [a, b] : w.document.cage->edges)
    all += glm::distance(glm::vec2(*project(w.document.pose.positions[a])),
                         glm::vec2(*project(w.document.pose.positions[b])));
  CHECK(circles == w.document.pose.positions.size());
  CHECK(length[0] + length[1] == doctest::Approx(all).epsilon(1e-3));
  CHECK(length[0] > 0.4 * all);
  CHECK(length[1] > 0.1 * all);
}

TEST_CASE("passes_are_written_as_they_say") {
  const test::TemporaryFolder folder;
  Driver d(options_of(0), test::with_pixels);
  show(d, false);
  CHECK(test::mentions(app::write_pass(d.viewer(), render::Pass::depth, folder / "d.pfm"),
                       "in the model's units"));
  const std::string pfm = test::file_bytes(folder / "d.pfm");
  const std::string head = "Pf\n640 400\n-1.0\n";
  REQUIRE(pfm.starts_with(head));
  REQUIRE(pfm.size() == head.size() + 4 * 640 * 400);
  const app::DepthPicture picture = app::depth_of(d.viewer());
  float last = 0;  // the upper right pixel comes last
  std::memcpy(&last, &pfm[pfm.size() - 4 * 320], 4);
  CHECK(last == picture.depths[320]);
  app::write_pass(d.viewer(), render::Pass::depth, folder / "d.png");
  CHECK(test::file_bytes(folder / "d.png").starts_with("\x89PNG"));
  CHECK_THROWS_AS(app::write_pass(d.viewer(), render::Pass::normals, folder / "none" / "n.png"), base::Error);
}
