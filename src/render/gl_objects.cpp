#include "render/gl_objects.h"

#include "base/error.h"

namespace viete::render {

// GL_ARRAY_BUFFER is not part of a vertex array's state, so binding there for an upload disturbs nothing.
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
