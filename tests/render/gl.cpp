#include <doctest/doctest.h>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "render/gl.h"
#include "render/program.h"
#include "render/upload.h"
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
  stage.gl.Enable(GL_RENDERER);  // not a capability
  CHECK_THROWS_WITH_AS(render::check_gl(stage.gl, "here"), "here: OpenGL reports invalid enum", base::Error);
  CHECK_NOTHROW(render::check_gl(stage.gl, "here"));
}

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

TEST_CASE("mismatched_shaders_are_rejected") {
  const test::Stage stage;
  const char* vertex =
      "#version 330 core\nout vec2 a;\nvoid main() { a = vec2(1); gl_Position = vec4(0); }\n";
  const char* fragment =
      "#version 330 core\nin vec3 a;\nout vec4 color;\nvoid main() { color = vec4(a, 1); }\n";
  CHECK_THROWS_AS(render::Program(stage.gl, "sample", vertex, fragment), base::Error);
}

TEST_CASE("unknown_shader_is_named") {
  CHECK_THROWS_WITH_AS(render::shader_text("nothing.vert"), "nothing.vert: unknown shader name", base::Error);
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

using render::Point;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("origin_is_the_first_finite_point") {
  CHECK(render::origin_of(std::vector<Point>{{not_a_number, 0, 0}, {1, 2, 3}, {4, 5, 6}}) == Point{1, 2, 3});
  CHECK(render::origin_of(std::vector<Point>{{0, INFINITY, 0}}) == Point{0, 0, 0});
  CHECK(render::origin_of({}) == Point{0, 0, 0});
}

TEST_CASE("relative_keeps_small_differences_of_large_numbers") {
  CHECK(render::relative({1e9 + 0.125, 1, -1e9}, {1e9, 0, -1e9}) == glm::vec3(0.125F, 1, 0));
  CHECK(render::relative({not_a_number, 1, 2}, {0, 0, 0}) == glm::vec3(0));
}

TEST_CASE("wrong_index_is_named_with_its_element") {
  const std::vector<std::array<std::uint32_t, 2>> segments{{0, 1}, {1, 7}};
  CHECK_NOTHROW(render::require_indices<2>("segments", segments, 8));
  CHECK_THROWS_WITH_AS(render::require_indices<2>("segments", segments, 7),
                       "segments: element 1: refers to vertex 7, the mesh has 7", base::Error);
}
