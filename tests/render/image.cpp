#include "render/image.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>
#include "base/error.h"
#include "support/pictures.h"

using namespace viete;

namespace {

/// A folder for this process only, removed at the end of the test.
struct ScratchFolder {
  ScratchFolder()
      : path(std::filesystem::temp_directory_path() / ("viete_image_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

render::Image pattern(int width, int height) {
  render::Image image{width, height, {}};
  for (int i = 0; i < 4 * width * height; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * 37 % 251));
  return image;
}

}  // namespace

TEST_CASE("png_round_trip_is_exact") {
  const ScratchFolder folder;
  const render::Image image = pattern(13, 7);
  render::write_png(folder.path / "a.png", image);
  const render::Image back = test::read_png(folder.path / "a.png");
  CHECK(back.width == 13);
  CHECK(back.height == 7);
  CHECK(back.rgba == image.rgba);
}

TEST_CASE("png_write_replaces_the_old_file_and_leaves_no_temporary") {
  const ScratchFolder folder;
  render::write_png(folder.path / "a.png", pattern(3, 3));
  render::write_png(folder.path / "a.png", pattern(5, 4));
  CHECK(test::read_png(folder.path / "a.png").width == 5);
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path)) ++files;
  CHECK(files == 1);
}

TEST_CASE("png_that_cannot_be_written_is_named") {
  const std::filesystem::path recovered = "/nonexistent_folder/a.png";
  try {
    render::write_png(recovered, pattern(2, 2));
    FAIL("a folder that is not there was written to");
  } catch (const base::Error& error) {
    CHECK(std::string(error.what()).find("/nonexistent_folder/a.png") != std::string::npos);
  }
}

TEST_CASE("folder_as_png_target_is_rejected_and_kept") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path / "a.png" / "inside");
  CHECK_THROWS_AS(render::write_png(folder.path / "a.png", pattern(2, 2)), base::Error);
  CHECK(std::filesystem::exists(folder.path / "a.png" / "inside"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("empty_picture_is_refused") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(render::write_png(folder.path / "a.png", render::Image{}), base::Error);
}

TEST_CASE("difference_is_the_share_of_pixels_beyond_the_tolerance") {
  const render::Image a = pattern(10, 10);
  render::Image b = a;
  b.rgba[4 * 7] ^= 4;       // one pixel by 4 levels
  b.rgba[4 * 9 + 2] ^= 64;  // one pixel by 64 levels
  b.rgba[4 * 9 + 1] ^= 64;  // the same pixel again
  CHECK(test::difference(a, a, 0) == 0);
  CHECK(test::difference(a, b, 0) == doctest::Approx(0.02));
  CHECK(test::difference(a, b, 4) == doctest::Approx(0.01));
  CHECK(test::difference(a, b, 64) == 0);
}

TEST_CASE("a_picture_is_decoded_and_halved_until_it_is_short_enough") {
  const ScratchFolder folder;
  render::Image image{8, 4, std::vector<std::uint8_t>(4 * 8 * 4, 255)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 8)
    image.rgba[i] = 0;  // red is off in every other pixel
  render::write_png(folder.path / "a.png", image);
  std::ifstream in(folder.path / "a.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  CHECK(render::decode_image("a.png", bytes, 8).rgba == image.rgba);
  const render::Image small = render::decode_image("a.png", bytes, 4);
  CHECK(small.width == 4);
  CHECK(small.height == 2);
  CHECK(small.pixel(0, 0) == render::Rgba8{188, 255, 255, 255});  // half of the light
}

TEST_CASE("pictures_of_invalid_size_are_rejected_before_decoding") {
  std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x27\x10\x08\6\0\0\0", 29);
  head += std::string("\0\0\0\0\0\0\0\4IDATabcd\0\0\0\0", 20);
  const auto refusal = [](const std::string& bytes) {
    try {
      render::decode_image("given", bytes, 4096);
    } catch (const base::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal(head).find("20000 x 10000 pixels") != std::string::npos);
  CHECK(refusal("nonsense").find("not a picture in a supported format") != std::string::npos);
  CHECK(refusal("").find("given: ") == 0);
  head[18] = head[19] = 0;  // 0 x 10000
  CHECK(refusal(head) != "");
}
