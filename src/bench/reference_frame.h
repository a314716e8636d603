// A frame as published tools compute it, rebuilt plainly: what the engine is compared with.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/binding.h"

namespace viete::bench {

/// Per element: map, polar decomposition by SVD, logs of stretch and rotation, the rotation's principal one:
/// for poses whose elements turn by less than 180 degrees and keep their area. Per vertex: whole matrices
/// summed with weights in double (9 + 9 + 3 numbers a cage triangle), improved SD, Rodrigues' formula, the
/// affine product; normals scattered from triangles. Buffers are allocated once.
class ReferenceFrame {
public:
  /// cage and binding are kept by reference; the binding has weights.
  ReferenceFrame(const deform::Cage& cage, const deform::Binding& binding);

  void deform(const deform::Pose& pose);

  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }

private:
  using Matrix = std::array<std::array<double, 3>, 3>;
  struct Handle {
    Matrix stretch, rotation;  ///< logs
    std::array<double, 3> center;
  };
  void log_cage(const deform::Pose& pose);
  mesh::Point place(std::size_t vertex) const;
  void scatter_normals();

  const deform::Cage& cage_;
  const deform::Binding& binding_;
  std::vector<Handle> handles_;
  std::vector<mesh::Point> positions_, normals_;
};

}  // namespace viete::bench
