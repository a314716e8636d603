// Sizes, rotations and colours of Gaussian splats that follow a deformation.
//
// A deformation with the derivative F changes the covariance C of a splat to F C F^T. The derivative of
// blended maps is not the blended map, because the weights change from place to place. Therefore each splat
// has three tips: points at a small distance along x, y and z, which every deformer moves like further
// vertices of the model. Differences between tips and splat give F. The covariance is never formed: sizes and
// rotation come from the singular values of F R S, where R and S are the rotation and the deviations at rest.
// Colours turn with the rotation of F.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/splats.h"
#include "mesh/surface.h"
#include "pose/cage.h"
#include "pose/rows.h"
#include "weights/binding.h"

namespace viete::deform {

/// The distance of tips relative to the cage's diagonal. In float, rounding and compression of the weights
/// are larger for short distances; in double, the second derivative is.
inline constexpr double tip_in_float = 1e-3, tip_in_double = 1e-5;

/// Returns `distance` times the diagonal of the cage or, without a cage, of the model.
double tip_step(const mesh::Surface& model, const pose::Cage& cage, double distance);

/// Returns the n vertices of a model without polygons, and their tips: vertex i has the tips n + i, 2 n + i
/// and 3 n + i.
mesh::Surface with_tips(const mesh::Surface& model, double step);
/// Return values for vertices and tips; null for null. A tip has the value or the displacement of its vertex.
weights::Mask with_tips(const weights::Mask& mask);
weights::SharedShape with_tips(const weights::SharedShape& shape, double step);

/// Returns the posed splats. `positions`: n vertices and their tips, posed. Splats whose derivative is the
/// identity up to 1e-9 keep all bits, and also splats whose sizes, quaternion or derivative are not finite or
/// are zero.
mesh::Splats posed_splats(const mesh::Splats& splats, std::span<const mesh::Point> positions, double step,
                          base::WorkerPool& pool);

/// A capture in which stretched splats are split.
struct SplitSplats {
  std::vector<mesh::Point> positions;
  mesh::Splats splats;
  std::vector<std::uint32_t> sources;  ///< the splat of the original from which each splat is made
  std::size_t split = 0;               ///< number of splats that were split
};

/// Splits each splat whose longest axis has grown by a factor above 2.5 into two parts along this axis, and
/// above 4 into three. The covariance of the parts together, and the opacity in their middle, are those of
/// the splat; the middle of two parts has at most 0.9. Parts follow their splat. `positions`: those of
/// `posed`.
SplitSplats split_stretched(const mesh::Splats& rest, const mesh::Splats& posed,
                            std::span<const mesh::Point> positions);

/// The matrix F R S of a splat, row by row; the covariance is this matrix times its transpose.
using SplatShape = std::array<float, 9>;
/// Returns the shapes at rest, R S. Quaternions of length 0 are no rotation.
std::vector<SplatShape> rest_shapes(const mesh::Splats& splats);

/// The splats of a frame, for drawing. Not thread-safe.
class SplatFrame {
public:
  using Shape = SplatShape;
  using Turn = std::array<float, 4>;  ///< a unit quaternion w, x, y, z

  /// `splats` must not be null.
  explicit SplatFrame(std::shared_ptr<const mesh::Splats> splats);

  /// `vertices`: n vertices and their tips, posed.
  void run(std::span<const pose::FrameVertex> vertices, double step, base::WorkerPool& pool);
  std::span<const Shape> shapes() const { return shapes_; }
  /// The rotations of the colours; empty if colours do not depend on the direction.
  std::span<const Turn> turns() const { return turns_; }

private:
  void run_block(std::span<const pose::FrameVertex> vertices, float inverse_step, std::size_t begin,
                 std::size_t end);

  std::vector<Shape> rest_, shapes_;  // R S, and F R S
  std::vector<Turn> turns_;
};

}  // namespace viete::deform
