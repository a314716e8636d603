#include "document/brush.h"

#include "support/commands.h"
#include "support/edits.h"
#include "support/files.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

struct Painted {
  test::CubeFiles files;
  Workspace w;

  Painted() { REQUIRE(test::load_model(w, files.model, files.cage)); }

  void paint(std::size_t vertex, double radius, float share) {
    MaskStroke stroke(w.document);
    stroke.dab(w.document, {}, w.document.model().surface->positions[vertex], radius, share);
    stroke.commit(w.document);
  }
};

}  // namespace

TEST_CASE("a_stroke_paints_once_however_often_it_goes_over_a_vertex_and_is_one_edit") {
  Painted p;
  Document& d = p.w.document;
  const auto& at = d.model().surface->positions;
  const double radius = 0.6 * d.model().bounds.diagonal();
  MaskStroke stroke(d);
  for (int n = 0; n < 5; ++n) stroke.dab(d, {}, at[0], radius, 0);
  REQUIRE(d.mask());
  CHECK((*d.mask())[0] == 0);
  std::size_t partly = 0;
  for (std::size_t v = 0; v < at.size(); ++v) {
    const double t = std::clamp(2 - 2 * mesh::norm(at[v] - at[0]) / radius, 0.0, 1.0);
    CHECK(std::abs(double((*d.mask())[v]) - (1 - t * t * (3 - 2 * t))) < 0.5 / mask_steps + 1e-6);
    partly += t > 0 && t < 1;
  }
  CHECK(partly > 0);
  CHECK(test::edit_count(d.history()) == 0);
  stroke.commit(d);
  CHECK(test::edit_count(d.history()) == 1);
  CHECK(d.history().undo_label() == "paint");
  const auto painted = d.mask();
  undo(d);
  CHECK_FALSE(d.mask());
  redo(d);
  CHECK(d.mask() == painted);
}

TEST_CASE("a_cancelled_or_empty_stroke_is_no_edit") {
  Painted p;
  Document& d = p.w.document;
  MaskStroke taken_back(d);
  taken_back.dab(d, {}, d.model().surface->positions[0], 1, 0);
  taken_back.cancel(d);
  CHECK_FALSE(d.mask());
  p.paint(0, 1e-9, 1);  // the value is already 1
  CHECK_FALSE(d.mask());
  CHECK(test::edit_count(d.history()) == 0);
  p.paint(0, 1e-9, 0);
  p.paint(0, 1e-9, 1);  // a mask of ones becomes null
  CHECK_FALSE(d.mask());
  CHECK(test::edit_count(d.history()) == 2);
}

TEST_CASE("masks_are_cleared_and_inverted_by_commands") {
  Painted p;
  Document& d = p.w.document;
  CHECK_FALSE(test::run_command(p.w, "mask_clear"));
  CHECK(test::run_command(p.w, "mask_invert"));
  for (const float share : *d.mask()) CHECK(share == 0);
  p.paint(0, 1e-9, 0.25f);
  const float painted = (*d.mask())[0];
  CHECK(painted == doctest::Approx(0.25).epsilon(0.01));
  CHECK(test::run_command(p.w, "mask_invert"));
  CHECK((*d.mask())[0] == doctest::Approx(1 - double(painted)));
  CHECK((*d.mask())[1] == 1);
  CHECK(test::run_command(p.w, "mask_clear"));
  CHECK_FALSE(d.mask());
  CHECK(test::edit_count(d.history()) == 4);
}

TEST_CASE("a_ray_meets_the_posed_model_where_it_is_nearest") {
  Painted p;
  const Document& d = p.w.document;
  const auto& box = d.model().bounds;
  const mesh::Point c = box.center();
  const auto view = [&](const mesh::Point& x) { return glm::dvec3(d.space().to_view(x)); };
  const Ray ray{view({c[0] + 0.01, c[1] + 0.02, box.high[2] + 10}), {0, 0, -1}};
  const auto hit = pick_model(d, {}, ray);
  REQUIRE(hit);
  CHECK((*hit)[2] == doctest::Approx(box.high[2]));
  CHECK((*hit)[0] == doctest::Approx(c[0] + 0.01));
  CHECK_FALSE(pick_model(d, {}, {ray.origin, {0, 0, 1}}));
  // Moves the model by 5 along x. The ray must move by 5 too.
  std::vector<pose::FrameVertex> posed;
  for (const auto& x : d.model().surface->positions)
    posed.push_back({{float(x[0] + 5), float(x[1]), float(x[2])}, {}});
  CHECK_FALSE(pick_model(d, {posed, {0, 0, 0}}, ray));
  const Ray aside{view({c[0] + 5, c[1] + 0.02, box.high[2] + 10}), {0, 0, -1}};
  CHECK(pick_model(d, {posed, {0, 0, 0}}, aside));
}

TEST_CASE("a_ray_meets_the_first_point_near_it_and_no_faint_splat") {
  mesh::Surface points;
  auto splats = std::make_shared<mesh::Splats>();
  for (int layer = 0; layer < 2; ++layer)
    for (int i = 0; i < 400; ++i) points.positions.push_back({i % 20 + 0.0, i / 20 + 0.0, 5.0 * layer});
  splats->resize(800);
  OpenedSurface opened = generated_surface(std::move(points), "points");
  const auto vertex = [&](const mesh::Point& from) {
    const Document d(opened);
    const auto hit = pick_corners(d, {}, {glm::dvec3(d.space().to_view(from)), {0, 0, -1}});
    return hit ? std::optional(hit->corners[0]) : std::nullopt;
  };
  CHECK(vertex({3.1, 7.2, 9}) == 400 + 7 * 20 + 3);
  CHECK(vertex({3.5, 7.4, 9}));  // without gaps
  CHECK(vertex({3.1, 7.2, 4}) == 7 * 20 + 3);
  CHECK_FALSE(vertex({3.1, 7.2, -1}));
  CHECK_FALSE(vertex({23, 7, 9}));
  opened.splats = splats;
  CHECK(vertex({3.1, 7.2, 9}) == 400 + 7 * 20 + 3);
  for (std::size_t i = 400; i < 800; ++i) splats->opacities[i] = -4;
  CHECK(vertex({3.1, 7.2, 9}) == 7 * 20 + 3);
}
