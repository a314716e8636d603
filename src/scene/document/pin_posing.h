// Pins in the hand: the model follows by the shapes of the list, and further where these do not reach.
#pragma once

#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "deform/example_posing.h"
#include "deform/probe.h"
#include "scene/document/animation.h"
#include "scene/document/document.h"

namespace viete::scene {

/// Follows the pins of a document: when a hand has moved some, the shape of the model and the weights of the
/// poses that it is blended of go with them, a step a frame, until they rest. What time, a pose of the list
/// or undo puts there stays.
class PinPosing {
public:
  struct Hand {
    double freedom;  ///< see Handling
    bool holds;      ///< what it moves may go on
  };
  /// Once a frame, before the model is deformed. Says whether it has made a step. Throws base::Error where
  /// pins cannot be posed: then they are where the shape has their vertices.
  bool follow(Document& document, KnownVectors& vectors, const Hand& hand);
  /// True if the next call would go on.
  bool is_due() const { return steps_left_ > 0; }

private:
  struct Pins {
    std::vector<deform::Pin> pins;
    std::vector<mesh::Point> targets;

    friend bool operator==(const Pins&, const Pins&) = default;
  };
  static Pins pins_of(const Document& document);
  bool is_of_now(const Document& document) const;
  void begin(const Document& document, KnownVectors& known);
  void begin_here(const Document& document, KnownVectors& known);
  void step(Document& document, KnownVectors& known, const Hand& hand);
  void show(Document& document);

  std::shared_ptr<base::WorkerPool> pool_;
  std::shared_ptr<const deform::ShapeSpace> space_;
  std::vector<std::shared_ptr<const deform::LogVector>> vectors_;  // of the examples
  std::shared_ptr<deform::ExamplePosing> posing_;                  // null: it begins anew
  std::vector<SharedPose> examples_;                               // poses of the list, in its order
  std::vector<deform::Pin> set_;                                   // pins that it has
  SharedShape shown_;                                              // by the last step
  Pins seen_;
  Revision whole_ = 0;
  double freedom_ = 0;
  int steps_left_ = 0;
};

}  // namespace viete::scene
