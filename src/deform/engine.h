// Engines compute the model's vertices, in the graphics card's layout, from the rows of a pose.
#pragma once

#include <span>

#include "deform/probe_layer.h"
#include "pose/cage_state.h"
#include "pose/stages.h"
#include "sym3/exp.h"
#include "weights/binding.h"

namespace viete::deform {

using mesh::Vec3;

/// Owns the buffers of one bound model. Large buffers are allocated in the constructor, or when a drag
/// begins. Not thread-safe. Results do not depend on the number of threads.
class Engine {
public:
  virtual ~Engine() = default;
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// All setters apply to the next frames. If there is a mask or weights are partial, call
  /// CageState::keep_origin(true).
  virtual void set_mask(const weights::Mask& mask) = 0;
  /// `displacements`: displacement of each vertex from rest to the shape; empty if all are 0. Must stay valid
  /// until the next call.
  virtual void set_shape(std::span<const Vec3> displacements) = 0;
  /// `layer`: probes that move the model after the cage, or null.
  void set_layer(ProbeLayer* layer) { layer_ = layer; }
  /// Computes one frame. The state must have the cage, elements and blend that the engine was made for.
  virtual void run(const pose::CageState& state, sym3::Method method) = 0;
  /// Vertices of the last frame in file order, relative to Rows::origin. Undefined before the first frame.
  virtual std::span<const pose::FrameVertex> vertices() const = 0;
  const pose::StageTimes& times() const { return times_; }

protected:
  pose::StageTimes times_;
  ProbeLayer* layer_ = nullptr;
};

}  // namespace viete::deform
