// Pin posing: deforms the model so that it follows dragged pins. The shapes in the pose list are examples.
#pragma once

#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "document/animation.h"
#include "document/document.h"
#include "pose/probe.h"
#include "shapes/example_posing.h"

namespace viete::document {

/// After pins moved, solves for the model's shape and the weights of the example poses. Makes one step per
/// drawn picture, until the shape converges. Does not change a pose from the timeline, the pose list or undo.
class PinPosing {
public:
  struct Hand {
    double freedom;  ///< see Handling::freedom
    bool holds;      ///< true while the user drags
  };
  /// Call this once per drawn picture, before the model is deformed. Returns true if it made a step. If
  /// posing fails, moves the pins back to their vertices in the shape and throws base::Error.
  bool follow(Document& document, VectorCache& vectors, const Hand& hand);
  /// True if another step is needed.
  bool is_due() const { return steps_left_ > 0; }

private:
  struct Pins {
    std::vector<pose::Pin> pins;
    std::vector<mesh::Point> targets;

    friend bool operator==(const Pins&, const Pins&) = default;
  };
  static Pins pins_of(const Document& document);
  bool is_current(const Document& document) const;
  void begin(const Document& document, VectorCache& known);
  void begin_here(const Document& document, VectorCache& known);
  void step(Document& document, VectorCache& known, const Hand& hand);
  void show(Document& document);

  std::shared_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const shapes::ShapeSpace> space_;
  std::vector<std::shared_ptr<const shapes::LogVector>> vectors_;
  std::shared_ptr<shapes::ExamplePosing> posing_;  // null before the first step
  std::vector<SharedPose> examples_;
  std::vector<pose::Pin> set_;  // the pins of posing_
  SharedShape shown_;           // the result of the last step
  Pins seen_;
  Revision whole_ = 0;
  double freedom_ = 0;
  int steps_left_ = 0;
};

}  // namespace viete::document
