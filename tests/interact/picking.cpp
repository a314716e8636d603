#include "interact/picking.h"

#include <doctest/doctest.h>

#include "document/elements.h"
#include "support/cube.h"

using namespace viete;
using namespace viete::document;
using namespace viete::interact;
using namespace viete::workspace;

namespace {

Workspace front_cube(ElementKind kind) {
  Workspace w = test::cube_workspace();
  w.document.changed_selection() = Selection(kind);
  w.view.camera.look(StandardView::front);
  w.view.camera.animate(1);
  return w;
}

std::optional<Pick> pick(const Workspace& w, const glm::vec2& cursor) {
  return pick_element(w.document, w.view.camera, cursor);
}

std::optional<std::uint32_t> pick_index(const Workspace& w, const glm::vec2& cursor) {
  const auto found = pick(w, cursor);
  return found ? std::optional(found->index) : std::nullopt;
}

glm::vec2 pixel(const Workspace& w, const mesh::Point& p) {
  return glm::vec2(*Projector(w.document.space(), w.view.camera)(p));
}

bool has(const Workspace& w, std::uint32_t index, const mesh::Edge& edge) {
  return w.document.cage()->edges[index] == edge;
}

}  // namespace

TEST_CASE("the_vertex_under_the_cursor_is_picked_within_eight_pixels_or_by_a_box") {
  const Workspace w = test::cube_workspace();
  for (std::uint32_t i = 0; i < 8; ++i) {
    const glm::vec2 at = pixel(w, w.document.pose().positions[i]);
    CHECK(pick_index(w, at) == i);
    CHECK(pick_index(w, at + glm::vec2(0, 7.5f)) == i);
    CHECK_FALSE(pick_index(w, at + glm::vec2(0, 8.5f)));
    CHECK(pick_elements_in_box(w.document, w.view.camera, at + 2.0f, at - 2.0f) ==
          std::vector<std::uint32_t>{i});
  }
}

TEST_CASE("the_nearer_of_two_vertices_on_one_pixel_is_picked") {
  Workspace w = test::cube_workspace();
  w.view.camera.look(StandardView::front);
  w.view.camera.animate(1);
  CameraPose pose = w.view.camera.pose();
  pose.distance = 900;
  w.view.camera.set_pose(pose);
  const mesh::Point back{0, 0, -1}, front{0, 0, 1};
  w.document.changed_pose().positions.assign(8, back);
  w.document.changed_pose().positions[5] = front;  // less than 2 pixels from the other vertices
  for (const auto& p : {back, front}) CHECK(pick_index(w, pixel(w, p)) == 5u);
}

TEST_CASE("points_behind_the_camera_are_never_picked") {
  Workspace w = test::cube_workspace();
  const double s = w.document.space().scale;
  auto& camera = w.view.camera;
  const auto along = [&](float distance) {
    const glm::vec3 p = camera.eye() + distance * camera.forward();
    return mesh::Point{p.x / s, p.y / s, p.z / s};
  };
  const glm::vec2 middle = pixel(w, along(3));
  for (auto& p : w.document.changed_pose().positions) p = along(3);
  CHECK(pick_index(w, middle));
  for (auto& p : w.document.changed_pose().positions) p = along(-3);
  const Projector project(w.document.space(), camera);
  CHECK_FALSE(project(along(-3)));
  CHECK_FALSE(pick_index(w, middle));
  CHECK(pick_elements_in_box(w.document, camera, {-1e6f, -1e6f}, {1e6f, 1e6f}).empty());
}

TEST_CASE("the_edge_under_the_cursor_is_picked_within_eight_pixels_and_the_front_one_first") {
  for (const bool orthographic : {false, true}) {
    Workspace w = front_cube(ElementKind::edge);
    w.view.camera.set_orthographic(orthographic);
    const glm::vec2 middle = pixel(w, {0.2, 1.5, 1.5});  // on the edge between vertices 6 and 7
    for (const float off : {0.0f, -7.5f}) {
      const auto found = pick(w, middle + glm::vec2(0, off));
      REQUIRE(found);
      CHECK(has(w, found->index, {6, 7}));
    }
    CHECK_FALSE(pick(w, middle + glm::vec2(0, -8.5f)));
    CHECK(pick(w, middle)->depth ==
          doctest::Approx(w.view.camera.depth(w.document.space().to_view({0, 1.5, 1.5}))));
  }
}

TEST_CASE("the_face_in_front_is_picked_inside_and_eight_pixels_around_the_cage") {
  for (const bool orthographic : {false, true}) {
    Workspace w = front_cube(ElementKind::face);
    w.view.camera.set_orthographic(orthographic);
    CHECK(pick(w, pixel(w, {0.9, -0.9, 1.5}))->index == 2);  // triangles 2 and 3 are at the front
    CHECK(pick(w, pixel(w, {0.9, 1.2, 1.5}))->index == 3);
    const glm::vec2 top = pixel(w, {0.2, 1.5, 1.5});
    CHECK(pick(w, top + glm::vec2(0, -7)));
    CHECK_FALSE(pick(w, top + glm::vec2(0, -9)));
  }
}

TEST_CASE("from_inside_the_cage_the_visible_parts_of_faces_and_edges_are_picked") {
  const auto inside = [](ElementKind kind, float distance) {
    Workspace w = front_cube(kind);
    CameraPose pose = w.view.camera.pose();
    pose.distance = distance;
    w.view.camera.set_pose(pose);
    return w;
  };
  const auto back = pick(inside(ElementKind::face, 0.1f), {630, 400});
  REQUIRE(back);
  CHECK(back->index < 2);
  const Workspace w = inside(ElementKind::edge, 0.5f);     // the front of the cage is behind the eye
  const auto found = pick(w, pixel(w, {1.5, 1.5, -1.0}));  // on the edge between vertices 3 and 7
  REQUIRE(found);
  CHECK(has(w, found->index, {3, 7}));
}

TEST_CASE("a_box_picks_edges_and_faces_that_lie_wholly_inside") {
  Workspace w = front_cube(ElementKind::edge);
  const glm::vec2 a = pixel(w, {-1.5, 1.5, 1.5}) - 3.0f, b = pixel(w, {1.5, 1.5, 1.5}) + glm::vec2(3, 100);
  const auto in_box = [&] { return pick_elements_in_box(w.document, w.view.camera, a, b); };
  bool front = false;
  for (const auto e : in_box()) front |= has(w, e, {6, 7});
  CHECK(front);
  w.document.changed_selection() = Selection(ElementKind::face);
  for (const auto f : in_box())
    for (const auto v : element_vertices(*w.document.cage(), ElementKind::face, f))
      CHECK(w.document.pose().positions[v][1] == 1.5);
  CHECK(pick_elements_in_box(w.document, w.view.camera, {0, 0}, {1000, 800}).size() == 12);
  CHECK(pick_elements_in_box({}, w.view.camera, {0, 0}, {1000, 800}).empty());
}
