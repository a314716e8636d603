#include "render/backdrop.h"

#include "support/stage.h"

using namespace viete;

TEST_CASE("backdrop_runs_from_the_top_colour_to_the_bottom_colour") {
  test::Stage stage;
  const render::Backdrop backdrop(stage.gl);
  const render::Theme theme = render::light_theme();
  const render::Image image = stage.picture([&] { backdrop.draw(theme); });
  for (int c = 0; c < 3; ++c) {
    CHECK(std::abs(image.pixel(160, 0)[c] - 255 * theme.background_top[c]) <= 2);
    CHECK(std::abs(image.pixel(160, 199)[c] - 255 * theme.background_bottom[c]) <= 2);
  }
}
