#include "render/gl.h"

#include <string>

#include "base/error.h"
#include "support/stage.h"

using namespace viete;

TEST_CASE("missing_entry_point_is_named") {
  const test::Stage stage;
  const auto without_tex_buffer = [&](const char* name) -> render::Proc {
    return std::string(name) == "glTexBuffer" ? nullptr : stage.context->get_proc_address(name);
  };
  try {
    render::load_gl(without_tex_buffer);
    FAIL("a driver without glTexBuffer was accepted");
  } catch (const base::Error& error) {
    CHECK(std::string(error.what()).find("glTexBuffer") != std::string::npos);
  }
}

TEST_CASE("context_has_a_version_and_a_renderer_name") {
  const test::Stage stage;
  CHECK_FALSE(stage.gl.renderer.empty());
  CHECK(stage.gl.version.find('.') != std::string::npos);
  CHECK(stage.gl.max_samples >= 1);
}

TEST_CASE("gl_mistake_is_reported_once_with_its_place") {
  const test::Stage stage;
  stage.gl.Enable(GL_RENDERER);  // no capability
  CHECK_THROWS_WITH_AS(render::check_gl(stage.gl, "here"), "here: OpenGL reports invalid enum", base::Error);
  CHECK_NOTHROW(render::check_gl(stage.gl, "here"));
}
