#include "render/program.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include <utility>

#include "base/error.h"

namespace viete::render {

namespace {

/// A shader object. After linking, a program does not need its shaders: the destructor deletes the shader.
struct Shader {
  Shader(const Gl& api, GLenum kind) : gl(api), id(api.CreateShader(kind)) {}
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { gl.DeleteShader(id); }

  const Gl& gl;
  GLuint id;
};

/// Inserts `defines` after the version line of a shader. Line numbers in compiler messages stay correct.
std::string with_defines(const std::string& file, const std::string& defines) {
  std::string text(shader_text(file));
  const std::size_t version = text.find("#version");
  const std::size_t next_line = text.find('\n', version) + 1;
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(next_line), '\n');
  return text.insert(next_line, defines + "#line " + std::to_string(lines + 1) + "\n");
}

void compile(const Shader& shader, const std::string& file, std::string_view source) {
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  shader.gl.ShaderSource(shader.id, 1, &text, &length);
  shader.gl.CompileShader(shader.id);
  GLint good = 0;
  shader.gl.GetShaderiv(shader.id, GL_COMPILE_STATUS, &good);
  if (good != 0) return;
  char log[2048] = "";
  shader.gl.GetShaderInfoLog(shader.id, sizeof log, nullptr, log);
  throw base::Error(file, log);
}

void link(const Gl& gl, GLuint program, const std::string& name) {
  gl.LinkProgram(program);
  GLint good = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &good);
  if (good != 0) return;
  char log[2048] = "";
  gl.GetProgramInfoLog(program, sizeof log, nullptr, log);
  throw base::Error(name, log);
}

}  // namespace

Program::Program(const Gl& gl, const std::string& name, const std::string& defines)
    : Program(gl, name, with_defines(name + ".vert", defines), with_defines(name + ".frag", defines)) {}

Program::Program(const Gl& gl, const std::string& name, std::string_view vertex, std::string_view fragment)
    : gl_(gl) {
  const Shader vertex_shader(gl, GL_VERTEX_SHADER), fragment_shader(gl, GL_FRAGMENT_SHADER);
  compile(vertex_shader, name + ".vert", vertex);
  compile(fragment_shader, name + ".frag", fragment);
  id_ = gl.CreateProgram();
  gl.AttachShader(id_, vertex_shader.id);
  gl.AttachShader(id_, fragment_shader.id);
  try {
    link(gl, id_, name);
  } catch (...) {
    gl.DeleteProgram(id_);
    throw;
  }
}

Program::Program(Program&& other) noexcept
    : gl_(other.gl_), id_(std::exchange(other.id_, 0)), locations_(std::move(other.locations_)) {}

Program::~Program() {
  if (id_ != 0) gl_.DeleteProgram(id_);
}

void Program::use() const {
  gl_.UseProgram(id_);
}

int Program::location(const char* name) const {
  auto found = locations_.find(name);
  if (found == locations_.end()) found = locations_.emplace(name, gl_.GetUniformLocation(id_, name)).first;
  return found->second;
}

void Program::set(const char* name, int value) const {
  gl_.Uniform1i(location(name), value);
}
void Program::set(const char* name, float value) const {
  gl_.Uniform1f(location(name), value);
}
void Program::set(const char* name, const glm::vec2& value) const {
  gl_.Uniform2f(location(name), value.x, value.y);
}
void Program::set(const char* name, const glm::vec3& value) const {
  gl_.Uniform3f(location(name), value.x, value.y, value.z);
}
void Program::set(const char* name, const glm::vec4& value) const {
  gl_.Uniform4f(location(name), value.x, value.y, value.z, value.w);
}
void Program::set(const char* name, const glm::mat4& value) const {
  gl_.UniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace viete::render
