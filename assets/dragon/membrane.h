// The skin of a wing: a thin slab with a rounded edge over a plane figure, sagging between the bones.
#pragma once

#include <vector>

#include "dragon/field.h"

namespace viete::dragon {

/// A point in the plane of a wing: back along the body, out from the shoulder.
struct PlanePoint {
  double back, out;
};

/// The plane of a wing bent into shape: turns plane points into points in space.
struct WingFrame {
  Vec3 shoulder, back, out, normal;
  double camber;  ///< how strongly the plane bends down towards its rim, per squared length

  double bend(PlanePoint p) const { return -camber * (p.back * p.back + p.out * p.out); }
  Vec3 place(PlanePoint p) const { return shoulder + back * p.back + out * p.out + normal * bend(p); }
};

class Membrane : public Part {
public:
  /// outline: a closed polygon; bones: polylines between which the skin sags by sag at most.
  Membrane(const WingFrame& frame, std::vector<PlanePoint> outline,
           std::vector<std::vector<PlanePoint>> bones, double half_thickness, double sag);

  double distance(Vec3 p) const override;
  Box box() const override;

private:
  WingFrame frame_;
  std::vector<PlanePoint> outline_;
  std::vector<std::vector<PlanePoint>> bones_;
  double half_thickness_, sag_;
};

/// Points along the quadratic Bezier curve a, control, b; without the last one.
void append_arc(std::vector<PlanePoint>& points, PlanePoint a, PlanePoint control, PlanePoint b, int steps);

}  // namespace viete::dragon
