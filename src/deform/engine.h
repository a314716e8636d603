// Who forms the sums: from the rows of a pose to the model's vertices as a graphics card takes them.
#pragma once

#include <span>
#include <vector>

#include "deform/binding.h"
#include "deform/cage_state.h"
#include "deform/frame_vertex.h"
#include "deform/links.h"
#include "deform/probe_layer.h"
#include "sym3/exp.h"

namespace viete::deform {

/// Owns the buffers of one bound model. Everything that grows with the model is allocated in the constructor,
/// or when a drag begins. Not thread-safe. Results are bit-identical for any number of threads.
class Engine {
public:
  virtual ~Engine() = default;
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Of the next frames. The state must keep its origin if there is one, or weights are partial.
  virtual void set_mask(const Mask& mask) = 0;
  /// Of the next frames: how far the shape of each vertex is from rest, one way each; empty: at rest. Must
  /// outlive them.
  virtual void set_shape(std::span<const Vec3> ways) = 0;
  /// Of the next frames, upon what the rows do; null: none. Of the same model, and outlives its frames.
  void set_layer(ProbeLayer* layer) { layer_ = layer; }
  /// One frame. The state must be of the cage, the elements and the blend that the engine was made for.
  virtual void run(const CageState& state, sym3::Method method) = 0;
  /// Of the last frame, in the file's order, positions relative to its rows' origin; before the first one
  /// of no use.
  virtual std::span<const FrameVertex> vertices() const = 0;
  /// Of the last frame.
  const LinkTimes& times() const { return times_; }

protected:
  LinkTimes times_;
  ProbeLayer* layer_ = nullptr;
};

}  // namespace viete::deform
