// Pin posing: the model follows dragged pins by blending the listed shapes, and beyond their range deforms.
#pragma once

#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "deform/example_posing.h"
#include "deform/probe.h"
#include "document/animation.h"
#include "document/document.h"

namespace viete::document {

/// Follows a document's pins: after pins were moved, solves for the model's shape and the weights of its
/// example poses, one step per frame, until they converge. Leaves a pose alone that was set by the timeline,
/// the pose list or undo.
class PinPosing {
public:
  struct Hand {
    double freedom;  ///< see Handling
    bool holds;      ///< the drag is still running
  };
  /// Call once per frame, before the model is deformed. Returns true after a step. Throws base::Error if the
  /// pins cannot be posed; the pins are then back at their vertices in the shape.
  bool follow(Document& document, VectorCache& vectors, const Hand& hand);
  /// True if the next call would make a step.
  bool is_due() const { return steps_left_ > 0; }

private:
  struct Pins {
    std::vector<deform::Pin> pins;
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
  std::shared_ptr<const deform::ShapeSpace> space_;
  std::vector<std::shared_ptr<const deform::LogVector>> vectors_;  // one per example
  std::shared_ptr<deform::ExamplePosing> posing_;                  // null: starts from the beginning
  std::vector<SharedPose> examples_;                               // poses of the list, in its order
  std::vector<deform::Pin> set_;                                   // pins that posing_ has
  SharedShape shown_;                                              // result of the last step
  Pins seen_;
  Revision whole_ = 0;
  double freedom_ = 0;
  int steps_left_ = 0;
};

}  // namespace viete::document
