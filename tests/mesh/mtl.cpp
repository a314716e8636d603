#include "mesh/formats/mtl.h"

#include <doctest/doctest.h>

#include "mesh/shapes.h"

using namespace viete;
using namespace viete::mesh;
using viete::test::holds;

namespace {

std::vector<MtlMaterial> materials_of(const std::string& text) {
  return read_mtl(Source{"given.mtl", "mtl", text, nullptr, nullptr, "/models"});
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";

}  // namespace

TEST_CASE("mtl_colours_opacity_and_images_are_read") {
  const auto all = materials_of(
      "# made up\r\nKd 1 1 1\r\nnewmtl red one\r\nKa 1 1 1\r\nKd 1 0.5 0\r\nd 0.25\r\nmap_Kd red.png\r\n"
      "newmtl grey\nKd 0.5\nTr 0.25\nmap_Kd -s 2 2 -o 0.5 -blendu off -clamp on -bm 1 sub\\my picture.jpg\n"
      "newmtl odd\nKd red green\nd x\nmap_Kd\nKd 2 -1 0.5\nnewmtl\n");
  REQUIRE(all.size() == 4);
  CHECK(all[0].material.name == "red one");
  CHECK(all[0].material.base_color == Color{1, 0.5F, 0, 0.25F});
  CHECK(all[0].image == "/models/red.png");
  CHECK(all[0].material.repeats);
  CHECK(all[1].material.base_color == Color{0.5F, 0.5F, 0.5F, 0.75F});
  CHECK(all[1].image == "/models/sub/my picture.jpg");
  CHECK(!all[1].material.repeats);
  CHECK(all[2].material.base_color == Color{1, 0, 0.5F, 1});
  CHECK(all[2].image.empty());
}

TEST_CASE("a_library_that_is_missing_or_a_folder_is_a_warning") {
  const test::TemporaryFolder folder;
  for (const char* name : {"none.mtl", ".", "/", "a b c.mtl"}) {
    const ReadResult read =
        test::read_kept("mtllib " + std::string(name) + "\n" + triangle, "obj", folder.path());
    REQUIRE(!read.warnings.empty());
    CHECK(holds(read.warnings[0], "material library"));
    CHECK(read.attributes->materials[0].name == "red");
  }
}

TEST_CASE("libraries_are_found_by_names_with_blanks_and_by_several_names") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "my colours.mtl", "newmtl red\nKd 1 0 0\n");
  test::put_file(folder / "two.mtl", "newmtl red\nKd 0 1 0\n");
  const auto color = [&](const std::string& names) {
    const ReadResult read = test::read_kept("mtllib " + names + "\n" + triangle, "obj", folder.path());
    CHECK(read.warnings.empty());
    return read.attributes->materials[0].base_color;
  };
  CHECK(color("my colours.mtl") == Color{1, 0, 0, 1});
  CHECK(color("two.mtl two.mtl") == Color{0, 1, 0, 1});
  const ReadResult other = test::read_kept(
      "mtllib two.mtl\nusemtl green\n" + triangle + "usemtl green\nf 1 2 3\n", "obj", folder.path());
  REQUIRE(other.warnings.size() == 1);
  CHECK(holds(other.warnings[0], "1 material not found"));
}
