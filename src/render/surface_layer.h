// The lit model: triangles with smooth normals, optional wireframe, occlusion and colours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/choice.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// What the surface looks as if made of. `plain` is one colour for all; `zebra` mirrors stripes, whose bends
/// show curvature; `file`, `checker` and `normals` colour it by what is known of its points.
enum class Paint { plain, file, checker, normals, porcelain, jade, zebra };

/// Consecutive triangles that look alike.
struct SurfaceRun {
  std::size_t triangles = 0;
  glm::vec3 color{1};  ///< in linear light; multiplied by image and vertex colours
  int image = -1;      ///< of SurfaceLooks::images; -1: none
  bool repeats = true;
  bool flat = false;  ///< faces are lit as planes
};

/// How a surface looks by itself. Arrays are empty where there is none of it.
struct SurfaceLooks {
  std::vector<std::array<float, 2>>
      texture_points;         ///< of each corner of each triangle; (0, 0) is the upper left
  std::vector<Rgba8> colors;  ///< of each vertex, or of each corner of each triangle; display values
  bool colors_of_corners = false;
  std::vector<Image> images;     ///< where opacity is below a half, one looks through
  std::vector<SurfaceRun> runs;  ///< all triangles, in order
};

struct SurfaceStyle {
  Paint paint = Paint::plain;
  /// The surface is closed and wound outwards: backs are skipped, which more than halves the time of
  /// this layer on a software rasteriser. Where a deformation has turned a part inside out, one then looks
  /// through it.
  bool closed = false;
  float wireframe = 0;   ///< opacity of triangle edges, 0 = none; 0.3 is a good hint. Fades on tiny triangles
  float wire_width = 1;  ///< logical pixels
  float occlusion = 1;   ///< how much of the baked darkening is used, 0 to 1
  bool scalars = false;  ///< colour by set_scalars() through set_palette() instead of theme.model
  float scalar_low = 0;  ///< the scalar at the first palette colour
  float scalar_high = 1;  ///< the scalar at the last palette colour

  friend bool operator==(const SurfaceStyle&, const SurfaceStyle&) = default;
};

/// A vertex as the graphics card takes it.
struct SurfaceVertex {
  float position[3], unused0 = 0;
  float normal[3], unused1 = 0;  ///< of length 1
};

/// Not thread-safe. All spans are copied. Throws base::Error if a size does not fit the vertex count, or a
/// triangle names a vertex that is not there.
class SurfaceLayer {
public:
  explicit SurfaceLayer(const Gl& gl);

  /// New topology: forgets positions, occlusion and scalars. The front is where corners run
  /// counter-clockwise; backs are lit too.
  void set_triangles(std::span<const Triangle> triangles, std::size_t vertex_count);
  /// Every frame: copied as they are, one per vertex, positions relative to origin. Vertices that are not
  /// finite are put at the origin.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  /// The same of positions in the caller's world and unit normals, relative to the first finite position.
  void set_positions(std::span<const Point> positions, std::span<const Point> normals);
  /// Per vertex 0 (dark) to 1 (open), as mesh/cavity.h makes it. An empty span removes it.
  void set_occlusion(std::span<const float> occlusion);
  /// One value per vertex, any range (see SurfaceStyle). An empty span removes it.
  void set_scalars(std::span<const float> scalars);
  /// At least 2 colours as displayed, spread evenly and interpolated.
  void set_palette(std::span<const glm::vec3> colors);

  /// After set_triangles(), which forgets them.
  void set_looks(const SurfaceLooks& looks);

  /// Draws nothing before there are vertices.
  void draw(const View& view, const Theme& theme, const SurfaceStyle& style) const;

  std::size_t triangle_count() const { return triangle_count_; }

private:
  void upload_looks();
  const Program& program_for(const SurfaceStyle& style, bool flat = false) const;
  void use(const Program& program, const View& view, const Theme& theme, const SurfaceStyle& style) const;
  void draw_runs(const View& view, const Theme& theme, const SurfaceStyle& style) const;
  void set_view(const Program& program, const View& view) const;
  void set_looks(const Program& program, const View& view, const Theme& theme,
                 const SurfaceStyle& style) const;

  const Gl& gl_;
  // What is not asked for costs nothing: each has a wireframe or none, colours of vertices or none, and plain
  // colour, scalars, looks, looks of flat faces, a material, or a pass.
  mutable std::array<std::optional<Program>, 32> programs_;
  VertexArray vertex_array_;
  BufferTexture indices_;         // 3 vertex numbers per triangle
  BufferTexture vertices_;        // SurfaceVertex, two texels each
  BufferTexture looks_;           // occlusion and scalar of each vertex
  BufferTexture texture_points_;  // of each corner
  BufferTexture colors_;          // of each vertex or corner
  std::vector<Texture> images_;
  std::vector<SurfaceRun> runs_;
  bool has_texture_points_ = false, has_colors_ = false, colors_of_corners_ = false;
  Texture palette_;
  float palette_size_ = 2;
  std::vector<float> occlusion_, scalars_;
  std::size_t triangle_count_ = 0, vertex_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_vertices_ = false;
};

}  // namespace viete::render
