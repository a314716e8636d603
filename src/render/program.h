// Compiles the shaders of the folder shaders/. The executable contains their text.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "render/gl.h"

namespace viete::render {

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
