// Painting the model's mask: how much each vertex follows the cage.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "deform/rows.h"
#include "document/camera.h"
#include "document/document.h"

namespace viete::document {

/// Settings of the mask brush.
struct Brush {
  static constexpr float least_radius = 4, largest_radius = 400;

  float radius = 40;  ///< logical pixels
  float share = 0;    ///< mask value at full strength, 0 to 1: the share of its motion a vertex keeps
};

/// The last deformed model, in the layout for the GPU; no vertices: the model is at rest.
struct PosedModel {
  std::span<const deform::FrameVertex> vertices{};
  mesh::Point origin{0, 0, 0};
  unsigned long frame = 0;  ///< changes whenever the vertices may have changed

  mesh::Point at(const mesh::Surface& model, std::size_t vertex) const;
};

/// The first intersection of the ray with the posed model, in file coordinates; nullopt: no hit. O(n).
std::optional<mesh::Point> pick_model(const Document& document, const PosedModel& posed, const Ray& ray);

/// A point attached to the model: a triangle and barycentric coordinates.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> shares{};
};

/// As pick_model(), as a point attached to the surface.
std::optional<SurfacePoint> pick_triangle(const Document& document, const PosedModel& posed, const Ray& ray);

/// Masks are quantized to steps of 1/255, as in session files.
inline constexpr int mask_steps = 255;

/// One stroke, from button press to release; painting a vertex twice within a stroke has no further effect.
class MaskStroke {
public:
  explicit MaskStroke(const Document& document);

  /// Sets the mask to `share` within half the radius of the center; the effect falls off to 0 at the radius.
  /// Updates the document at once.
  void dab(Document& document, const PosedModel& posed, const mesh::Point& center, double radius,
           float share);
  /// Records the stroke as one undoable edit, unless it painted nothing.
  void commit(Document& document);
  /// Restores the mask from before the stroke.
  void cancel(Document& document) const;

private:
  DocumentState before_;
  std::vector<float> shares_, covered_;
};

bool same_mask(const deform::Mask& a, const deform::Mask& b);
/// Sets the mask, or null if every share is 1, as an edit. mask: one share per model vertex, or empty.
void set_mask(Document& document, deform::Mask mask, const char* label);
/// Each share s becomes 1 - s.
deform::Mask inverted(const Document& document);

}  // namespace viete::document
