// Engines: from the rows of a pose to the model's vertices in the layout of a graphics card.
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

/// Owns the buffers of one bound model. Memory that grows with the model is allocated in the constructor, or
/// when a drag begins. Not thread-safe. Results are bit-identical for any number of threads.
class Engine {
public:
  virtual ~Engine() = default;
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Applies to the next frames. With a mask, or partial weights, the state must keep its origin.
  virtual void set_mask(const Mask& mask) = 0;
  /// Applies to the next frames: displacement of each vertex's shape from rest; empty: at rest. The span must
  /// outlive them.
  virtual void set_shape(std::span<const Vec3> ways) = 0;
  /// A layer after the rows for the next frames; null: none. Must fit the model and outlive the frames.
  void set_layer(ProbeLayer* layer) { layer_ = layer; }
  /// Computes one frame. The state must be of the cage, elements and blend that the engine was made for.
  virtual void run(const CageState& state, sym3::Method method) = 0;
  /// Vertices of the last frame, in the file's order, positions relative to its rows' origin; undefined
  /// before the first frame.
  virtual std::span<const FrameVertex> vertices() const = 0;
  /// Times of the last frame.
  const LinkTimes& times() const { return times_; }

protected:
  LinkTimes times_;
  ProbeLayer* layer_ = nullptr;
};

}  // namespace viete::deform
