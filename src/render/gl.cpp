#include "render/gl.h"

#include "base/error.h"

namespace viete::render {

namespace {

void look_up_functions(Gl& gl, const GetProc& get) {
#define X(name)                                                                                             \
  gl.name = reinterpret_cast<decltype(gl.name)>(get("gl" #name));                                           \
  if (gl.name == nullptr) {                                                                                 \
    throw base::Error("OpenGL", "the driver has no gl" #name, "install a driver with OpenGL 3.3 or newer"); \
  }
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
  throw base::Error("OpenGL", "version 3.3 is needed, this context is \"" + gl.version + "\"",
                    "update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1");
}

bool is_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY: return "out of memory";
    default: return "unknown error";
  }
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
  return gl;
}

void check_gl(const Gl& gl, const char* where) {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR) throw base::Error(where, std::string("OpenGL reports ") + error_name(error));
}

// GL_ARRAY_BUFFER is not part of a vertex array's state, so binding it for an upload has no side effects.
void Buffer::upload(const void* data, std::size_t bytes, GLenum usage) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  if (bytes == bytes_ && usage != GL_STATIC_DRAW) {
    gl_->BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  } else {
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, usage);
  }
  bytes_ = bytes;
}

void* Buffer::map(std::size_t bytes) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  if (bytes != bytes_)
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
  bytes_ = bytes;
  void* memory = gl_->MapBufferRange(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes),
                                     GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  if (memory == nullptr)
    throw base::Error("graphics memory", "no room for a buffer of " + std::to_string(bytes) + " bytes");
  return memory;
}

void Buffer::unmap() {
  gl_->BindBuffer(GL_ARRAY_BUFFER, object_.id());
  gl_->UnmapBuffer(GL_ARRAY_BUFFER);
}

void BufferTexture::bind(int unit) const {
  gl_->ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl_->BindTexture(GL_TEXTURE_BUFFER, texture_.id());
  gl_->TexBuffer(GL_TEXTURE_BUFFER, format_, buffer.id());
}

}  // namespace viete::render
