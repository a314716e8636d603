// Owners of GL objects: one GL name each, moved but not copied, deleted with the owner.
#pragma once

#include <cstddef>
#include <utility>

#include "render/gl.h"

namespace viete::render {

/// One GL name made by `create(1, &id)` and released by `destroy(1, &id)`. The Gl must outlive it.
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
using Renderbuffer = Object<&Gl::GenRenderbuffers, &Gl::DeleteRenderbuffers>;
using FramebufferObject = Object<&Gl::GenFramebuffers, &Gl::DeleteFramebuffers>;

/// A buffer that remembers its size, so that a frame that uploads as much as the last one allocates nothing.
class Buffer {
public:
  explicit Buffer(const Gl& gl) : gl_(&gl), object_(gl) {}

  GLuint id() const { return object_.id(); }
  std::size_t bytes() const { return bytes_; }
  /// Replaces the content. usage: GL_STATIC_DRAW for topology, GL_STREAM_DRAW for what changes each frame.
  void upload(const void* data, std::size_t bytes, GLenum usage);
  /// Memory for `bytes` new bytes, the old content thrown away (never waits for the GPU); then unmap(). bytes
  /// > 0.
  void* map(std::size_t bytes);
  void unmap();

private:
  const Gl* gl_;
  Object<&Gl::GenBuffers, &Gl::DeleteBuffers> object_;
  std::size_t bytes_ = 0;
};

/// A buffer seen by shaders as a one-dimensional array of texels (texelFetch on a samplerBuffer).
class BufferTexture {
public:
  /// format: GL_RGBA32F, GL_R32UI, ...
  BufferTexture(const Gl& gl, GLenum format) : buffer(gl), gl_(&gl), texture_(gl), format_(format) {}

  void bind(int unit) const;

  Buffer buffer;

private:
  const Gl* gl_;
  Texture texture_;
  GLenum format_;
};

}  // namespace viete::render
