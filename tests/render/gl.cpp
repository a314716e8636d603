#include "render/gl.h"
#include "render/upload.h"
#include "support/stage.h"

using namespace viete;

TEST_CASE("missing_entry_point_is_named") {
  const test::Stage stage;
  const auto without_tex_buffer = [&](const char* name) -> render::Proc {
    return std::string(name) == "glTexBuffer" ? nullptr : stage.context->get_proc_address(name);
  };
  CHECK_THROWS_WITH_AS(render::load_gl(without_tex_buffer), doctest::Contains("glTexBuffer"), base::Error);
  CHECK(stage.gl.version.find('.') != std::string::npos);
}

TEST_CASE("gl_mistake_is_reported_once_with_its_place") {
  const test::Stage stage;
  stage.gl.Enable(GL_RENDERER);  // an invalid argument
  CHECK_THROWS_WITH_AS(render::check_gl(stage.gl, "here"),
                       "here: OpenGL reports error 0x500; update the graphics driver", base::Error);
  CHECK_NOTHROW(render::check_gl(stage.gl, "here"));
}

TEST_CASE("shader_mistakes_name_the_file_and_defines_follow_the_version_line") {
  const test::Stage stage;
  const char* vertex =
      "#version 330 core\nout vec2 a;\nvoid main() { a = vec2(1); gl_Position = vec4(0); }\n";
  const auto compile = [&](const std::string& fragment) {
    render::Program(stage.gl, "sample", vertex, "#version 330 core\nout vec4 color;\n" + fragment);
  };
  const char* wrong = "void main() { color = unknown_name; }\n";
  CHECK_THROWS_WITH_AS(compile(wrong), doctest::Contains("unknown_name"), base::Error);
  CHECK_THROWS_WITH_AS(compile(wrong), doctest::Contains("sample.frag: "), base::Error);
  CHECK_THROWS_AS(compile("in vec3 a;\nvoid main() { color = vec4(a, 1); }\n"), base::Error);
  CHECK_THROWS_WITH_AS(render::shader_text("nothing.vert"), "nothing.vert: unknown shader name", base::Error);
  CHECK_NOTHROW(render::Program(stage.gl, "surface", "#define WIREFRAME\n"));
  const auto stop = [&] { render::Program(stage.gl, "backdrop", "#error stop here\n"); };
  CHECK_THROWS_WITH_AS(stop(), doctest::Contains("stop here"), base::Error);
  CHECK_THROWS_WITH_AS(stop(), doctest::Contains("backdrop.vert: "), base::Error);
}

using render::Point;

TEST_CASE("points_are_relative_to_the_first_finite_one_without_loss") {
  CHECK(render::origin_of(std::vector<Point>{{NAN, 0, 0}, {1, 2, 3}, {4, 5, 6}}) == Point{1, 2, 3});
  CHECK(render::origin_of(std::vector<Point>{{0, INFINITY, 0}}) == Point{0, 0, 0});
  CHECK(render::origin_of({}) == Point{0, 0, 0});
  CHECK(render::relative({1e9 + 0.125, 1, -1e9}, {1e9, 0, -1e9}) == glm::vec3(0.125F, 1, 0));
  CHECK(render::relative({NAN, 1, 2}, {0, 0, 0}) == glm::vec3(0));
}

TEST_CASE("wrong_index_is_named_with_its_element") {
  const std::vector<std::array<std::uint32_t, 2>> segments{{0, 1}, {1, 7}};
  CHECK_NOTHROW(render::require_indices<2>("segments", segments, 8));
  CHECK_THROWS_WITH_AS(render::require_indices<2>("segments", segments, 7),
                       "segments: element 1: refers to vertex 7, the mesh has 7", base::Error);
}
