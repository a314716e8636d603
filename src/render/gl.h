// The functions of OpenGL 3.3 core, loaded at run time, and classes that own GL objects. Programs
// compiled from the embedded shaders.
#pragma once

#include <cstddef>
#include <utility>

#if defined(__gl_h_)
#error "GL/gl.h was included first: define GLFW_INCLUDE_NONE"
#endif
#define GL_GLEXT_PROTOTYPES 1
#include <GL/glcorearb.h>

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

namespace viete::render {

/// The functions that the program uses. If code calls glFoo instead of gl.Foo, linking intentionally fails.
// clang-format off
#define VIETE_GL_FUNCTIONS(X) \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer) \
  X(BindTexture) X(BindVertexArray) X(BlendEquation) X(BlendFuncSeparate) \
  X(BlitFramebuffer) X(BufferData) X(BufferSubData) X(CheckFramebufferStatus) X(Clear) \
  X(ClearColor) X(ClientWaitSync) X(ColorMask) X(CompileShader) X(CopyBufferSubData) X(CreateProgram) X(CreateShader) \
  X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteRenderbuffers) X(DeleteShader) \
  X(DeleteSync) X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) X(DrawArrays) \
  X(DrawElements) X(DrawElementsBaseVertex) X(Enable) \
  X(EnableVertexAttribArray) X(FenceSync) X(Finish) X(FramebufferRenderbuffer) X(FramebufferTexture2D) \
  X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays) X(GenerateMipmap) \
  X(GetError) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) \
  X(GetShaderiv) X(GetString) X(GetStringi) X(GetUniformLocation) X(LinkProgram) X(MapBufferRange) \
  X(PixelStorei) X(PolygonOffset) X(ReadPixels) X(RenderbufferStorageMultisample) \
  X(Scissor) X(ShaderSource) X(TexBuffer) X(TexImage2D) X(TexParameteri) X(Uniform1f) X(Uniform1i) \
  X(Uniform2f) X(Uniform3f) X(Uniform4f) X(UniformMatrix4fv) X(UnmapBuffer) \
  X(UseProgram) X(VertexAttribPointer) X(Viewport)
// clang-format on

using Proc = void (*)();
/// Returns a GL function by its full name ("glClear"), or null. Requires a current context.
using GetProc = std::function<Proc(const char*)>;

/// The functions of one context. Drawing objects keep a reference to this object. Call the functions only in
/// the thread in which the context is current.
struct Gl {
#define X(name) decltype(&::gl##name) name = nullptr;
  VIETE_GL_FUNCTIONS(X)
#undef X
  decltype(&::glBufferStorage) BufferStorage = nullptr;  ///< null if the driver lacks ARB_buffer_storage
  std::string renderer;    ///< GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;     ///< GL_VERSION
  int max_samples = 1;     ///< GL_MAX_SAMPLES
  int max_texels = 65536;  ///< GL_MAX_TEXTURE_BUFFER_SIZE: the largest number of texels in a BufferTexture
  /// True for a CPU rasteriser (llvmpipe, softpipe, swrast), which is too slow for multisampling in a window.
  bool software = false;
};

/// Loads the functions of the current context. If OpenGL 3.3 is not supported, throws base::Error.
Gl load_gl(const GetProc& get);

/// If GL recorded an error after the last check, throws base::Error with the place `where`.
void check_gl(const Gl& gl, const char* where);

/// Calls check_gl() in debug builds only, because check_gl() waits for the GPU.
inline void debug_check_gl([[maybe_unused]] const Gl& gl, [[maybe_unused]] const char* where) {
#ifndef NDEBUG
  check_gl(gl, where);
#endif
}

/// Owns a GL object. Calls create(1, &id) and later destroy(1, &id). The Gl must outlive the object.
template <auto create, auto destroy>
class Object {
public:
  explicit Object(const Gl& gl) : gl_(&gl) { (gl.*create)(1, &id_); }
  Object(Object&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Object() {
    if (id_ != 0) (gl_->*destroy)(1, &id_);
  }

  GLuint id() const { return id_; }

private:
  const Gl* gl_;
  GLuint id_ = 0;
};

using VertexArray = Object<&Gl::GenVertexArrays, &Gl::DeleteVertexArrays>;
using Texture = Object<&Gl::GenTextures, &Gl::DeleteTextures>;
struct TexelFormat {
  GLint stored;        ///< the texture's format, such as GL_RGBA8
  GLenum given, type;  ///< the data's format, such as GL_RGBA and GL_UNSIGNED_BYTE
};
/// Fills a texture and binds it. Sets one level, linear filtering and clamped edges. `data` may be null.
void set_texture(const Gl& gl, int unit, const Texture& texture, int width, int height,
                 const TexelFormat& format, const void* data);
void bind_texture(const Gl& gl, int unit, const Texture& texture);

using Renderbuffer = Object<&Gl::GenRenderbuffers, &Gl::DeleteRenderbuffers>;
using FramebufferObject = Object<&Gl::GenFramebuffers, &Gl::DeleteFramebuffers>;

using BufferObject = Object<&Gl::GenBuffers, &Gl::DeleteBuffers>;

/// Memory that the CPU writes and from which the GPU copies. It stays mapped, so that a frame allocates
/// nothing.
class Staging {
public:
  /// Gl::BufferStorage must not be null.
  Staging(const Gl& gl, std::size_t bytes);
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  ~Staging() { gl_.DeleteSync(copied_); }

  /// Waits until the last copy has finished, and returns the memory. Null if there was no memory.
  void* memory();
  /// Copies the memory to the buffer that is bound to GL_ARRAY_BUFFER. Does not wait.
  void copy();

private:
  const Gl& gl_;
  BufferObject object_;
  std::size_t bytes_;
  void* memory_;
  GLsync copied_ = nullptr;
};

/// A GL buffer. Keeps its storage for new content of the same size, except with GL_STATIC_DRAW.
class Buffer {
public:
  explicit Buffer(const Gl& gl) : gl_(&gl), object_(gl) {}

  GLuint id() const { return object_.id(); }
  /// Replaces the content. Use GL_STATIC_DRAW for topology and GL_STREAM_DRAW for data of each frame.
  void upload(const void* data, std::size_t bytes, GLenum usage);
  /// Discards the content without waiting for the GPU, and returns memory for `bytes` > 0 of new content.
  /// Call unmap() after writing. Throws base::Error if memory is short. From the second content of the same
  /// size on, a GPU copies from a Staging: mapping new memory in each frame would take several times as long.
  void* map(std::size_t bytes);
  void unmap();

private:
  const Gl* gl_;
  BufferObject object_;
  std::size_t bytes_ = 0;
  std::unique_ptr<Staging> staging_;
  bool staged_ = false;  // true: unmap() copies from staging_
};

/// A buffer that shaders read as an array of texels, with texelFetch() on a samplerBuffer.
class BufferTexture {
public:
  /// `format` is the format of a texel, such as GL_RGBA32F or GL_R32UI.
  BufferTexture(const Gl& gl, GLenum format) : buffer(gl), gl_(&gl), texture_(gl), format_(format) {}

  void bind(int unit) const;

  Buffer buffer;

private:
  const Gl* gl_;
  Texture texture_;
  GLenum format_;
};

/// Returns the source of an embedded shader, such as "surface.vert". Throws base::Error for an unknown name.
std::string_view shader_text(std::string_view file);

/// A program linked from a vertex shader and a fragment shader. Call use() before set(). set() ignores
/// unknown names, because compilers remove unused variables.
class Program {
public:
  /// Compiles shaders/NAME.vert and shaders/NAME.frag for NAME = `name`. Inserts `defines` after the version
  /// line. Throws base::Error with the compiler's message, such as "surface.frag: 0:12(3): ...".
  Program(const Gl& gl, const std::string& name, const std::string& defines = "");
  /// Compiles these sources. `name` is used in messages.
  Program(const Gl& gl, const std::string& name, std::string_view vertex, std::string_view fragment);
  Program(Program&& other) noexcept;
  Program& operator=(Program&&) = delete;
  ~Program();

  void use() const;
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const glm::vec2& value) const;
  void set(const char* name, const glm::vec3& value) const;
  void set(const char* name, const glm::vec4& value) const;
  void set(const char* name, const glm::mat4& value) const;

private:
  int location(const char* name) const;

  const Gl& gl_;
  GLuint id_ = 0;
  mutable std::unordered_map<std::string, int> locations_;
};

}  // namespace viete::render
