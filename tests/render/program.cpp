#include "render/program.h"

#include <string>

#include "base/error.h"
#include "support/stage.h"

using namespace viete;

TEST_CASE("shader_mistake_names_its_file") {
  const test::Stage stage;
  const char* vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0); }\n";
  const char* wrong = "#version 330 core\nout vec4 color;\nvoid main() { color = unknown_name; }\n";
  try {
    const render::Program program(stage.gl, "sample", vertex, wrong);
    FAIL("a wrong shader was accepted");
  } catch (const base::Error& error) {
    CHECK(error.place() == "sample.frag");
    CHECK(error.problem().find("unknown_name") != std::string::npos);
  }
}

TEST_CASE("shaders_that_do_not_fit_each_other_are_refused") {
  const test::Stage stage;
  const char* vertex =
      "#version 330 core\nout vec2 a;\nvoid main() { a = vec2(1); gl_Position = vec4(0); }\n";
  const char* fragment =
      "#version 330 core\nin vec3 a;\nout vec4 color;\nvoid main() { color = vec4(a, 1); }\n";
  CHECK_THROWS_AS(render::Program(stage.gl, "sample", vertex, fragment), base::Error);
}

TEST_CASE("unknown_shader_is_named") {
  CHECK_THROWS_WITH_AS(render::shader_text("nothing.vert"),
                       "nothing.vert: no shader of this name is embedded", base::Error);
}

TEST_CASE("defines_follow_the_version_line_and_line_numbers_stay_true") {
  const test::Stage stage;
  CHECK_NOTHROW(render::Program(stage.gl, "surface", "#define WIREFRAME\n"));
  try {
    const render::Program program(stage.gl, "backdrop", "#error stop here\n");
    FAIL("the defines were not compiled");
  } catch (const base::Error& error) {
    CHECK(error.place() == "backdrop.vert");
    CHECK(error.problem().find("stop here") != std::string::npos);
  }
}
