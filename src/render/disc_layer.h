// Points as anti-aliased discs of constant size on screen.
#pragma once

#include <cstdint>
#include <span>

#include "render/gl_objects.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// How one point looks.
struct Disc {
  glm::vec4 color{1, 1, 1, 1};  ///< as displayed, alpha 0 to 1
  float radius = 3.0F;          ///< logical pixels, without the outline; 0 draws nothing
  bool ring = false;            ///< a thin ring around it, for the point under the cursor

  friend bool operator==(const Disc&, const Disc&) = default;
};

struct DiscStyle {
  glm::vec3 outline{0, 0, 0};  ///< colour of the thin edge (theme.outline)
  glm::vec3 ring{1, 1, 1};     ///< colour of rings (theme.hover)
  float opacity = 1;
  /// Of discs behind something, as a factor on opacity; rings are as strong as in front. A point less
  /// than 2.5 radii behind a face counts as in front of it, so that the slanted faces around it do not cut
  /// into its disc.
  float hidden_opacity = 0.3F;
};

/// Not thread-safe. All spans are copied. Throws base::Error if discs and positions differ in number when
/// drawn.
class DiscLayer {
public:
  explicit DiscLayer(const Gl& gl);

  /// Looks, when a selection or the hovered point changes: one per point. Later points lie over earlier ones.
  void set_discs(std::span<const Disc> discs);
  /// Every frame; one per point.
  void set_positions(std::span<const Point> positions);
  void draw(const View& view, const DiscStyle& style) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  BufferTexture points_, looks_;
  std::size_t point_count_ = 0, disc_count_ = 0;
  Point origin_{0, 0, 0};
};

}  // namespace viete::render
