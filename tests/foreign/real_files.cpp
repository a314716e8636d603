// The models of Assimp's own tests (package assimp-testmodels), compared with Assimp's tool (assimp-utils).
#include "base/error.h"
#include "foreign/read.h"
#include "mesh/summary.h"
#include "support/data.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;
namespace fs = std::filesystem;

namespace {

// The scale to metres in the note about the unit of an FBX file.
double scale_of(const formats::ReadResult& read) {
  constexpr std::string_view unit = "units of ";
  for (const std::string& note : read.warnings)
    if (const auto at = note.find(unit); at != note.npos)
      return 0.01 * std::stod(note.substr(at + unit.size()));
  return 1;
}

bool is_turned(const formats::ReadResult& read) {
  return std::ranges::any_of(read.warnings, [](const auto& note) { return test::mentions(note, "turned"); });
}

// Compares with the file that Assimp's tool exports, which has triangles with all transforms applied.
void compare(const formats::ReadResult& read, const mesh::Surface& exported) {
  const double scale = scale_of(read);
  const mesh::Summary found = mesh::summarize(read.surface), wanted = mesh::summarize(exported);
  CHECK(found.triangles == wanted.triangles);
  CHECK(found.area == doctest::Approx(scale * scale * wanted.area).epsilon(1e-4));
  const mesh::Bounds box = mesh::used_bounds(read.surface), expected = mesh::used_bounds(exported);
  const double size = box.diagonal();
  CHECK(size == doctest::Approx(scale * expected.diagonal()).epsilon(1e-5));
  if (!is_turned(read))
    CHECK(mesh::norm(box.low - scale * expected.low) <= 1e-5 * (size + mesh::norm(box.low)));
}

}  // namespace

TEST_CASE("models_of_assimp_are_read_as_assimp_exports_them" * doctest::test_suite(test::if_present)) {
  const fs::path models = "/usr/share/assimp/models";
  if (!fs::exists(models) || std::system("assimp version > /dev/null 2>&1") != 0)
    return test::skip("assimp-testmodels or assimp-utils is not installed");
  test::set_environment("VIETE_IMPORT", (test::build_dir() / "viete-import").string());
  const test::TemporaryFolder folder;
  std::size_t compared = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(models)) {
    const foreign::Kind* kind = foreign::kind_of(entry.path());
    if (!kind || !entry.is_regular_file()) continue;
    CAPTURE(entry.path());
    fs::remove(folder / "out.obj");
    const std::string command = "assimp export '" + entry.path().string() + "' '" +
                                (folder / "out.obj").string() + "' -ptv > /dev/null 2>&1";
    const bool exports = std::system(command.c_str()) == 0 && fs::exists(folder / "out.obj");
    try {
      const formats::ReadResult read = foreign::read(entry.path());
      if (!exports || read.surface.triangles.empty()) continue;
      compare(read, foreign::read(folder / "out.obj").surface);
      ++compared;
    } catch (const base::Error& error) {
      CHECK_FALSE(test::mentions(error.what(), "crashed"));
      CHECK_FALSE(test::mentions(error.what(), "no valid scene"));
      ++refused;
    }
  }
  unsetenv("VIETE_IMPORT");
  CHECK(compared > 200);
  CHECK(refused < 100);
}
