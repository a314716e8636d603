#include "formats/write.h"

#include "support/gltf.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::formats;
using namespace viete::mesh;
using viete::test::mentions;

namespace {

// Returns a cube of quads, a pentagon and an unused vertex. All digits of the coordinates are significant.
Surface awkward(double scale) {
  Surface s = test::cube();
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  s.positions.push_back({1.0 / 3, -0.0, 5e-324});
  for (Point& p : s.positions)
    for (double& x : p) x = x * scale + uniform(random) * scale;
  s.corners.insert(s.corners.end(), {0, 1, 2, 3, 4});
  s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
  triangulate(s);
  return s;
}

}  // namespace

TEST_CASE("polygons_and_positions_come_back_with_the_same_bits") {
  const test::TemporaryFolder folder;
  for (const double scale : {1e-300, 1e-30, 1.0, 1e30, 1e99}) {
    const Surface s = awkward(scale);
    for (const char* name : {"a.obj", "a.ply", "a.off", "A.PLY"}) {
      write(folder / name, s, {"first", "second"});
      const ReadResult r = read(folder / name);
      CHECK(r.surface.positions == s.positions);
      CHECK(r.surface.corners == s.corners);
      CHECK(r.surface.polygon_starts == s.polygon_starts);
      CHECK(r.surface.triangles == s.triangles);
      CHECK(r.comments == std::vector<std::string>{"first", "second"});
      CHECK(r.warnings.empty());
    }
  }
}

TEST_CASE("stl_keeps_every_triangle_exactly") {
  const test::TemporaryFolder folder;
  const Surface s = awkward(1);
  write(folder / "a.stl", s, {"a name"});
  const ReadResult r = read(folder / "a.stl");
  REQUIRE(r.surface.triangles.size() == s.triangles.size());
  CHECK(r.comments == std::vector<std::string>{"a name"});
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      CHECK(r.surface.positions[r.surface.triangles[t][i]] == s.positions[s.triangles[t][i]]);
}

TEST_CASE("control_characters_in_comments_cannot_break_a_file") {
  const test::TemporaryFolder folder;
  const Surface s = test::cube();
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    write(folder / name, s, {"line\nv 1 2 3\r\nend_header \\", "", "solid \x01"});
    const ReadResult r = read(folder / name);
    CHECK(r.surface.triangles.size() == 12);
    CHECK(r.surface.positions.size() == 8);
    CHECK(r.comments.at(0) == "line v 1 2 3  end_header");
  }
}

TEST_CASE("empty_surfaces_are_not_written") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.glb", "a.gltf"}) {
    CHECK_THROWS_WITH_AS(write(folder / name, Surface{}), doctest::Contains("there are no vertices to write"),
                         base::Error);
    CHECK_FALSE(std::filesystem::exists(folder / name));
  }
}

TEST_CASE("a_large_file_is_written_in_portions_and_can_be_stopped_between_them") {
  const Surface s = test::sphere(7);
  for (const char* extension : {"obj", "ply", "off", "stl"}) {
    const std::string whole = test::bytes_by(extension, s);
    base::Progress progress;
    std::string all;
    double before = -1;
    TextWriter out(
        [&](std::string_view portion) {
          CHECK(portion.size() < 300'000);
          CHECK(progress.done() > before);
          before = progress.done();
          all += portion;
        },
        &progress);
    format_by_extension(extension)->write({s, s.positions, {}}, out);
    out.finish();
    CHECK(all == whole);
    CHECK(progress.done() > 0.5);
    CHECK(progress.done() <= 1);
  }
  const test::TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    write(folder / name, test::cube());
    const std::string before = test::file_bytes(folder / name);
    base::Progress stopped;
    stopped.cancel();
    CHECK_THROWS_AS(write(folder / name, {s, s.positions, {}}, nullptr, {}, &stopped), base::Cancelled);
    CHECK(test::file_bytes(folder / name) == before);
  }
  CHECK(folder.entries() == 4);
}

TEST_CASE("points_are_not_written_as_stl_and_losses_are_reported") {
  const test::TemporaryFolder folder;
  Surface points;
  points.positions = {{1, 2, 3}, {4, 5, 6}};
  CHECK_THROWS_WITH_AS(write(folder / "a.stl", points), doctest::Contains("STL stores only triangles"),
                       base::Error);
  CHECK(folder.entries() == 0);
  Surface some = test::sphere(0);
  some.positions.insert(some.positions.end(), points.positions.begin(), points.positions.end());
  const Content content{some, some.positions, {}};
  for (const char* name : {"a.stl", "a.glb", "a.gltf"})
    CHECK(write(folder / name, content, nullptr, {}) ==
          std::vector<std::string>{"2 points without a face were left out"});
  for (const char* name : {"a.obj", "a.ply", "a.off"})
    CHECK(write(folder / name, content, nullptr, {}).empty());
}

TEST_CASE("invalid_positions_are_not_written_in_any_format") {
  const test::TemporaryFolder folder;
  const Surface s = test::sphere(1);
  for (const double bad : std::initializer_list<double>{NAN, INFINITY, -INFINITY, 1e103, -1.01e100}) {
    std::vector<Point> positions = s.positions;
    positions[7][2] = bad;
    positions[9][0] = bad;
    for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl", "a.glb", "a.gltf"}) {
      CHECK_THROWS_WITH_AS(write(folder / name, {s, positions, {}}, nullptr, {}),
                           doctest::Contains("the position of vertex 7 is invalid"), base::Error);
      CHECK(folder.entries() == 0);
    }
    for (const std::string extension : {"obj", "ply", "off", "stl"}) {
      const ReadResult kept = test::read_kept(test::bytes_by(extension, s), extension);
      positions = kept.surface.positions;
      positions[3][1] = bad;
      CHECK_THROWS_WITH_AS(
          write(folder / ("a." + extension), {kept.surface, positions, {}}, kept.original.get(), {}),
          doctest::Contains("the position of vertex 3 is invalid"), base::Error);
      CHECK(folder.entries() == 0);
    }
  }
  std::vector<Point> largest = s.positions;
  largest[7] = {1e100, -1e100, 0};
  for (const char* name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    write(folder / name, {s, largest, {}}, nullptr, {});
    CHECK(read(folder / name).surface.positions.size() == s.positions.size());
  }
}

TEST_CASE("captures_without_complete_splats_are_named_and_only_written_unmoved") {
  const std::string floats = "property float ", head = "ply\nformat ascii 1.0\nelement vertex 3\n" + floats +
                                                       "x\n" + floats + "y\n" + floats + "z\n";
  const std::string capture = head + floats + "opacity\n" + floats + "scale_0\n" + floats +
                              "rot_0\nend_header\n0 0 0 1 -4 1\n1 0 0 1 -4 1\n0 1 0 1 -4 1\n";
  test::GltfParts gltf = test::patch();
  auto& primitive = gltf.primitive();
  primitive["mode"] = 0;
  primitive["extensions"]["KHR_gaussian_splatting"] = {{"kernel", "ellipse"}};
  for (const auto& [bytes, extension] : {std::pair(capture, "ply"), {gltf.glb(), "glb"}}) {
    const test::TemporaryFolder folder;
    const ReadResult r = test::read_kept(bytes, extension);
    REQUIRE(r.original->capture() == Capture::points);
    CHECK(std::ranges::any_of(r.warnings,
                              [](const auto& w) { return mentions(w, "a capture (Gaussian splats)"); }));
    const auto same = folder / ("same." + std::string(extension));
    write(same, {r.surface, r.surface.positions, {}}, r.original.get(), {});
    CHECK(test::file_bytes(same) == bytes);
    const std::vector<Point> posed = test::moved(r.surface, 2).positions;
    for (const char* name : {"a.ply", "a.obj", "a.glb"}) {
      CHECK_THROWS_WITH_AS(write(folder / name, {r.surface, posed, {}}, r.original.get(), {}),
                           doctest::Contains("is a capture (Gaussian splats)"), base::Error);
      CHECK_FALSE(std::filesystem::exists(folder / name));
    }
  }
  const ReadResult points = test::read_kept(head + "end_header\n0 0 0\n1 0 0\n0 1 0\n", "ply");
  CHECK(points.original->capture() == Capture::none);
}
