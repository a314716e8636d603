// Painting on the model how much of it follows the cage.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "deform/frame_vertex.h"
#include "scene/document/camera.h"
#include "scene/document/document.h"

namespace viete::scene {

/// What a stroke paints, and how wide.
struct Brush {
  static constexpr float least_radius = 4, largest_radius = 400;

  float radius = 40;  ///< logical pixels
  float share = 0;    ///< of its motion that a vertex keeps where it is painted in full, 0 to 1
};

/// The model as it was deformed last, as a graphics card takes it; no vertices: it is at rest.
struct PosedModel {
  std::span<const deform::FrameVertex> vertices{};
  mesh::Point origin{0, 0, 0};
  unsigned long frame = 0;  ///< another number where the vertices may be others

  mesh::Point at(const mesh::Surface& model, std::size_t vertex) const;
};

/// Where the ray meets the posed model first, in the file's coordinates; nothing where it does not. O(n).
std::optional<mesh::Point> pick_model(const Document& document, const PosedModel& posed, const Ray& ray);

/// A point of the model that goes with it: of a triangle, by the shares of its corners.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> shares{};
};

/// The same, as a point of the surface.
std::optional<SurfacePoint> pick_triangle(const Document& document, const PosedModel& posed, const Ray& ray);

/// Shares are kept in steps of one 255th, as a session has them.
inline constexpr int mask_steps = 255;

/// From the press of the button to its release: where the brush goes over a vertex again it paints no more
/// than once.
class MaskStroke {
public:
  explicit MaskStroke(const Document& document);

  /// Vertices nearer than half of the radius to the center take this share, those up to the radius the less
  /// of it the farther they are. The document shows it at once.
  void dab(Document& document, const PosedModel& posed, const mesh::Point& center, double radius,
           float share);
  /// One undoable edit; none if nothing was painted.
  void commit(Document& document);
  /// All is as it was before.
  void cancel(Document& document) const;

private:
  DocumentState before_;
  std::vector<float> shares_, covered_;
};

bool same_mask(const deform::Mask& a, const deform::Mask& b);
/// A mask as an edit; null where all of it is 1. Requires a share for each vertex of the model, or none.
void set_mask(Document& document, deform::Mask mask, const char* label);
/// What followed stays, and the reverse.
deform::Mask inverted(const Document& document);

}  // namespace viete::scene
