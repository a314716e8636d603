// Posing by examples: finds the shape near blends of examples that moves given vertices to given targets (R.
// W. Sumner, M. Zwicker, C. Gotsman, J. Popovic, Mesh-based inverse kinematics, 2005).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/shape_space.h"

namespace viete::deform {

/// A vertex with a target position.
struct PosingPin {
  std::uint32_t vertex;
  /// Strength of the pull. About 1 equals the stiffness between neighbours; infinity is a hard constraint.
  double firmness;

  friend bool operator==(const PosingPin&, const PosingPin&) = default;
};

/// Firmness of a hard constraint, and of a pull about as strong as that between neighbours.
inline constexpr double holding = std::numeric_limits<double>::infinity(), usual_pull = 0.3;

/// Limit of the size of the dense system; larger ones take minutes.
inline constexpr std::size_t most_pins = 1000;

struct PosingSettings {
  /// How strongly the examples' weights are kept near 0, or near their initial values, relative to the
  /// elastic energy of one unit of the model's area.
  double restraint = 1e-3;
  /// Freedom of triangles to rotate off the blend of examples, 0 to 1. Without examples 1 is ARAP.
  double freedom = 0.3;
};

/// Example weights w, also below 0 and above 1, a global rotation G, and positions x minimise
///
///     sum_t area_t |(grad x - G M_t(w)) T_t|^2 + sum_k c_k |x_k - target_k|^2 + restraint area |w - w0|^2
///
/// without the part of the first sum that does not depend on the pins. M_t(w) is the blend in log space (see
/// LogSpace). x is eliminated by the pins' columns of the inverse Laplacian; w and G are found by
/// Gauss-Newton steps with exact derivatives of both exponentials. One step per frame is fast enough for
/// interactive dragging. Not thread-safe; the same bits for any number of threads.
class ExamplePosing {
public:
  /// Examples must be vectors of the space, made without `before`. Space, vectors and pool must outlive this.
  ExamplePosing(const ShapeSpace& space, std::vector<const LogVector*> examples, base::WorkerPool& pool);

  /// Replaces the pins, at most most_pins, each vertex once; weights, rotation and positions stay. Some
  /// milliseconds per pin. Throws base::Error, before any change, if there are too many pins, a vertex has no
  /// triangle with area, or memory is short.
  void set_pins(std::vector<PosingPin> pins);

  /// Displacement of each vertex relative to that of these pins (by number) when their targets move slightly
  /// and those of the other pins stay, without changes of weights and rotation. 1 if a whole part moves
  /// along.
  std::vector<double> reach(std::span<const std::size_t> pins) const;

  /// One step towards the targets, one per pin. Returns its size: the largest change of weights, rotation
  /// (radians) and fitted positions (relative to the square root of the area).
  double step(std::span<const mesh::Point> targets, const PosingSettings& settings);
  /// Steps until they are shorter than 1e-5, at most `most` times. Returns the number of steps. progress may
  /// be null. Throws base::Cancelled.
  int solve(std::span<const mesh::Point> targets, const PosingSettings& settings, int most,
            base::Progress* progress = nullptr);

  const std::vector<double>& weights() const { return weights_; }
  std::span<const mesh::Point> positions() const { return positions_; }
  /// Resets weights and rotation.
  void restart();
  /// Restarts from the shape that these weights (one per example) blend; weights are kept near them.
  void begin(std::vector<double> weights, std::span<const mesh::Point> shape);

private:
  struct Reach;

  std::vector<LogTerm> terms() const;
  std::size_t blocks() const;
  std::size_t numbers_of_group() const { return 6 + 9 * examples_.size(); }
  void fill_groups();
  void fill_gradients();
  void fill_stiffness();
  void begin_turn(std::span<const mesh::Point> targets);
  std::vector<double> sums_of_blocks(std::size_t begin, std::size_t end) const;
  Reach reach_of_pins() const;
  double show(const PosingSettings& settings);
  void reach_targets();
  void place_other_parts();

  const ShapeSpace& space_;
  std::vector<const LogVector*> examples_;
  base::WorkerPool& pool_;
  std::vector<std::vector<Vec3>> leftovers_;  // leftovers of the examples, before the whole turns
  base::AlignedVector<double> groups_;        // per-triangle input of PlaneKernel::derive
  double area_ = 0;

  std::vector<PosingPin> pins_;
  std::vector<std::vector<double>> columns_;  // columns of the inverse Laplacian, one per pin, [vertex]
  base::AlignedVector<double>
      gradients_;  // gradients of columns_, by area, along u and v: [block][pin][2][triangle]
  std::vector<std::uint32_t> part_of_pin_;
  std::vector<std::uint32_t> pinned_parts_;  // ascending
  std::vector<double> forces_;  // [pin, then pinned part][pin]: from distances of pins to forces at them, and
                                // displacements of parts

  std::vector<double> weights_, usual_weights_;  // current, and the values that they are kept near to
  Vec3 turn_{0, 0, 0};
  std::vector<double> last_weights_;
  Vec3 last_turn_{0, 0, 0};
  std::vector<mesh::Point> targets_;
  double damping_ = 1e-3, energy_ = 0;  // energy: of the targets and the pulls
  bool turns_ = false;                  // turn_ is initialised
  LogSpace::Work work_;
  std::vector<mesh::Point> positions_, before_;
  std::vector<Vec3> left_;  // leftovers of the blend, rotated
};

}  // namespace viete::deform
