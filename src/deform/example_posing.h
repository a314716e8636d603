// Posing by examples: the shape among blends of examples, and near them, that brings given vertices to given
// places (R. W. Sumner, M. Zwicker, C. Gotsman, J. Popovic, Mesh-based inverse kinematics, 2005).
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

/// A vertex that is brought to a place.
struct PosingPin {
  std::uint32_t vertex;
  /// Beside a stiffness of about 1 between neighbours: how much it pulls; infinite: it holds.
  double firmness;

  friend bool operator==(const PosingPin&, const PosingPin&) = default;
};

/// What holds, and what pulls about as strongly as neighbours do.
inline constexpr double holding = std::numeric_limits<double>::infinity(), usual_pull = 0.3;

/// As many equations are solved at once, which takes minutes beyond.
inline constexpr std::size_t most_pins = 1000;

struct PosingSettings {
  /// Beside the elastic energy of a unit of the model's area: how near weights of examples stay to 0, or to
  /// those that it began with.
  double restraint = 1e-3;
  /// How freely triangles turn off the blend of examples, 0 to 1. Without examples 1 is as rigid as possible.
  double freedom = 0.3;
};

/// Weights w of examples, beyond 0 and 1 too, a turn G of the whole, and positions x minimise
///
///     sum_t area_t |(grad x - G M_t(w)) T_t|^2 + sum_k c_k |x_k - target_k|^2 + restraint area |w - w0|^2
///
/// but for what of the first sum does not depend on the pins: M_t(w) is the blend in log space (see
/// LogSpace). x is eliminated through the columns of the inverse Laplacian that belong to the pins; the rest
/// is Gauss-Newton's method over w and G with the exact derivatives of both exponentials. One step a frame is
/// meant to be shown while a hand moves. Not thread-safe; the same bits for any number of threads.
class ExamplePosing {
public:
  /// Vectors are of the space, without keys before; both outlive this, and so does the pool.
  ExamplePosing(const ShapeSpace& space, std::vector<const LogVector*> examples, base::WorkerPool& pool);

  /// Other ones, most_pins at most; weights, turn and positions stay. Each vertex once. Some milliseconds a
  /// pin. Throws base::Error, before anything changes, where there are more, a vertex is of no triangle with
  /// area, or memory is short.
  void set_pins(std::vector<PosingPin> pins);

  /// How far each vertex goes, over their way, when the targets of these pins (by number) go one small way
  /// and those of the others stay, but for what examples and turns would do. 1 where all of a part goes
  /// along.
  std::vector<double> reach(std::span<const std::size_t> pins) const;

  /// One step towards the targets, one a pin. Returns how far it went: the most of weights, turn (radians)
  /// and fitted positions (in sides of a square of the area).
  double step(std::span<const mesh::Point> targets, const PosingSettings& settings);
  /// Steps until they are shorter than 1e-5, `most` at most. Returns how many.
  /// progress may be null. Throws base::Cancelled.
  int solve(std::span<const mesh::Point> targets, const PosingSettings& settings, int most,
            base::Progress* progress = nullptr);

  const std::vector<double>& weights() const { return weights_; }
  std::span<const mesh::Point> positions() const { return positions_; }
  /// The weighted distances from the targets, squared, and the elastic energy that it takes to be no farther.
  double energy() const { return energy_; }
  /// Where examples, weights and turn begin anew.
  void restart();
  /// The same at a shape that these weights, one an example, blend: they are what weights stay near to.
  void begin(std::vector<double> weights, std::span<const mesh::Point> shape);

private:
  class Derivatives;

  struct Reach;

  std::vector<LogTerm> terms() const;
  std::size_t blocks() const;
  std::size_t numbers_of_group() const { return 6 + 9 * examples_.size(); }
  void fill_groups();
  void fill_gradients();
  void fill_stiffness();
  void begin_turn(std::span<const mesh::Point> targets);
  Reach reach_of_pins() const;
  double show(const PosingSettings& settings);
  void reach_targets();
  void place_other_parts();

  const ShapeSpace& space_;
  std::vector<const LogVector*> examples_;
  base::WorkerPool& pool_;
  std::vector<std::vector<Vec3>> leftovers_;  // of the examples, as they are before the whole turns
  base::AlignedVector<double> groups_;        // of triangles: see PlaneKernel::derive
  double area_ = 0;

  std::vector<PosingPin> pins_;
  std::vector<std::vector<double>> columns_;  // of the inverse Laplacian, one a pin, [vertex]
  base::AlignedVector<double> gradients_;     // of these, by area, along u and v: [block][pin][2][triangle]
  std::vector<std::uint32_t> part_of_pin_;
  std::vector<std::uint32_t> pinned_parts_;  // ascending
  std::vector<double> forces_;  // [pin, then pinned part][pin]: from how far pins are off to forces at them,
                                // and ways of parts

  std::vector<double> weights_, usual_weights_;  // those of the pose, and which they stay near to
  Vec3 turn_{0, 0, 0};
  std::vector<double> last_weights_;
  Vec3 last_turn_{0, 0, 0};
  std::vector<mesh::Point> targets_;
  double damping_ = 1e-3, energy_ = 0;
  bool turns_ = false;  // turn_ is begun
  LogSpace::Work work_;
  std::vector<mesh::Point> positions_, before_;
  std::vector<Vec3> left_;  // the blend's leftovers, turned
};

}  // namespace viete::deform
