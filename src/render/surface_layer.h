// The lit model: triangles with smooth normals, optional wireframe, occlusion and colours.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/choice.h"
#include "base/drawn_vertex.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// Appearance of the surface: `plain` has one colour; `zebra` reflects stripes, whose bends show curvature;
/// `file`, `checker` and `normals` use the file's colours, a texture pattern and the normals.
enum class Paint { plain, file, checker, normals, porcelain, jade, zebra };

/// Consecutive triangles of the same appearance.
struct SurfaceRun {
  std::size_t triangles = 0;
  glm::vec3 color{1};  ///< linear light; multiplied by image and vertex colours
  int image = -1;      ///< index into SurfaceLooks::images; -1: none
  bool repeats = true;
  bool flat = false;  ///< flat shading
};

/// Appearance stored in the file. Arrays are empty if not available.
struct SurfaceLooks {
  std::vector<std::array<float, 2>>
      texture_points;         ///< per corner of each triangle; (0, 0) is the upper left
  std::vector<Rgba8> colors;  ///< per vertex, or per corner of each triangle; display values
  bool colors_of_corners = false;
  std::vector<Image> images;     ///< pixels with opacity below a half are cut out
  std::vector<SurfaceRun> runs;  ///< covers all triangles in order
};

struct SurfaceStyle {
  Paint paint = Paint::plain;
  /// Skips back faces of a closed surface wound outwards, which more than halves the time of this layer on a
  /// software rasteriser. Parts turned inside out by a deformation then appear transparent.
  bool closed = false;
  bool coarse = false;    ///< draws the triangles of set_coarse_triangles(), if any; not with looks
  float wireframe = 0;    ///< opacity of triangle edges, 0: none; 0.3 is subtle. Fades on tiny triangles
  float occlusion = 1;    ///< strength of the baked darkening, 0 to 1
  bool scalars = false;   ///< colour by set_scalars() through set_palette() instead of theme.model
  float scalar_low = 0;   ///< scalar of the first palette colour
  float scalar_high = 1;  ///< scalar of the last palette colour

  friend bool operator==(const SurfaceStyle&, const SurfaceStyle&) = default;
};

using SurfaceVertex = base::DrawnVertex;

/// Not thread-safe. Copies all spans. Throws base::Error if a size does not match the vertex count, or if a
/// triangle uses an invalid vertex index.
class SurfaceLayer {
public:
  explicit SurfaceLayer(const Gl& gl);

  /// New topology: discards positions, occlusion and scalars. Front faces are counter-clockwise; back faces
  /// are lit too.
  void set_triangles(std::span<const Triangle> triangles, std::size_t vertex_count);
  /// Fewer triangles of the same vertices for SurfaceStyle::coarse; none: draws all. Call after
  /// set_triangles(), which discards them.
  void set_coarse_triangles(std::span<const Triangle> triangles);
  /// One per vertex, positions relative to origin; call every frame. Copied unchanged, except that non-finite
  /// vertices move to the origin.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  /// Takes world positions and normals; stores them relative to the first finite position.
  void set_positions(std::span<const Point> positions, std::span<const base::PackedNormal> normals);
  /// Per vertex 0 (dark) to 1 (open), see mesh/drawing.h. An empty span removes it.
  void set_occlusion(std::span<const float> occlusion);
  /// One value per vertex, any range (see SurfaceStyle). An empty span removes them.
  void set_scalars(std::span<const float> scalars);
  /// At least 2 colours as displayed, evenly spaced and interpolated.
  void set_palette(std::span<const glm::vec3> colors);

  /// Call after set_triangles(), which discards the looks.
  void set_looks(const SurfaceLooks& looks);

  /// Draws nothing before set_vertices() or set_positions().
  void draw(const View& view, const Theme& theme, const SurfaceStyle& style) const;

private:
  const Program& program_for(const SurfaceStyle& style, bool flat = false) const;
  void use(const Program& program, const View& view, const Theme& theme, const SurfaceStyle& style) const;
  void draw_runs(const View& view, const Theme& theme, const SurfaceStyle& style) const;

  const Gl& gl_;
  // One program per combination, so that unused features cost nothing: wireframe or not, vertex colours or
  // not, and plain colour, scalars, looks, flat looks, a material, or a depth pass.
  mutable std::array<std::optional<Program>, 32> programs_;
  VertexArray vertex_array_;
  BufferTexture indices_;   // 3 vertex indices per triangle
  BufferTexture coarse_;    // the same for coarse triangles
  BufferTexture vertices_;  // SurfaceVertex, one texel each
  BufferTexture occlusion_, scalars_;
  BufferTexture texture_points_;  // per corner
  BufferTexture colors_;          // per vertex or corner
  std::vector<Texture> images_;
  std::vector<SurfaceRun> runs_;
  bool has_texture_points_ = false, has_colors_ = false, colors_of_corners_ = false;
  Texture palette_;
  float palette_size_ = 2;
  std::size_t triangle_count_ = 0, coarse_count_ = 0, vertex_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_vertices_ = false;
};

}  // namespace viete::render
