// Small files, read by viete-import.
#include "base/error.h"
#include "foreign/read.h"
#include "support/data.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;
using formats::Color;
using mesh::Point;
using test::mentions;
namespace fs = std::filesystem;

namespace {

// A folder with house.dae and smile.fbx, and the real viete-import.
struct Models : test::TemporaryFolder {
  Models() {
    for (const char* name : {"house.dae", "smile.fbx"})
      fs::copy_file(test::source_dir() / "tests/foreign" / name, *this / name);
    test::set_environment("VIETE_IMPORT", (test::build_dir() / "viete-import").string());
  }
  ~Models() { unsetenv("VIETE_IMPORT"); }

  formats::ReadResult changed(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = test::file_bytes(*this / name);
    text.replace(text.find(from), from.size(), to);
    test::put_file(*this / name, text);
    return foreign::read(*this / name);
  }
};

}  // namespace

TEST_CASE("meshes_of_all_nodes_are_placed_and_joined_at_equal_positions") {
  const Models models;
  const formats::ReadResult read = foreign::read(models / "house.dae");
  const mesh::Surface& s = read.surface;
  CHECK(read.format == "Collada");
  CHECK(s.polygon_starts == std::vector<std::uint32_t>{0, 4, 7, 11, 14});
  CHECK(s.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 3, 2, 4, 8, 7, 6, 5, 9, 7, 8});
  REQUIRE(s.positions.size() == 10);  // units of half a metre; z becomes y
  CHECK(s.positions[4] == Point{0.25, 5, -1});
  CHECK(s.positions[9] == Point{-0.25, 0, -1});
  CHECK(std::abs(mesh::bounds(s.positions).high[1]) == 5);
}

TEST_CASE("groups_materials_texture_points_normals_and_colours_are_read") {
  const Models models;
  test::put_file(models / "wood.png", "an image");
  const formats::ReadResult read = foreign::read(models / "house.dae");
  const formats::Attributes& a = *read.attributes;
  REQUIRE(a.groups.size() == 4);
  CHECK(a.groups[1].first_polygon == 1);
  CHECK(a.groups[1].object == "First");
  CHECK(a.groups[2].object == "Mirror");
  REQUIRE(a.materials.size() == 2);
  CHECK(a.materials[a.groups[2].material].name == "Wood");
  CHECK(a.materials[0].base_color == Color{1, 1, 1, 1});
  CHECK(a.materials[1].base_color == Color{1, 0.5F, 0.25F, 1});
  CHECK(a.materials[1].base_color_image == mesh::none);
  REQUIRE(a.images.size() == 1);
  CHECK(fs::equivalent(a.images[a.materials[0].base_color_image].path, models / "wood.png"));
  CHECK(a.texture_points[a.corner_texture[2]] == formats::Vec2{1, 1});
  CHECK(a.texture_points[a.corner_texture[6]] == formats::Vec2{1, 1});
  for (const std::uint32_t normal : a.corner_normal)
    CHECK(mesh::norm(a.normals[normal] - Point{0, 1, 0}) < 1e-6);
  CHECK(a.colors[4] == Color{0, 1, 1, 1});
  CHECK(read.warnings.empty());
}

TEST_CASE("a_mesh_without_material_stays_without_material") {
  const Models models;
  const formats::ReadResult read = foreign::read(models / "smile.fbx");
  CHECK(read.attributes->materials.empty());
  CHECK(read.attributes->groups.at(0).material == mesh::none);
}

TEST_CASE("properties_of_fbx_materials_are_read_as_blender_writes_them") {
  const Models models;
  test::put_file(models / "glow.png", "an image");
  (void)models.changed("smile.fbx", "\t\tGeometryVersion: 124\n",
                       R"(		GeometryVersion: 124
		LayerElementMaterial: 0 {
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 {
				a: 0
			}
		}
		Layer: 0 {
			LayerElement:  {
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}
		}
)");
  (void)models.changed("smile.fbx", "\tDeformer: 4,",
                       R"(	Material: 6, "Material::Paint", "" {
		ShadingModel: "Phong"
		Properties70:  {
			P: "DiffuseColor", "Color", "", "A",0.2140411,0,1
			P: "Opacity", "double", "Number", "",0.5
			P: "Shininess", "double", "Number", "",25
			P: "ReflectionFactor", "double", "Number", "",0.25
		}
	}
	Texture: 7, "Texture::glow", "" {
		FileName: "C:\elsewhere\glow.png"
		RelativeFilename: "glow.png"
	}
	Deformer: 4,)");
  const formats::ReadResult read = models.changed(
      "smile.fbx", "\tC: \"OO\",2,0", "\tC: \"OO\",2,0\n\tC: \"OO\",6,2\n\tC: \"OP\",7,6, \"EmissiveColor\"");
  REQUIRE(read.attributes);
  REQUIRE(read.attributes->materials.size() == 1);
  const formats::Material& m = read.attributes->materials[0];
  CHECK(m.name == "Paint");
  CHECK(m.base_color[0] == doctest::Approx(0.5));  // the file has linear colours
  CHECK(m.base_color[1] == 0);
  CHECK(m.base_color[3] == 0.5F);
  CHECK(m.roughness == 0.5F);
  CHECK(m.metallic == 0.25F);
  CHECK(m.emission == Color{1, 1, 1, 1});
  CHECK(read.attributes->images.at(m.emission_image).name == "glow.png");
  CHECK(!m.is_translucent);
  const formats::ReadResult textured = models.changed(
      "smile.fbx", "\"EmissiveColor\"",
      "\"ShininessExponent\"\n\tC: \"OP\",7,6, \"TransparencyFactor\"\n\tC: \"OP\",7,6, \"DiffuseColor\"");
  const formats::Material& all = textured.attributes->materials.at(0);
  CHECK(all.roughness_image == 0);
  CHECK(all.roughness == 1);
  CHECK(all.base_color_image == 0);
  CHECK(all.is_translucent);
}

TEST_CASE("files_outside_the_folder_are_not_read") {
  const Models models;
  fs::create_directory(models / "inner");
  fs::rename(models / "house.dae", models / "inner/house.dae");
  test::put_file(models / "wood.png", "an image");
  CHECK(mentions(models.changed("inner/house.dae", "wood.png", "../wood.png").warnings.at(0),
                 "textures not found in the folder of the file: ../wood.png"));
  fs::create_symlink("../wood.png", models / "inner/wood.png");
  CHECK(models.changed("inner/house.dae", "../wood.png", "wood.png").attributes->images.empty());
  fs::remove(models / "inner/wood.png");
  test::put_file(models / "inner/wood.png", "an image");  // the name of a path from another computer
  CHECK(models.changed("inner/house.dae", "wood.png", "C:\\textures\\wood.png").attributes->images.size() ==
        1);
  fs::create_symlink("inner/house.dae", models / "link.dae");
  CHECK(foreign::read(models / "link.dae").surface.positions.size() == 10);
}

TEST_CASE("fbx_files_are_converted_to_metres_with_y_up") {
  const Models models;
  const formats::ReadResult read = foreign::read(models / "smile.fbx");
  CHECK(read.surface.positions == std::vector<Point>{{0, 3, 0}, {1, 3, 0}, {1, 3, -1}, {0, 3, -1}});
  CHECK(mentions(read.warnings.at(0), "turned so that y is up, converted from units of 1 cm to metres"));
  CHECK(models.changed("smile.fbx", "\"\",1\n\t}", "\"\",100\n\t}").surface.positions[1] ==
        Point{100, 300, 0});
  const auto up = models.changed("smile.fbx", "\"UpAxis\", \"int\", \"Integer\", \"\",2",
                                 "\"UpAxis\", \"int\", \"Integer\", \"\",7");
  CHECK(up.surface.positions[1] == Point{100, 0, 300});  // impossible axes are ignored
  CHECK(mentions(up.warnings.at(0), "1 morph target"));
}

TEST_CASE("morph_targets_of_fbx_are_shapes") {
  const Models models;
  const auto morphs = foreign::read(models / "smile.fbx").original->morphs();
  REQUIRE(morphs);
  CHECK(morphs->targets() == std::vector<std::string>{"smile"});
  CHECK(morphs->at_target(0) == std::vector<Point>{{0, 3, 0}, {1, 3, 0}, {1, 3.5, -1}, {0, 3, -1}});
}

TEST_CASE("assimp_names_the_fault_of_a_file") {
  const Models models;
  test::put_file(models / "a.fbx", "; FBX 7.3.0 project file\nObjects: {\n");
  const auto problem = [&](const char* name) {
    return test::problem_of([&] { foreign::read(models / name); });
  };
  CHECK(mentions(problem("a.fbx"), "a.fbx: Assimp could not read this FBX file: FBX-"));
  test::put_file(models / "a.3ds", "");
  CHECK(mentions(problem("a.3ds"), "Assimp could not read this 3DS file"));
}
