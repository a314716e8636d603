// Posing by examples: finds a shape that moves given vertices to targets and is near a blend of examples.
// R. W. Sumner, M. Zwicker, C. Gotsman, J. Popovic, Mesh-based inverse kinematics, 2005.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "shapes/spaces.h"

namespace viete::shapes {

/// A vertex that is pulled to a target position.
struct PosingPin {
  std::uint32_t vertex;
  /// Strength of the pull: 1 is about the stiffness between neighbours, infinity makes a hard constraint.
  double firmness;

  friend bool operator==(const PosingPin&, const PosingPin&) = default;
};

/// Values of PosingPin::firmness: `holding` for a hard constraint, `usual_pull` for a soft constraint.
inline constexpr double holding = std::numeric_limits<double>::infinity(), usual_pull = 0.3;

/// The maximum number of pins. With more pins, solving the dense system would take minutes.
inline constexpr std::size_t most_pins = 1000;

struct PosingSettings {
  /// How strongly the weights w of the examples stay near their initial values w0, see ExamplePosing.
  double restraint = 1e-3;
  /// From 0 (triangles rotate as in the blend) to 1 (triangles rotate freely; ARAP if there are no examples).
  double freedom = 0.3;
};

/// Finds the examples' weights w, a global rotation G and positions x that minimize
///
///     sum_t area_t * |(grad x - G M_t(w)) T_t|^2 + sum_k c_k * |x_k - target_k|^2
///         + restraint * area * |w - w0|^2
///
/// M_t(w) is the blend of the maps of triangle t (see LogSpace), T_t the projection onto the plane of
/// triangle t, and c_k the firmness of pin k. Of the first sum, only the increase caused by the pins counts:
/// its minimum over x without pins is subtracted. Weights may be below 0 and above 1. Gauss-Newton steps with
/// exact derivatives find w and G. For each w and G, a small linear system for the pins gives the best x. In
/// a drag, one step per frame is enough. Not thread-safe. Results do not depend on the number of threads.
/// If the space has a coarse model, x are its vertices. Near parts move as one, see ShapeSpace::joined().
class ExamplePosing {
public:
  /// examples must be results of space.vector() without `before`. All arguments must outlive this object.
  ExamplePosing(const ShapeSpace& space, std::vector<const LogVector*> examples, base::WorkerPool& pool);
  ExamplePosing(const ExamplePosing&) = delete;

  /// Replaces the pins. Weights, rotation and positions do not change. Two pins must not have the same
  /// vertex. Takes some milliseconds per pin. Throws base::Error before any change if there are more than
  /// most_pins pins, if a vertex has no triangle with area, or if memory is insufficient.
  void set_pins(std::vector<PosingPin> pins);

  /// Returns one factor r per vertex. If the targets of these pins (indices) move by a vector d and all other
  /// targets stay, the vertex moves by r * d. The weights and the rotation are assumed to be constant.
  std::vector<double> reach(std::span<const std::size_t> pins) const;

  /// Makes one step towards the targets (one per pin). Returns the size of the step: the largest change of a
  /// weight, of the rotation in radians, or of a fitted position in units of sqrt(model area).
  double step(std::span<const mesh::Point> targets, const PosingSettings& settings);
  /// Makes steps until a step is smaller than 1e-5, up to `most` steps. Returns the number of steps. progress
  /// may be null. Throws base::Cancelled.
  int solve(std::span<const mesh::Point> targets, const PosingSettings& settings, int most,
            base::Progress* progress = nullptr);

  const std::vector<double>& weights() const { return weights_; }
  std::span<const mesh::Point> positions() const {
    return std::span(space_.coarse() ? model_positions_ : positions_).first(space_.rest().size());
  }
  /// Sets the weights and the rotation to 0, and the positions to rest.
  void restart();
  /// Restarts from the weights (one per example) and from `shape`, the blend of the examples. Later steps
  /// keep the weights near these initial values.
  void begin(std::vector<double> weights, std::span<const mesh::Point> shape);

private:
  struct Reach;
  struct Share {
    std::uint32_t vertex;
    double factor;
  };

  std::vector<LogTerm> terms() const;
  std::vector<Share> shares_of(std::uint32_t vertex) const;
  Vec3 at_pin(std::size_t pin, std::span<const Vec3> values) const;
  std::size_t blocks() const;
  std::size_t numbers_of_group() const { return 6 + 9 * examples_.size(); }
  void fill_groups();
  void fill_gradients();
  void fill_stiffness();
  void begin_turn();
  std::vector<double> sums_of_blocks(std::size_t begin, std::size_t end) const;
  Reach reach_of_pins() const;
  double advance(std::span<const mesh::Point> targets, const PosingSettings& settings);
  double show(const PosingSettings& settings);
  void aim();
  void follow_clusters(std::span<const LogTerm> sum);
  void move_model();
  void reach_targets();
  void place_other_parts();

  const std::optional<ShapeSpace> joined_;  // moves near parts as one; empty if there is only one part
  const ShapeSpace& space_;
  std::vector<LogVector> vectors_;  // the examples in joined_
  std::vector<const LogVector*> examples_;
  base::WorkerPool& pool_;
  std::vector<std::vector<Vec3>> leftovers_;  // per example: LogVector::leftovers without the whole turn
  base::AlignedVector<double> groups_;        // input of PlaneKernel::derive for all triangles
  double area_ = 0;

  std::vector<PosingPin> pins_;
  std::vector<std::vector<Share>> shares_;    // per pin, see shares_of()
  std::vector<std::vector<double>> columns_;  // per pin: a column of the inverse Laplacian, [vertex]
  // Triangle area * gradient of columns_, along the axes u and v: [block][pin][2][triangle].
  base::AlignedVector<double> gradients_;
  std::vector<std::uint32_t> part_of_pin_;
  std::vector<std::uint32_t> pinned_parts_;  // parts with pins, in ascending order
  // Matrix by rows: one column per pin, one row per pin, then one row per pinned part. Its product with the
  // vectors from pins to targets is the force at each pin, then the translation of each pinned part.
  std::vector<double> forces_;

  std::vector<double> weights_, usual_weights_;  // usual_weights_: the initial weights w0
  Vec3 turn_{0, 0, 0};
  std::vector<double> last_weights_;
  Vec3 last_turn_{0, 0, 0};
  std::vector<mesh::Point> given_, targets_;  // targets of the pinned vertices, and of their weighted sums
  double damping_ = 1e-3, energy_ = 0;        // energy_: the minimized energy after the last step
  bool turns_ = false;                        // true if turn_ is initialized
  LogSpace::Work work_;
  std::vector<mesh::Point> positions_, before_;  // of the log space's vertices
  std::vector<mesh::Point> model_positions_;     // of the model's vertices, if there is a coarse model
  std::vector<mesh::Point> posed_;  // positions_ before the last reach_targets(), which added moves_
  std::vector<Vec3> moves_;
  std::vector<Vec3> left_;  // blend of leftovers_, rotated by turn_
};

}  // namespace viete::shapes
