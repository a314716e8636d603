#include "render/framebuffer.h"

#include "base/error.h"
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
    stage.gl.Scissor(0, 190, 320, 10);  // GL counts rows from the bottom
    clear(stage.gl, 1, 1, 1, 1);
    stage.gl.Disable(GL_SCISSOR_TEST);
  });
  CHECK(image.pixel(5, 9)[0] == 255);
  CHECK(image.pixel(5, 10)[0] == 0);
}

TEST_CASE("samples_are_clamped_to_what_the_driver_has") {
  test::Stage stage;
  stage.framebuffer.begin({64, 64}, 1000);
  CHECK(stage.framebuffer.samples() == (stage.gl.max_samples >= 2 ? stage.gl.max_samples : 0));
  stage.framebuffer.begin({64, 64}, 1);
  CHECK(stage.framebuffer.samples() == 0);
  CHECK_NOTHROW(render::check_gl(stage.gl, "samples"));
}

TEST_CASE("size_can_change_between_frames") {
  test::Stage stage;
  for (const glm::ivec2 size :
       {glm::ivec2(1, 1), glm::ivec2(333, 77), glm::ivec2(64, 64), glm::ivec2(0, -5)}) {
    stage.view.size = size;
    const render::Image image = stage.picture([&] { clear(stage.gl, 0, 1, 0, 1); });
    CHECK(image.width == std::max(1, size.x));
    CHECK(image.height == std::max(1, size.y));
    CHECK(image.pixel(image.width - 1, image.height - 1)[1] == 255);
  }
}

TEST_CASE("too_large_picture_is_rejected_and_the_next_one_works") {
  test::Stage stage;
  CHECK_THROWS_AS(stage.framebuffer.begin({1 << 20, 16}, 0), base::Error);
  CHECK(stage.picture([&] { clear(stage.gl, 0, 0, 1, 1); }).pixel(0, 0)[2] == 255);
}

TEST_CASE("drawing_after_resolve_is_in_the_picture") {
  test::Stage stage;
  stage.framebuffer.begin(stage.view.size, 4);
  clear(stage.gl, 1, 0, 0, 1);
  stage.framebuffer.resolve();
  stage.gl.Enable(GL_SCISSOR_TEST);
  stage.gl.Scissor(0, 0, 10, 10);
  clear(stage.gl, 0, 0, 1, 1);
  stage.gl.Disable(GL_SCISSOR_TEST);
  const render::Image image = stage.framebuffer.read();
  CHECK(image.pixel(5, 195) == render::Rgba8{0, 0, 255, 255});
  CHECK(image.pixel(5, 5) == render::Rgba8{255, 0, 0, 255});
}

TEST_CASE("begin_with_stretches_another_picture_without_changing_it") {
  test::Stage stage;
  const render::Image small = stage.picture([&] {
    clear(stage.gl, 0, 1, 0, 1);
    stage.gl.Enable(GL_SCISSOR_TEST);
    stage.gl.Scissor(0, 0, 160, 200);
    clear(stage.gl, 1, 0, 0, 1);
    stage.gl.Disable(GL_SCISSOR_TEST);
  });
  render::Framebuffer whole(stage.gl);
  for (const int factor : {1, 2}) {
    whole.begin_with(stage.framebuffer, factor * stage.view.size);
    stage.gl.Enable(GL_SCISSOR_TEST);
    stage.gl.Scissor(0, 0, 10, 10);
    clear(stage.gl, 0, 0, 1, 1);
    stage.gl.Disable(GL_SCISSOR_TEST);
    const render::Image image = whole.read();
    CHECK(image.width == factor * small.width);
    CHECK(image.height == factor * small.height);
    CHECK(image.pixel(20 * factor, 20 * factor) == render::Rgba8{255, 0, 0, 255});
    CHECK(image.pixel(300 * factor, 20 * factor) == render::Rgba8{0, 255, 0, 255});
    CHECK(image.pixel(5, image.height - 5) == render::Rgba8{0, 0, 255, 255});
    CHECK(stage.framebuffer.read().rgba == small.rgba);
  }
}
