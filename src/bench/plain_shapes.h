// The reference of shapes in log space: one triangle after the other, with Eigen, in double.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "deform/shape_space.h"
#include "mesh/surface.h"

namespace viete::bench {

/// What deform::ShapeSpace computes, as published tools do: exponentials and logs of symmetric matrices by
/// QR, rotations by angle and axis, nearest rotations by singular values, a general sparse solver, a column
/// at a time. One thread.
class PlainShapes {
public:
  /// Of the space's mesh. The space and the mesh outlive it.
  PlainShapes(const deform::ShapeSpace& space, const mesh::Surface& rest);
  ~PlainShapes();

  /// The shape of a sum, and its normals.
  void shape(std::span<const deform::LogTerm> terms, const deform::Held& held);
  const std::vector<mesh::Point>& positions() const;
  /// A shape as a vector: branches follow the tree of least relative rotations from triangle 0 on. It has no
  /// doubts.
  deform::LogVector vector(std::span<const mesh::Point> positions);

private:
  friend class PlainPosing;
  class Loops;
  std::unique_ptr<Loops> loops_;
};

/// What deform::ExamplePosing computes, in such loops: derivatives of exponentials by divided differences of
/// the eigenvalues (Y. Daleckii, S. Krein, 1965). Of a model of one part, vertices that hold.
class PlainPosing {
public:
  /// All outlive it.
  PlainPosing(PlainShapes& shapes, std::vector<const deform::LogVector*> examples,
              std::vector<std::uint32_t> vertices);
  ~PlainPosing();

  /// A step of Gauss-Newton's method, and what it shows.
  void step(std::span<const mesh::Point> targets);
  const std::vector<mesh::Point>& positions() const;

private:
  class Steps;
  std::unique_ptr<Steps> steps_;
};

}  // namespace viete::bench
