// The chain link by link, in double, so that each can be timed and compared.
#pragma once

#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "deform/apply.h"
#include "deform/binding.h"
#include "deform/engine.h"

namespace viete::deform {

class StagedEngine : public Engine {
public:
  /// binding must have the weights of the staged frame.
  StagedEngine(std::shared_ptr<const Binding> binding, RowForm form, base::WorkerPool& pool);

  void set_mask(const Mask& mask) override { shares_ = product(binding_->shares, mask); }
  void set_shape(std::span<const Vec3> ways) override;
  void run(const CageState& state, sym3::Method method) override;
  std::span<const FrameVertex> vertices() const override { return vertices_; }
  /// Of the last frame, in double.
  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }
  /// Of which the last frame took exponentials; empty if it took none.
  std::span<const sym3::Sym3<double>> matrices() const { return logs_; }

private:
  template <class Body>
  void for_vertices(const Body& body);
  const Binding& places() const { return ways_.empty() ? *binding_ : shaped_; }
  void blend_rows(const Rows& rows, sym3::Method method);
  void fit(const Rows& rows);
  void move_by_probes(sym3::Method method);
  void finish(const Vec3& origin);

  std::shared_ptr<const Binding> binding_;
  base::WorkerPool& pool_;
  Shares shares_;
  std::span<const Vec3> ways_;                        // of the shape
  Binding shaped_;                                    // with these, without weights
  std::vector<double> sums_;                          // [vertex][column], of forms without moments
  std::vector<sym3::Sym3<double>> logs_, stretches_;  // of forms that have them
  std::vector<mesh::Point> positions_, normals_;
  std::vector<FrameVertex> vertices_;
};

}  // namespace viete::deform
