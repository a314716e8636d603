// A context that draws nothing. With this context, the viewer runs without OpenGL.
#pragma once

#include <stdexcept>
#include <string_view>
#include <vector>

#include "platform/offscreen_context.h"

namespace viete::test {

/// Ignores all GL calls. If a pixel is read, throws an exception.
class NoPixels final : public platform::OffscreenContext {
public:
  render::Proc get_proc_address(const char* name) const override {
    if (const render::Proc answer = answering(name)) return answer;
#define X(function) \
  if (name == std::string_view("gl" #function)) return proc(Nothing<decltype(&::gl##function)>::call);
    VIETE_GL_FUNCTIONS(X)
#undef X
    return nullptr;
  }

private:
  template <class Function>
  struct Nothing;
  template <class Result, class... Arguments>
  struct Nothing<Result (*)(Arguments...)> {
    static Result call(Arguments...) { return Result(); }
  };
  template <class Function>
  static render::Proc proc(Function* function) {
    return reinterpret_cast<render::Proc>(function);
  }

  static render::Proc answering(std::string_view name) {
    if (name.starts_with("glGen") && name != "glGenerateMipmap") return proc(one_name);
    if (name == "glGetShaderiv" || name == "glGetProgramiv") return proc(success);
    if (name == "glGetIntegerv") return proc(large);
    if (name == "glGetString") return proc(software);
    if (name == "glCheckFramebufferStatus") return proc(complete);
    if (name == "glMapBufferRange") return proc(memory);
    if (name == "glReadPixels") return proc(no_pixels);
    return nullptr;
  }
  static void one_name(GLsizei, GLuint* name) {
    *name = 1;
  }
  static void success(GLuint, GLenum, GLint* status) {
    *status = GL_TRUE;
  }
  static void large(GLenum, GLint* value) {
    *value = 1 << 27;
  }
  static const GLubyte* software(GLenum) {
    return reinterpret_cast<const GLubyte*>("llvmpipe");
  }
  static GLenum complete(GLenum) {
    return GL_FRAMEBUFFER_COMPLETE;
  }
  static void* memory(GLenum, GLintptr, GLsizeiptr bytes, GLbitfield) {
    static std::vector<char> buffer;
    if (buffer.size() < static_cast<std::size_t>(bytes)) buffer.resize(static_cast<std::size_t>(bytes));
    return buffer.data();
  }
  static void no_pixels(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*) {
    throw std::logic_error("this viewer draws nothing: a test of pixels needs Driver(with_pixels)");
  }
};

}  // namespace viete::test
