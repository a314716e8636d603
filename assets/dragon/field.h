// The dragon as an implicit surface: parts joined by smooth unions and carvings; negative inside.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dragon/vec3.h"

namespace viete::dragon {

/// A solid given by its (approximate) signed distance, negative inside.
class Part {
public:
  virtual ~Part() = default;
  virtual double distance(Vec3 p) const = 0;
  virtual Box box() const = 0;
};

class Field {
public:
  /// Joins a part to what is there already; the joint is rounded over the length blend.
  void join(std::unique_ptr<Part> part, double blend);
  /// Takes a part away from what is there already; the rim is rounded over the length blend.
  void carve(std::unique_ptr<Part> part, double blend);

  Box box() const;
  /// The parts that can matter, near the surface, within radius of p.
  std::vector<int> near(Vec3 p, double radius) const;
  /// The field at p; right near the surface if parts came from near().
  double value(Vec3 p, std::span<const int> parts) const;
  /// The gradient by central differences over the given step.
  Vec3 gradient(Vec3 p, std::span<const int> parts, double step) const;

private:
  struct Entry {
    std::unique_ptr<Part> part;
    double blend;
    bool carves;
    Box box;
  };
  void add(std::unique_ptr<Part> part, double blend, bool carves);

  std::vector<Entry> entries_;
};

}  // namespace viete::dragon
