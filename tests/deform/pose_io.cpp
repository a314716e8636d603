#include "deform/pose_io.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "deform/shapes.h"
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "support/text.h"

using namespace viete::test;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / "viete-test-pose-io";
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path operator/(const char* name) const { return path / name; }
};

std::vector<std::string> texts;

Pose read(const fs::path& path, const Cage& cage, std::vector<std::string>& warnings = texts) {
  warnings.clear();
  return read_pose(path, cage, warnings);
}

}  // namespace

TEST_CASE("a_pose_is_read_back_with_every_bit_and_its_turns") {
  const Folder folder;
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

TEST_CASE("a_pose_in_stl_is_refused_unless_its_faces_are_the_cages") {
  const Folder folder;
  const Cage cage = make_cage(box());  // faces do not use the vertices in order
  auto posed = box();
  for (auto& p : posed.positions) p[1] *= 2;
  viete::mesh::write(folder / "pose.stl", posed);
  try {
    read(folder / "pose.stl", cage);
    FAIL("accepted");
  } catch (const viete::base::Error& error) {
    CHECK(mentions(error.what(), "pose.stl: STL files do not preserve the vertex order"));
    CHECK(mentions(error.what(), "export the pose as OBJ, PLY or OFF"));
  }
  CHECK_THROWS_AS(write_pose(folder / "own.stl", cage, rest_pose(cage)), viete::base::Error);
  CHECK_FALSE(fs::exists(folder / "own.stl"));

  viete::mesh::write(folder / "cage.stl", box());
  const Cage of_stl = make_cage(viete::mesh::read(folder / "cage.stl").surface);
  const Pose pose = read(folder / "pose.stl", of_stl);
  for (std::size_t v = 0; v < pose.positions.size(); ++v) {
    const auto& rest = of_stl.surface.positions[v];
    CHECK(pose.positions[v] == Vec3{rest[0], 2 * rest[1], rest[2]});
  }
}

TEST_CASE("a_pose_without_turns_has_none_after_reading") {
  const Folder folder;
  const Cage cage = make_cage(box());
  write_pose(folder / "pose.obj", cage, {cage.surface.positions, {{0, 0, 0}}});
  CHECK(read(folder / "pose.obj", cage).turns.empty());
}

TEST_CASE("turns_are_in_a_comment_line_at_the_head") {
  const Folder folder;
  const Cage cage = make_cage(box());
  write_pose(folder / "pose.obj", cage, {cage.surface.positions, {{1, 0.5, -2}}});
  std::ifstream in(folder / "pose.obj");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  CHECK(mentions(text, "# viete turns: part 0: 1 0.5 -2\n"));
}

TEST_CASE("another_number_of_vertices_is_refused_with_both_counts_and_the_file") {
  const Folder folder;
  viete::mesh::write(folder / "pose.obj", tube(4, 5, 1, 1));
  try {
    read(folder / "pose.obj", make_cage(box()));
    FAIL("accepted");
  } catch (const viete::base::Error& error) {
    CHECK(mentions(error.what(), "pose.obj"));
    CHECK(mentions(error.what(), "22 vertices"));
    CHECK(mentions(error.what(), "8"));
  }
  CHECK_THROWS_AS(read(folder / "missing.obj", make_cage(box())), viete::base::Error);
}

TEST_CASE("other_faces_collapsed_elements_and_odd_turns_warn") {
  const Folder folder;
  const Cage cage = make_cage(box());
  std::vector<std::string> warnings;

  auto t = box().triangles;
  std::swap(t[0], t[1]);
  viete::mesh::write(folder / "faces.obj", viete::mesh::from_triangles(box().positions, t));
  read(folder / "faces.obj", cage, warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(mentions(warnings[0], "faces differ"));

  auto collapsed = box();
  collapsed.positions.assign(8, {1, 1, 1});
  viete::mesh::write(folder / "collapsed.obj", collapsed);
  const Pose pose = read(folder / "collapsed.obj", cage, warnings);
  CHECK(pose.positions == collapsed.positions);
  CHECK(std::any_of(warnings.begin(), warnings.end(),
                    [](const auto& w) { return mentions(w, "12 of 12 cage triangles"); }));

  for (const char* line : {"viete turns: part 7: 1 2 3", "viete turns: part 0: 1 2",
                           "viete turns: part 0: 1 2 nan", "viete turns: x"}) {
    viete::mesh::write(folder / "turns.obj", box(), {line});
    CHECK(read(folder / "turns.obj", cage, warnings).turns.empty());
    REQUIRE(warnings.size() == 1);
    CHECK(mentions(warnings[0], "turns"));
  }
}

TEST_CASE("numbers_that_are_not_finite_never_pass") {
  const Folder folder;
  std::ofstream(folder / "nan.obj") << "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Cage cage = make_cage(viete::mesh::from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  CHECK_THROWS_AS(read(folder / "nan.obj", cage), viete::base::Error);
}
