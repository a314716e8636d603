#include "render/gl.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "base/text.h"

namespace viete::render {

namespace {

void look_up_functions(Gl& gl, const GetProc& get) {
#define X(name)                                                                 \
  gl.name = reinterpret_cast<decltype(gl.name)>(get("gl" #name));               \
  if (gl.name == nullptr)                                                       \
    throw base::Error("OpenGL", "the graphics driver has no function gl" #name, \
                      "install a driver with OpenGL 3.3 or newer");
  VIETE_GL_FUNCTIONS(X)
#undef X
}

std::string text(const Gl& gl, GLenum name) {
  const GLubyte* bytes = gl.GetString(name);
  return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
}

void require_version(const Gl& gl) {
  int major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor >= 33) return;
  throw base::Error("OpenGL", "version 3.3 is needed, the graphics driver has \"" + gl.version + "\"",
                    "update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1");
}

bool has_extension(const Gl& gl, std::string_view name) {
  int count = 0;
  gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    const auto* extension = reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, i));
    if (extension != nullptr && extension == name) return true;
  }
  return false;
}

bool is_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

Gl load_gl(const GetProc& get) {
  Gl gl;
  look_up_functions(gl, get);
  gl.renderer = text(gl, GL_RENDERER);
  gl.version = text(gl, GL_VERSION);
  require_version(gl);
  gl.GetIntegerv(GL_MAX_SAMPLES, &gl.max_samples);
  gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &gl.max_texels);
  gl.software = is_software(gl.renderer);
  if (has_extension(gl, "GL_ARB_buffer_storage"))
    gl.BufferStorage = reinterpret_cast<decltype(gl.BufferStorage)>(get("glBufferStorage"));
  return gl;
}

void check_gl(const Gl& gl, const char* where) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return;
  throw base::Error(where, base::formatted("OpenGL reports error 0x%x", error), "update the graphics driver");
}

void bind_texture(const Gl& gl, int unit, const Texture& texture) {
  gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl.BindTexture(GL_TEXTURE_2D, texture.id());
}

void set_texture(const Gl& gl, int unit, const Texture& texture, int width, int height,
                 const TexelFormat& format, const void* data) {
  bind_texture(gl, unit, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format.stored, width, height, 0, format.given, format.type, data);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

Staging::Staging(const Gl& gl, std::size_t bytes) : gl_(gl), object_(gl), bytes_(bytes) {
  constexpr GLbitfield access = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  gl.BindBuffer(GL_COPY_READ_BUFFER, object_.id());
  gl.BufferStorage(GL_COPY_READ_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr,
                   access | GL_CLIENT_STORAGE_BIT);
  memory_ = gl.MapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes), access);
  if (memory_ == nullptr) gl.GetError();  // the caller then maps its own buffer
}

void* Staging::memory() {
  constexpr GLuint64 second = 1'000'000'000;
  if (copied_ != nullptr) {
    while (gl_.ClientWaitSync(copied_, GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED) {
    }
    gl_.DeleteSync(std::exchange(copied_, nullptr));
  }
  return memory_;
}

void Staging::copy() {
  gl_.BindBuffer(GL_COPY_READ_BUFFER, object_.id());
  gl_.CopyBufferSubData(GL_COPY_READ_BUFFER, GL_ARRAY_BUFFER, 0, 0, static_cast<GLsizeiptr>(bytes_));
  copied_ = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void Buffer::upload(const void* data, std::size_t bytes, GLenum usage) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  if (bytes != bytes_) staging_.reset();
  if (bytes == bytes_ && usage != GL_STATIC_DRAW) {
    gl_->BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  } else {
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
  }
  bytes_ = bytes;
}

void* Buffer::map(std::size_t bytes) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  const auto size = static_cast<GLsizeiptr>(bytes);
  if (bytes != bytes_) {
    staging_.reset();
    gl_->BufferData(GL_ARRAY_BUFFER, size, nullptr, GL_STREAM_DRAW);
    bytes_ = bytes;
  } else if (gl_->BufferStorage != nullptr && !gl_->software) {
    if (!staging_) {
      gl_->BufferData(GL_ARRAY_BUFFER, size, nullptr, GL_STATIC_COPY);  // in the GPU's memory
      staging_ = std::make_unique<Staging>(*gl_, bytes);
    }
    if (void* memory = staging_->memory()) {
      staged_ = true;
      return memory;
    }
  }
  staged_ = false;
  void* memory =
      gl_->MapBufferRange(GL_ARRAY_BUFFER, 0, size, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  if (memory == nullptr)
    throw base::Error("graphics memory", "no room for a buffer of " + std::to_string(bytes) + " bytes",
                      "use a smaller model or close other programs");
  return memory;
}

void Buffer::unmap() {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  staged_ ? staging_->copy() : static_cast<void>(gl_->UnmapBuffer(GL_ARRAY_BUFFER));
}

void BufferTexture::bind(int unit) const {
  gl_->ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl_->BindTexture(GL_TEXTURE_BUFFER, texture_.id());
  gl_->TexBuffer(GL_TEXTURE_BUFFER, format_, buffer.id());
}

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
