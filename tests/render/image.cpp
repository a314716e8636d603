#include "render/image.h"

#include "base/error.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;

TEST_CASE("png_round_trip_is_exact") {
  const test::TemporaryFolder folder;
  render::Image image{13, 7, {}};
  for (int i = 0; i < 4 * 13 * 7; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * 37 % 251));
  render::write_png(folder / "a.png", image);
  CHECK_THROWS_WITH_AS(render::write_png("/nonexistent_folder/a.png", image),
                       doctest::Contains("/nonexistent_folder/a.png"), base::Error);
  CHECK_THROWS_AS(render::write_png(folder / "a.png", render::Image{}), base::Error);
  CHECK(test::read_png(folder / "a.png").rgba == image.rgba);
}

TEST_CASE("a_picture_is_decoded_and_halved_until_it_is_short_enough") {
  const test::TemporaryFolder folder;
  render::Image image{8, 4, std::vector<std::uint8_t>(4 * 8 * 4, 255)};
  for (std::size_t i = 0; i < image.rgba.size(); i += 8) image.rgba[i] = 0;  // no red in every other pixel
  render::write_png(folder / "a.png", image);
  const std::string bytes = test::file_bytes(folder / "a.png");
  CHECK(render::decode_image("a.png", bytes, 8).rgba == image.rgba);
  const render::Image small = render::decode_image("a.png", bytes, 4);
  CHECK(small.width == 4);
  CHECK(small.height == 2);
  CHECK(small.pixel(0, 0) == render::Rgba8{188, 255, 255, 255});  // in sRGB, 188 is half of the light
  CHECK_THROWS_WITH_AS(render::decode_image("given", "nonsense", 4096), doctest::Contains("given: "),
                       base::Error);
}
