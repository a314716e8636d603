// Draws the lit model: triangles with smooth normals, optional wireframe, occlusion and colours.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/drawn_vertex.h"
#include "render/gl.h"
#include "render/image.h"
#include "render/view.h"

namespace viete::render {

/// The appearance of the surface. `plain` is one colour. `file` shows the file's colours, `checker` a texture
/// pattern, `normals` the normals as colours. `zebra` reflects stripes: their bends show the curvature.
enum class Paint { plain, file, checker, normals, porcelain, jade, zebra };

/// Consecutive triangles with equal appearance.
struct SurfaceRun {
  std::size_t triangles = 0;
  glm::vec3 color{1};  ///< in linear light; multiplied by image and vertex colours
  int image = -1;      ///< index into SurfaceLooks::images; -1 without an image
  bool repeats = true;
  bool flat = false;  ///< true: flat shading
};

/// The appearance that a file stores. If the file lacks one kind of data, the array of this kind is empty.
struct SurfaceLooks {
  std::vector<std::array<float, 2>>
      texture_points;         ///< one per corner of each triangle; (0, 0) is the upper left
  std::vector<Rgba8> colors;  ///< as displayed; one per vertex, or per corner of each triangle
  bool colors_of_corners = false;
  std::vector<Image> images;     ///< pixels with opacity below 0.5 are not drawn
  std::vector<SurfaceRun> runs;  ///< contain all triangles, in order
};

struct SurfaceStyle {
  Paint paint = Paint::plain;
  /// Skips back faces, for a closed surface that is oriented outward. Software rasterisers then need less
  /// than half the time. If a deformation turns a part inside out, this part looks transparent.
  bool closed = false;
  float wireframe = 0;    ///< the opacity of triangle edges; fainter on tiny triangles; 0 draws no edges
  float occlusion = 1;    ///< the strength of the baked darkening, from 0 to 1
  bool scalars = false;   ///< uses the colours of set_scalars() and set_palette() instead of theme.model
  float scalar_low = 0;   ///< the scalar with the first palette colour
  float scalar_high = 1;  ///< the scalar with the last palette colour
  float spacing = 0;      ///< without triangles: the distance between neighbouring points, in model units

  /// True if the picture shows SurfaceLooks.
  bool takes_looks() const {
    return !scalars && (paint == Paint::file || paint == Paint::checker || paint == Paint::normals);
  }
  friend bool operator==(const SurfaceStyle&, const SurfaceStyle&) = default;
};

using SurfaceVertex = base::DrawnVertex;

/// Draws the model. Copies all spans. Throws base::Error if a size does not match the vertex count, or if a
/// triangle has an invalid vertex index. Not thread-safe.
class SurfaceLayer {
public:
  explicit SurfaceLayer(const Gl& gl);

  /// Sets the triangles. Discards positions, occlusion and scalars. Front faces are counter-clockwise; back
  /// faces are lit too.
  void set_triangles(std::span<const Triangle> triangles, std::size_t vertex_count);
  /// Sets the vertices of a frame, with positions relative to `origin`. Vertices that are not finite are
  /// drawn at the origin.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  /// Sets world positions and normals. Stores the positions relative to the first finite position.
  void set_positions(std::span<const Point> positions, std::span<const base::PackedNormal> normals);
  /// Sets a factor for each vertex, 0 (dark) to 1 (open); see mesh/drawing.h. If empty, all factors are 1.
  void set_occlusion(std::span<const float> occlusion);
  /// Sets one value per vertex, in any range (see SurfaceStyle). If empty, removes the scalars.
  void set_scalars(std::span<const float> scalars);
  /// Sets at least 2 colours, as displayed. The colours are evenly spaced and interpolated.
  void set_palette(std::span<const glm::vec3> colors);

  /// Sets the appearance. Call this after set_triangles(), which discards the appearance.
  void set_looks(const SurfaceLooks& looks);
  /// Uses the images of another layer for the runs of this layer. Call this after set_looks().
  void share_images_of(const SurfaceLayer& other) { images_ = other.images_; }

  /// If no vertices or positions are set, draws nothing. Without triangles, draws points as discs without
  /// shading. If `paint` is not `file` or the file has no colours, far points are darker.
  void draw(const View& view, const Theme& theme, const SurfaceStyle& style) const;

private:
  const Program& program_for(const SurfaceStyle& style, bool flat = false) const;
  void use(const Program& program, const View& view, const Theme& theme, const SurfaceStyle& style) const;
  void draw_runs(const View& view, const Theme& theme, const SurfaceStyle& style) const;
  void draw_points(const View& view, const Theme& theme, const SurfaceStyle& style) const;

  const Gl& gl_;
  // One program for each combination of features, so that unused features cost no time; see program_for().
  mutable std::array<std::optional<Program>, 32> programs_;
  mutable std::array<std::optional<Program>, 3> point_programs_;
  VertexArray vertex_array_;
  BufferTexture indices_;   // three vertex indices per triangle
  BufferTexture vertices_;  // one SurfaceVertex per texel
  BufferTexture occlusion_, scalars_;
  BufferTexture texture_points_;                  // one per corner
  BufferTexture colors_;                          // one per vertex or corner
  std::shared_ptr<std::vector<Texture>> images_;  // shared with other layers
  std::vector<SurfaceRun> runs_;
  bool has_texture_points_ = false, has_colors_ = false, colors_of_corners_ = false;
  Texture palette_;
  float palette_size_ = 2;
  std::size_t triangle_count_ = 0, vertex_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_vertices_ = false;
  // The box of the finite points, relative to the origin. Only without triangles.
  struct Box {
    glm::vec3 low{1e30F}, high{-1e30F};
    void add(const glm::vec3& point);
  };
  Box box_;
};

}  // namespace viete::render
