// Draws Gaussian splats: blended ellipses with colours that depend on the direction. Also blends them on the
// processor (SplatPicture).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/image.h"
#include "render/surface_layer.h"
#include "render/view.h"

namespace viete::render {

/// The matrix M = R diag(s) of a splat, row by row; its covariance is M M^T. R is a rotation and s are the
/// standard deviations. A deformation with the derivative F changes M to F M.
using SplatShape = std::array<float, 9>;
/// The rotation of a splat's colours, as a unit quaternion w, x, y, z.
using SplatTurn = std::array<float, 4>;

/// Opacities and colours, one entry per splat. Colours are as displayed: captures are blended as displayed.
struct SplatLooks {
  std::vector<float> opacities;              ///< from 0 to 1; splats below 1 / 255 are not drawn
  std::vector<std::array<float, 3>> colors;  ///< without the harmonics
  /// Coefficients of real spherical harmonics without the constant one, see mesh::Splats::harmonics. Null if
  /// degree is 0.
  std::shared_ptr<const std::vector<float>> harmonics;
  int degree = 0;  ///< of the harmonics, 0 to 3
};

/// A splat on the screen, in the layout of the shader.
struct alignas(16) Ellipse {
  static constexpr float brightest = 4;
  static constexpr float reach = 3;  ///< in standard deviations; a splat ends there

  float center[3];              ///< in normalized device coordinates
  std::uint16_t red, green;     ///< in units of brightest / 65535
  float long_axis[2];           ///< the longer standard deviation and its direction, in pixels
  float short_axis;             ///< the shorter standard deviation, in pixels
  std::uint16_t blue, opacity;  ///< opacity in units of 1 / 65535
};

/// A picture of splats, bottom row first, blended on the processor: several times faster than by a software
/// rasteriser.
class SplatPicture {
public:
  /// Blends ellipses from front to back. A pixel ends when it is nearly opaque.
  void blend(std::span<const Ellipse> ellipses, glm::ivec2 size);

  const std::vector<Rgba8>& colors() const { return colors_; }  ///< premultiplied by the opacity
  /// The window depth at which the opacity reaches a half; if it stays below, of the nearest splat.
  const std::vector<float>& depths() const { return depths_; }

private:
  struct Rows {
    int low, high;  // the first row, and the row after the last
  };
  void blend_band(std::span<const Ellipse> ellipses, int low, int high);

  glm::ivec2 size_{0, 0};
  std::vector<Rgba8> colors_;
  std::vector<float> depths_;
  std::vector<Rows> rows_;  // one per ellipse
};

/// Sorts by decreasing depth: `order` becomes the indices of `depths` in this order. Equal depths keep their
/// order. `depths` must not contain NaN. Linear time.
void sort_back_to_front(std::span<const float> depths, std::vector<std::uint32_t>& order);

/// Draws splats as in B. Kerbl et al., 3D Gaussian Splatting for Real-Time Radiance Field Rendering, 2023.
/// Projects and sorts the splats on the processor, when the view or the splats change. Instead of a software
/// rasteriser, a SplatPicture blends them. Copies all spans. Throws base::Error if a size does not match the
/// number of splats. Not thread-safe.
class SplatLayer {
public:
  explicit SplatLayer(const Gl& gl);

  /// Sets the number of splats and their looks. Discards splats and scalars. Null: no splats.
  void set_looks(std::shared_ptr<const SplatLooks> looks);
  /// Sets the splats of a frame, with positions relative to `origin`; normals are ignored. If `turns` is
  /// empty, colours are not turned. Splats that are not finite are not drawn.
  void set_splats(std::span<const SurfaceVertex> vertices, const Point& origin,
                  std::span<const SplatShape> shapes, std::span<const SplatTurn> turns);
  /// Sets one value per splat, in any range (see SurfaceStyle). If empty, removes the scalars. Splats that
  /// are dark without scalars get darker colours of the palette.
  void set_scalars(std::span<const float> scalars);
  /// Sets at least 2 colours, as displayed. The colours are evenly spaced and interpolated.
  void set_palette(std::span<const glm::vec3> colors);

  std::size_t size() const { return looks_ ? looks_->opacities.size() : 0; }

  /// Draws every `step`-th splat, enlarged to the area of `step` splats. Nearer surfaces hide splats; splats
  /// do not hide each other. Then writes the depth of each pixel in which a splat, or in a SplatPicture all
  /// splats together, have at least half opacity. Uses only the scalars of the style. If no splats are set,
  /// draws nothing.
  void draw(const View& view, const SurfaceStyle& style, std::size_t step = 1);

private:
  struct Frame;
  // The input of the last projection.
  struct Drawn {
    View view;
    std::size_t step = 1;
    bool scalars = false;
    float low = 0, high = 1;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  void project(const Drawn& drawn);
  bool project(const Frame& frame, std::size_t splat, Ellipse& ellipse, float& depth) const;
  glm::vec3 color_of(const Frame& frame, std::size_t splat) const;
  glm::vec3 map_color(const Frame& frame, std::size_t splat, float brightness) const;
  void upload();
  void blend(glm::ivec2 size);

  const Gl& gl_;
  Program blended_, solid_;  // blended_: premultiplied colours; solid_: depth only
  VertexArray vertex_array_;
  BufferTexture ellipses_;  // back to front; not with a software rasteriser
  std::shared_ptr<const SplatLooks> looks_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<SplatShape> shapes_;
  std::vector<SplatTurn> turns_;
  std::vector<float> scalars_;
  std::vector<glm::vec3> palette_;
  Point origin_{0, 0, 0};
  std::vector<Ellipse> projected_;
  std::vector<float> depths_;
  std::vector<std::uint32_t> order_;
  // Only with a software rasteriser:
  std::vector<Ellipse> front_to_back_;
  SplatPicture picture_;
  Texture colors_, picture_depths_;
  std::size_t visible_ = 0;     // number of projected ellipses
  std::optional<Drawn> drawn_;  // nullopt: the splats have changed
};

}  // namespace viete::render
