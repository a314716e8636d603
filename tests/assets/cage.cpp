// The bundled cage and its poses.
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/read.h"
#include "mesh/defects.h"
#include "mesh/summary.h"
#include "mesh/triangle_tree.h"
#include "support/data.h"

using namespace viete;

namespace {

formats::ReadResult bundled(const std::string& name) {
  return formats::read(test::assets_dir() / "dragon" / name);
}

std::vector<mesh::Point> places_of(const nlohmann::json& key) {
  const auto arrays = key["positions"].get<std::vector<std::array<double, 3>>>();
  return {arrays.begin(), arrays.end()};
}

}  // namespace

TEST_CASE("cage_is_closed_oriented_outwards_and_has_60_to_150_triangles") {
  const mesh::Summary summary = mesh::summarize(bundled("cage.obj").surface);
  CHECK(summary.triangles >= 60);
  CHECK(summary.triangles <= 150);
  CHECK(summary.parts == 1);
  CHECK(summary.closed());
  CHECK(summary.manifold());
  CHECK(summary.oriented());
  CHECK(summary.volume > 0);
  CHECK(2 * summary.vertices == summary.triangles + 4);
}

TEST_CASE("cage_encloses_every_vertex_of_the_dragon_with_1_5_percent_of_the_diagonal_to_spare") {
  const mesh::Surface cage = bundled("cage.obj").surface;
  const mesh::Surface dragon = bundled("dragon.ply").surface;
  const double spare = 0.015 * mesh::bounds(dragon.positions).diagonal();
  CHECK(mesh::self_intersecting_triangles(cage).empty());
  CHECK(mesh::points_outside(cage, dragon.positions).empty());
  const mesh::TriangleTree tree(cage.positions, cage.triangles);
  const auto is_close = [&](const mesh::Point& p) {
    return tree.nearest(p, spare * spare).squared_distance < spare * spare;
  };
  CHECK(std::ranges::none_of(dragon.positions, is_close));
}

TEST_CASE("the_loop_begins_and_ends_alert_and_takes_five_seconds") {
  const mesh::Surface cage = bundled("cage.obj").surface;
  std::ifstream in(test::assets_dir() / "dragon" / "loop.viete");
  const auto session = nlohmann::json::parse(in);
  const auto& keys = session["time"]["keys"];
  REQUIRE(keys.size() > 4);
  CHECK(session["time"]["repeat"] == "loop");
  CHECK(keys.front()["frame"] == session["time"]["first"]);
  CHECK(keys.back()["frame"] == session["time"]["last"]);
  CHECK(keys.front()["positions"] == keys.back()["positions"]);
  const std::vector<mesh::Point> alert = bundled("pose_alert.obj").surface.positions;
  CHECK(places_of(keys.front()) == alert);
  const int frames = session["time"]["last"].get<int>() - session["time"]["first"].get<int>();
  CHECK(frames / session["time"]["rate"].get<double>() >= 4);
  CHECK(frames / session["time"]["rate"].get<double>() <= 6);
  for (const auto& key : keys) {
    mesh::Surface posed = cage;
    posed.positions = places_of(key);
    CHECK(posed.positions.size() == cage.positions.size());
    CHECK(mesh::summarize(posed).volume > 0);
  }
}

TEST_CASE("poses_have_the_cage_s_vertices_and_faces_and_move_it") {
  const mesh::Surface cage = bundled("cage.obj").surface;
  for (const char* name : {"pose_alert.obj", "pose_flight.obj", "pose_coil.obj"}) {
    CAPTURE(name);
    const formats::ReadResult pose = bundled(name);
    CHECK(pose.surface.positions.size() == cage.positions.size());
    CHECK(pose.surface.triangles == cage.triangles);
    CHECK(pose.surface.positions != cage.positions);
    REQUIRE_FALSE(pose.comments.empty());
    CHECK(pose.comments[0].find("cage posed") != std::string::npos);
    CHECK(mesh::summarize(pose.surface).volume > 0);
  }
}
