// Paints the model's mask. The mask is the fraction of the cage's motion that each vertex follows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "pose/rows.h"

namespace viete::document {

struct Brush {
  static constexpr float least_radius = 4, largest_radius = 400;

  float radius = 40;  ///< in logical pixels
  float share = 0;    ///< the mask value to paint, from 0 (stays at rest) to 1 (follows the cage)
};

/// The last deformed model, in the vertex layout of the GPU. If there are no vertices, the model is at rest.
struct PosedModel {
  std::span<const pose::FrameVertex> vertices{};
  mesh::Point origin{0, 0, 0};
  unsigned long frame = 0;  ///< changes with each deformation of the model

  mesh::Point at(const mesh::Surface& model, std::size_t vertex) const;
};

/// Returns the first intersection of the ray with the posed model, in file coordinates. Returns nullopt if
/// the ray misses the model. Tests every triangle. Without triangles, tests every point: the ray meets points
/// that are nearer to it than the usual distance between points. It does not meet faint splats.
std::optional<mesh::Point> pick_model(const Document& document, const PosedModel& posed, const Ray& ray);

/// A point attached to the model: the corners of its triangle and barycentric coordinates. Without triangles,
/// all corners are the same vertex.
struct SurfacePoint {
  mesh::Triangle corners{};
  std::array<double, 3> shares{};
};

/// Like pick_model(), but returns the corners and the barycentric coordinates.
std::optional<SurfacePoint> pick_corners(const Document& document, const PosedModel& posed, const Ray& ray);

/// The number of steps between mask values 0 and 1. Session files have the same steps.
inline constexpr int mask_steps = 255;

/// One stroke of the brush, from press to release of the mouse button. In one stroke, painting a vertex twice
/// has the same effect as painting it once.
class MaskStroke {
public:
  explicit MaskStroke(const Document& document);

  /// Paints `share` around the center. The strength is full up to half the radius, and 0 at the radius.
  void dab(Document& document, const PosedModel& posed, const mesh::Point& center, double radius,
           float share);
  /// Records the stroke as one undoable edit, if it changed the mask.
  void commit(Document& document);
  /// Restores the mask from before the stroke.
  void cancel(Document& document) const;

private:
  DocumentState before_;
  std::vector<float> shares_, covered_;
};

bool same_mask(const weights::Mask& a, const weights::Mask& b);
/// Sets the mask as an undoable edit. `mask` has one value per model vertex; null means 1 everywhere.
void set_mask(Document& document, weights::Mask mask, const char* label);
/// Returns the mask with each value s replaced by 1 - s.
weights::Mask inverted(const Document& document);

}  // namespace viete::document
