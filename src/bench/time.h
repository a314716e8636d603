// viete bench time: what log space keeps between keys that a straight line loses, and what it costs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "deform/cage.h"
#include "scene/document/timeline.h"

namespace viete::bench {

struct TimeOptions {
  std::filesystem::path session;  ///< with keys
  std::size_t rounds = 11;
  std::filesystem::path json;  ///< the numbers go here too; empty: nowhere
};

/// A bar of a thousand vertices along z, 1 wide and 4 long, in a cage like it; and what two keys do to it.
struct Bar {
  mesh::Surface model;
  std::shared_ptr<const deform::Cage> cage;

  Bar();
  /// From rest to all of it turned by 180 degrees about an axis across.
  scene::Timeline turned() const;
  /// From rest to one end twisted by 180 degrees against the other.
  scene::Timeline twisted() const;
};

/// The model's volume over that at rest, along the way from the first key to the last one.
struct Volumes {
  double least = 1, most = 1;
  double first = 1, last = 1;  ///< at these keys

  /// Of rest, the farthest from it.
  double deviation() const;
  /// How far the way falls below the smaller of both keys, as a share of that.
  double loss() const;
};
/// At `steps` even steps, in double or by the engine of method `fast`. Throws base::Error.
Volumes volumes_between_keys(const mesh::Surface& model, const std::shared_ptr<const deform::Cage>& cage,
                             const scene::Timeline& timeline, bool straight, int steps,
                             bool in_double = true);

/// Prints the tables. Throws base::Error.
void bench_time(const TimeOptions& options);

}  // namespace viete::bench
