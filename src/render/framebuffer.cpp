#include "render/framebuffer.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/error.h"

namespace viete::render {

namespace {

std::string size_text(glm::ivec2 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y);
}

void require_supported(const Gl& gl, glm::ivec2 size) {
  GLint texture = 0, buffer = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &buffer);
  const int limit = std::min(texture, buffer);
  if (size.x <= limit && size.y <= limit) return;
  throw base::Error(
      "picture",
      size_text(size) + " pixels exceed the driver's limit of " + std::to_string(limit) + " per side",
      "choose a smaller size or scale");
}

}  // namespace

Framebuffer::Framebuffer(const Gl& gl)
    : gl_(gl),
      resolved_(gl),
      multisampled_(gl),
      color_(gl),
      depth_(gl),
      sample_color_(gl),
      sample_depth_(gl) {}

void Framebuffer::fit(glm::ivec2 size, int samples) {
  size = glm::max(size, glm::ivec2(1));
  samples = std::min(samples, gl_.max_samples);
  if (samples < 2) samples = 0;
  if (size != size_ || samples != samples_) allocate(size, samples);
}

void Framebuffer::begin(glm::ivec2 size, int samples) {
  fit(size, samples);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, samples_ > 0 ? multisampled_.id() : resolved_.id());
  gl_.Viewport(0, 0, size_.x, size_.y);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.ClearColor(0, 0, 0, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Framebuffer::allocate(glm::ivec2 size, int samples) {
  require_supported(gl_, size);
  size_ = {0, 0};  // if an error follows, the next begin() allocates again
  samples_ = samples;
  set_texture(gl_, 0, color_, size.x, size.y, {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, nullptr);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_DEPTH_COMPONENT24, size.x, size.y);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  require_complete("picture", size);
  if (samples > 0) allocate_multisampled(size);
  size_ = size;
}

void Framebuffer::allocate_multisampled(glm::ivec2 size) {
  gl_.BindRenderbuffer(GL_RENDERBUFFER, sample_color_.id());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA8, size.x, size.y);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, sample_depth_.id());
  gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_DEPTH_COMPONENT24, size.x, size.y);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, multisampled_.id());
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, sample_color_.id());
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, sample_depth_.id());
  require_complete("multisampled picture", size);
}

void Framebuffer::require_complete(const char* what, glm::ivec2 size) const {
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw base::Error(what, "the graphics driver rejects a picture of " + size_text(size) + " pixels",
                    "choose a smaller size or fewer samples");
}

void Framebuffer::resolve() {
  if (samples_ > 0) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    gl_.BlitFramebuffer(0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  debug_check_gl(gl_, "resolve");
}

void Framebuffer::begin_with(const Framebuffer& picture, glm::ivec2 size) {
  fit(size, 0);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  picture.blit_to(resolved_.id(), size_);
  gl_.Viewport(0, 0, size_.x, size_.y);
}

void Framebuffer::blit_to(GLuint target, glm::ivec2 size) const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  const GLenum filter = size == size_ ? GL_NEAREST : GL_LINEAR;
  gl_.BlitFramebuffer(0, 0, size_.x, size_.y, 0, 0, size.x, size.y, GL_COLOR_BUFFER_BIT, filter);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target);
  debug_check_gl(gl_, "copy of the picture");
}

void Framebuffer::blit_to_window(glm::ivec2 window_size) {
  blit_to(0, window_size);
}

Image Framebuffer::read(bool opaque) {
  const std::size_t row = 4 * static_cast<std::size_t>(size_.x);
  std::vector<std::uint8_t> bottom_up(row * size_.y);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
  check_gl(gl_, "reading the picture");

  Image image{size_.x, size_.y, std::vector<std::uint8_t>(bottom_up.size())};
  for (int y = 0; y < size_.y; ++y)
    std::memcpy(&image.rgba[row * y], &bottom_up[row * (size_.y - 1 - y)], row);
  for (std::size_t i = 3; opaque && i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace viete::render
