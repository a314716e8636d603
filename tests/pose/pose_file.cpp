#include "pose/pose_file.h"

#include "formats/read.h"
#include "formats/write.h"
#include "support/caged_shapes.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> texts;

Pose read(const fs::path& path, const Cage& cage, std::vector<std::string>& warnings = texts) {
  warnings.clear();
  return read_pose(path, cage, warnings);
}

}  // namespace

TEST_CASE("a_pose_is_read_back_with_every_bit_and_its_turns") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(together(box(), box({1, 1, 1}, {5, 0, 0})));
  Pose pose{mapped(cage.surface.positions, similarity({1, 2, 3}, 2, 1.0 / 3)),
            {{0.1, 1.0 / 3, -1e-17}, {4 * std::acos(-1), 0, 0}}};
  for (const char* name : {"pose.obj", "pose.ply"}) {
    write_pose(folder / name, cage, pose);
    std::vector<std::string> warnings;
    const Pose back = read(folder / name, cage, warnings);
    CHECK(back.positions == pose.positions);
    CHECK(back.turns == pose.turns);
    CHECK(warnings.empty());
  }
}

TEST_CASE("a_pose_in_stl_is_matched_by_its_faces_and_not_written") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(box());  // its faces do not use the vertices in order
  auto posed = box();
  for (auto& p : posed.positions) p[1] *= 2;
  viete::formats::write(folder / "pose.stl", posed);
  std::vector<std::string> warnings;
  CHECK(read(folder / "pose.stl", cage, warnings).positions == posed.positions);
  REQUIRE(warnings.size() == 1);
  CHECK(mentions(warnings[0], "pose.stl: the vertex order differs"));
  std::swap(posed.triangles[0], posed.triangles[1]);
  viete::formats::write(folder / "other.stl", viete::mesh::from_triangles(posed.positions, posed.triangles));
  CHECK_THROWS_WITH_AS(read(folder / "other.stl", cage), doctest::Contains("as OBJ, PLY or OFF"),
                       viete::base::Error);
  CHECK_THROWS_AS(write_pose(folder / "own.stl", cage, rest_pose(cage)), viete::base::Error);
  CHECK_FALSE(fs::exists(folder / "own.stl"));
}

TEST_CASE("a_renumbered_pose_is_matched_by_its_faces_or_refused") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(box());
  const std::vector<std::uint32_t> number{3, 6, 0, 5, 1, 7, 2, 4};
  std::vector<Vec3> positions(8);
  for (std::size_t v = 0; v < 8; ++v) positions[number[v]] = 2.0 * box().positions[v];
  auto triangles = box().triangles;
  for (auto& t : triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
  viete::formats::write(folder / "pose.obj", viete::mesh::from_triangles(positions, triangles));
  const Pose pose = read(folder / "pose.obj", cage);
  for (std::size_t v = 0; v < 8; ++v) CHECK(pose.positions[v] == 2.0 * box().positions[v]);
  std::ranges::reverse(triangles);
  viete::formats::write(folder / "pose.obj", viete::mesh::from_triangles(positions, triangles));
  CHECK_THROWS_WITH_AS(read(folder / "pose.obj", cage), doctest::Contains("has the vertices"),
                       viete::base::Error);
  put_file(folder / "points.obj", "v 1 1 1\nv 2 1 1\nv 3 1 1\nv 4 1 1\nv 5 1 1\nv 6 1 1\nv 7 1 1\nv 8 1 1\n");
  CHECK(read(folder / "points.obj", cage).positions[4] == Vec3{5, 1, 1});
}

TEST_CASE("turns_are_in_a_comment_line_at_the_head_unless_they_are_0") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(box());
  write_pose(folder / "none.obj", cage, {cage.surface.positions, {{0, 0, 0}}});
  CHECK(read(folder / "none.obj", cage).turns.empty());
  write_pose(folder / "pose.obj", cage, {cage.surface.positions, {{1, 0.5, -2}}});
  CHECK(mentions(file_bytes(folder / "pose.obj"), "# viete turns: part 0: 1 0.5 -2\n"));
}

TEST_CASE("other_numbers_of_vertices_missing_files_and_numbers_that_are_not_finite_are_refused") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(box());
  viete::formats::write(folder / "pose.obj", tube(4, 5, 1, 1));
  for (const char* text : {"pose.obj", "22 vertices", "8"})
    CHECK_THROWS_WITH_AS(read(folder / "pose.obj", cage), doctest::Contains(text), viete::base::Error);
  CHECK_THROWS_AS(read(folder / "missing.obj", cage), viete::base::Error);
  put_file(folder / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Cage one = make_cage(viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  CHECK_THROWS_AS(read(folder / "nan.obj", one), viete::base::Error);
}

TEST_CASE("other_faces_collapsed_elements_and_odd_turns_warn") {
  const TemporaryFolder folder;
  const Cage cage = make_cage(box());
  std::vector<std::string> warnings;

  auto t = box().triangles;
  std::swap(t[0], t[1]);
  viete::formats::write(folder / "faces.obj", viete::mesh::from_triangles(box().positions, t));
  read(folder / "faces.obj", cage, warnings);
  CHECK(warnings.empty());
  t.pop_back();
  viete::formats::write(folder / "faces.obj", viete::mesh::from_triangles(box().positions, t));
  read(folder / "faces.obj", cage, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(mentions(warnings[0], "differ from the faces of the cage"));

  auto collapsed = box();
  collapsed.positions.assign(8, {1, 1, 1});
  viete::formats::write(folder / "collapsed.obj", collapsed);
  const Pose pose = read(folder / "collapsed.obj", cage, warnings);
  CHECK(pose.positions == collapsed.positions);
  CHECK(std::any_of(warnings.begin(), warnings.end(),
                    [](const auto& w) { return mentions(w, "12 of 12 cage faces"); }));

  for (const char* line : {"viete turns: part 7: 1 2 3", "viete turns: part 0: 1 2",
                           "viete turns: part 0: 1 2 nan", "viete turns: x"}) {
    viete::formats::write(folder / "turns.obj", box(), {line});
    CHECK(read(folder / "turns.obj", cage, warnings).turns.empty());
    REQUIRE(warnings.size() == 1);
    CHECK(mentions(warnings[0], "turns"));
  }
}
