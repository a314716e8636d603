#include "scene/document/pose_notes.h"

#include <doctest/doctest.h>

#include <memory>

#include "deform/cage_state.h"
#include "scene/cube.h"

using namespace viete;
using namespace viete::scene;

namespace {

// Two cubes that do not touch, or one.
deform::Cage cage_of(int cubes) {
  mesh::Surface surface = test::cube(1);
  const auto positions = surface.positions;
  const auto triangles = surface.triangles;
  for (int i = 1; i < cubes; ++i) {
    for (auto p : positions) surface.positions.push_back({p[0] + 5 * i, p[1], p[2]});
    for (auto t : triangles) {
      for (auto& v : t) v += static_cast<std::uint32_t>(8 * i);
      surface.triangles.push_back(t);
    }
  }
  return deform::make_cage(mesh::from_triangles(surface.positions, surface.triangles));
}

// Said of the cage with its first vertices mapped.
std::vector<std::string> notes(deform::Cage cage, std::size_t mapped, auto map) {
  deform::Pose pose = deform::rest_pose(cage);
  for (std::size_t v = 0; v < mapped; ++v) map(pose.positions[v]);
  deform::CageState state(std::make_shared<const deform::Cage>(std::move(cage)), deform::Elements::face,
                          deform::Blend::srl);
  state.set_pose(pose);
  return pose_notes(state.report(), state.cage(), pose);
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a_mirrored_cage_is_told_as_such") {
  for (int axis = 0; axis < 3; ++axis) {
    const auto said = notes(cage_of(1), 8, [&](mesh::Point& p) { p[axis] = -2 * p[axis]; });
    REQUIRE(said.size() == 1);
    CHECK_MESSAGE(holds(said[0], "The cage is turned inside out in this pose, as by a mirror"), said[0]);
  }
  const auto through_a_point = notes(cage_of(1), 8, [](mesh::Point& p) { p = {-p[0], -p[1], -p[2]}; });
  REQUIRE(through_a_point.size() == 1);
  CHECK(holds(through_a_point[0], "inside out"));
}

TEST_CASE("a_cage_that_is_turned_stretched_or_bent_is_no_mirror_image") {
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; }).empty());
  CHECK(notes(cage_of(1), 8, [](mesh::Point& p) { p[0] *= 30; }).empty());
  const auto torn = notes(cage_of(1), 4, [](mesh::Point& p) { p = {-p[0], -p[1], p[2]}; });
  for (const auto& note : torn) CHECK_FALSE(holds(note, "mirror"));
}

TEST_CASE("of_several_parts_those_that_are_mirrored_are_counted") {
  const auto said = notes(cage_of(2), 8, [](mesh::Point& p) { p[1] = -p[1]; });
  REQUIRE_FALSE(said.empty());
  CHECK_MESSAGE(holds(said[0], "1 of 2 parts of the cage is turned inside out"), said[0]);
}
