#include "render/framebuffer.h"

#include "support/stage.h"

using namespace viete;

namespace {

void clear(const render::Gl& gl, float red, float green, float blue, float alpha) {
  gl.ClearColor(red, green, blue, alpha);
  gl.Clear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

TEST_CASE("cleared_colour_is_read_back_opaque") {
  test::Stage stage;
  for (const int samples : {0, 4}) {
    const render::Image image = stage.picture([&] { clear(stage.gl, 1, 0.5F, 0, 0.25F); }, samples);
    CHECK(image.width == 320);
    CHECK(image.height == 200);
    CHECK(image.pixel(100, 100) == render::Rgba8{255, 128, 0, 255});
  }
}

TEST_CASE("top_row_of_the_picture_comes_first") {
  test::Stage stage;
  const render::Image image = stage.picture([&] {
    stage.gl.Enable(GL_SCISSOR_TEST);
    stage.gl.Scissor(0, 190, 320, 10);  // the top 10 rows of 200: GL counts from the bottom
    clear(stage.gl, 1, 1, 1, 1);
    stage.gl.Disable(GL_SCISSOR_TEST);
  });
  CHECK(image.pixel(5, 9)[0] == 255);
  CHECK(image.pixel(5, 10)[0] == 0);
}

TEST_CASE("size_and_samples_can_change_up_to_what_the_driver_has") {
  test::Stage stage;
  stage.framebuffer.begin({64, 64}, 1000);
  CHECK(stage.framebuffer.samples() == (stage.gl.max_samples >= 2 ? stage.gl.max_samples : 0));
  stage.framebuffer.begin({64, 64}, 1);
  CHECK(stage.framebuffer.samples() == 0);
  CHECK_NOTHROW(render::check_gl(stage.gl, "samples"));
  CHECK_THROWS_AS(stage.framebuffer.begin({1 << 20, 16}, 0), base::Error);
  for (const glm::ivec2 size :
       {glm::ivec2(1, 1), glm::ivec2(333, 77), glm::ivec2(64, 64), glm::ivec2(0, -5)}) {
    stage.view.size = size;
    const render::Image image = stage.picture([&] { clear(stage.gl, 0, 1, 0, 1); });
    CHECK(image.width == std::max(1, size.x));
    CHECK(image.height == std::max(1, size.y));
    CHECK(image.pixel(image.width - 1, image.height - 1)[1] == 255);
  }
}

TEST_CASE("begin_with_stretches_another_picture_without_changing_it") {
  test::Stage stage;
  const auto fill = [&](int width, int height, float red, float blue) {
    stage.gl.Enable(GL_SCISSOR_TEST);
    stage.gl.Scissor(0, 0, width, height);
    clear(stage.gl, red, 0, blue, 1);
    stage.gl.Disable(GL_SCISSOR_TEST);
  };
  const auto draw = [&] {
    clear(stage.gl, 0, 1, 0, 1);
    fill(160, 200, 1, 0);
  };
  const render::Image small = stage.picture(draw, 4);
  render::Framebuffer whole(stage.gl);
  for (const int factor : {1, 2}) {
    whole.begin_with(stage.framebuffer, factor * stage.view.size);
    fill(10, 10, 0, 1);
    const render::Image image = whole.read();
    CHECK(image.width == factor * small.width);
    CHECK(image.height == factor * small.height);
    CHECK(image.pixel(20 * factor, 20 * factor) == render::Rgba8{255, 0, 0, 255});
    CHECK(image.pixel(300 * factor, 20 * factor) == render::Rgba8{0, 255, 0, 255});
    CHECK(image.pixel(5, image.height - 5) == render::Rgba8{0, 0, 255, 255});
    CHECK(stage.framebuffer.read().rgba == small.rgba);
  }
}
