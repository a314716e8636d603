// The view as a picture that stays while nothing in it changes, so that panels over it are drawn without it.
#pragma once

#include <optional>

#include "app/workspace_renderer.h"
#include "render/framebuffer.h"

namespace viete::app {

/// How finely a picture is drawn: a software rasteriser draws what moves at half the resolution.
enum class Fineness { coarse, plain, smooth };

class KeptView {
public:
  struct Samples {
    int plain = 0, smooth = 0;  ///< 0 none; smooth: no finer than plain
  };
  KeptView(const render::Gl& gl, const Samples& samples) : samples_(samples), picture_(gl) {}

  bool shows(const ViewDrawing& drawing) const { return drawn_ == drawing; }
  /// Draws, unless that is what it shows and as finely. Returns whether it did.
  bool draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness);
  const render::Framebuffer& picture() const { return picture_; }

  /// How often it was drawn.
  unsigned long count() const { return count_; }
  Fineness fineness() const { return fineness_; }
  Fineness finest() const { return samples_.smooth > 0 ? Fineness::smooth : Fineness::plain; }
  /// The next draw() does.
  void forget() { drawn_.reset(); }

private:
  Samples samples_;
  render::Framebuffer picture_;
  std::optional<ViewDrawing> drawn_;  // what it shows, whatever the fineness
  Fineness fineness_ = Fineness::plain;
  unsigned long count_ = 0;
};

}  // namespace viete::app
