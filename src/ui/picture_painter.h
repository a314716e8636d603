// Draws the flat shapes of small pictures, see scene/pictures/picture_view.h.
#pragma once

#include "scene/pictures/picture_view.h"
#include "ui/context.h"

namespace viete::ui {

/// Into the window that is being built, from a corner on.
class PicturePainter {
public:
  PicturePainter(const Context& ui, ImVec2 corner);
  ~PicturePainter();
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  void draw(const scene::PictureShape& shape);

private:
  using Shape = scene::PictureShape;

  std::vector<ImVec2> placed(const Shape& shape) const;
  void line(const Shape& shape, ImU32 color, float width, ImDrawFlags flags = 0);
  void fill(const Shape& shape, ImU32 color);
  void lit(const Shape& shape);
  ImU32 color_of(float weight) const;
  void weighed(const Shape& shape);
  void triangles(const Shape& shape, const std::vector<ImU32>& colors);

  const Context& ui_;
  ImDrawList& list_;
  ImVec2 corner_;
};

}  // namespace viete::ui
