// Scenes as bytes, and hostile bytes.
#include "foreign/scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "foreign/full_scene.h"

using namespace viete;
using foreign::DamagedScene;
using foreign::Scene;
using foreign::scene_of;

namespace {

// Reads changed bytes. The result must be an error or a scene with valid indices.
void read_changed(const std::string& bytes) {
  try {
    const Scene scene = scene_of(bytes);
    if (!scene.failure.empty()) return;
    for (const std::uint32_t v : scene.corners) REQUIRE(v < scene.positions.size());
    for (const mesh::Point& p : scene.positions) REQUIRE(std::isfinite(p[0] + p[1] + p[2]));
    REQUIRE(scene.polygon_starts.back() == scene.corners.size());
    for (const formats::Group& g : scene.attributes.groups)
      REQUIRE((g.material == mesh::none || g.material < scene.attributes.materials.size()));
  } catch (const DamagedScene&) {
  }
}

}  // namespace

TEST_CASE("a_scene_is_the_same_after_it_was_bytes") {
  const std::string bytes = bytes_of(test::full_scene());
  const Scene read = scene_of(bytes), scene = test::full_scene();
  CHECK(bytes_of(read) == bytes);
  CHECK(read.positions == scene.positions);
  CHECK(read.attributes.corner_texture == scene.attributes.corner_texture);
  CHECK(read.attributes.groups[0].name == "side");
  CHECK_FALSE(read.attributes.groups[1].smooth);
  CHECK(read.attributes.images[0].path == "/folder/a.png");
  CHECK_FALSE(read.attributes.images[0].bytes);
  CHECK(*read.attributes.images[1].bytes == "\x89PNG");
  CHECK(read.targets[0].positions == scene.targets[0].positions);
  CHECK(read.notes == scene.notes);
}

TEST_CASE("scenes_that_end_early_or_late_are_refused") {
  const std::string bytes = bytes_of(test::full_scene());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CAPTURE(size);
    REQUIRE_THROWS_AS(scene_of(bytes.substr(0, size)), DamagedScene);
  }
  CHECK_THROWS_AS(scene_of(bytes + '\0'), DamagedScene);
  CHECK_THROWS_AS(scene_of(bytes + bytes), DamagedScene);
}

TEST_CASE("huge_counts_and_changed_bytes_neither_crash_nor_take_memory") {
  const std::string bytes = bytes_of(test::full_scene());
  for (std::size_t i = 0; i + 8 <= bytes.size(); ++i)
    for (const std::uint64_t count : {~0ULL, 1ULL << 63, 1ULL << 61, 1ULL << 32, 0ULL}) {
      std::string changed = bytes;
      changed.replace(i, 8, reinterpret_cast<const char*>(&count), 8);
      read_changed(changed);
    }
  std::mt19937 random(1);
  for (int round = 0; round < 20'000; ++round) {
    std::string changed = bytes;
    for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<char>(random());
    read_changed(changed);
  }
}

TEST_CASE("invalid_content_of_a_scene_is_refused") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::pair<const char*, void (*)(Scene&)> changes[] = {
      {"corners", [](Scene& s) { s.corners[0] = 5; }},
      {"polygons",
       [](Scene& s) {
         s.polygon_starts = {0, 2, 7};
       }},
      {"polygons",
       [](Scene& s) {
         s.polygon_starts = {0, 9, 7};
       }},
      {"polygons",
       [](Scene& s) {
         s.polygon_starts = {0, 4};
       }},
      {"polygons", [](Scene& s) { s.polygon_starts = {}; }},
      {"positions", [](Scene& s) { s.positions[2][1] = infinity; }},
      {"positions", [](Scene& s) { s.positions[2][1] = 1e101; }},
      {"positions", [](Scene& s) { s.targets[0].positions[0][0] = -infinity; }},
      {"morph targets", [](Scene& s) { s.targets[0].positions.pop_back(); }},
      {"texture points", [](Scene& s) { s.attributes.corner_texture[0] = 3; }},
      {"texture points", [](Scene& s) { s.attributes.texture_points.clear(); }},
      {"texture points", [](Scene& s) { s.attributes.texture_points[0][1] = infinity; }},
      {"normals", [](Scene& s) { s.attributes.corner_normal.pop_back(); }},
      {"colours", [](Scene& s) { s.attributes.colors.pop_back(); }},
      {"colours", [](Scene& s) { s.attributes.colors[1][0] = 2; }},
      {"colours", [](Scene& s) { s.attributes.materials[1].base_color[0] = NAN; }},
      {"images", [](Scene& s) { s.attributes.materials[0].base_color_image = 2; }},
      {"materials", [](Scene& s) { s.attributes.groups[0].material = 2; }},
      {"groups", [](Scene& s) { s.attributes.groups[0].first_polygon = 1; }},
      {"groups", [](Scene& s) { s.attributes.groups[1].first_polygon = 2; }},
  };
  for (const auto& [what, change] : changes) {
    Scene scene = test::full_scene();
    change(scene);
    CHECK_THROWS_WITH_AS(scene_of(bytes_of(scene)), doctest::Contains(what), DamagedScene);
    scene.failure = "the file is not a model";  // then the content is not used
    CHECK(scene_of(bytes_of(scene)).failure == scene.failure);
  }
}
