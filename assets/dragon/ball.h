// A ball: eyes, sockets, nostrils.
#pragma once

#include "dragon/field.h"

namespace viete::dragon {

class Ball : public Part {
public:
  Ball(Vec3 center, double radius) : center_(center), radius_(radius) {}

  double distance(Vec3 p) const override { return length(p - center_) - radius_; }
  Box box() const override {
    Box box;
    box.add(center_, radius_);
    return box;
  }

private:
  Vec3 center_;
  double radius_;
};

}  // namespace viete::dragon
