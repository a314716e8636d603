// Computes frames step by step, in double precision, so that each step can be timed and compared.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/engine.h"
#include "pose/cage_state.h"
#include "sym3/exp.h"
#include "weights/binding.h"

namespace viete::deform {

/// Computes sums[vertex][column] = weights * rows for the vertices [begin, end), then calls apply_shares().
/// `sums` must have its final size. Results do not depend on the ranges.
void blend(const weights::VertexBlock& block, const pose::Rows& rows, std::size_t begin, std::size_t end,
           std::span<double> sums);
/// Multiplies sums by the shares of the vertices. Adds (1 - share) * rest position to the sums of centres.
void apply_shares(const weights::VertexBlock& block, pose::RowForm form, std::size_t begin, std::size_t end,
                  std::span<double> sums);

/// Copies the logs of stretches of the vertices [begin, end) from sums of RowForm::logs.
void stretch_logs(std::span<const double> sums, std::size_t begin, std::size_t end,
                  std::span<sym3::Sym3<double>> logs);

/// Computes positions of the vertices [begin, end) from sums of any form except moments. For RowForm::logs, a
/// position is origin + (exp(Y) * exp(X) * o + c'), with exp(X) from `stretches`. Symbols: see RowForm.
void apply(const weights::VertexBlock& block, pose::RowForm form, std::span<const double> sums,
           std::span<const sym3::Sym3<double>> stretches, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions);

/// Runs the steps exp and apply for all vertices, given their sums. If `error` is true, returns the largest
/// relative difference of the exponentials, as apply_to_vertices() does; otherwise returns 0.
double apply_sums(const weights::VertexBlock& block, pose::RowForm form, std::span<const double> sums,
                  const Vec3& origin, sym3::Method method, std::span<mesh::Point> positions,
                  bool error = false);

/// Runs the steps blend, exp and apply for all vertices. `positions` has one entry per vertex. If `sums` is
/// not empty and the form has no moments, writes the result of blend() to `sums`. Returns the largest
/// relative difference (Frobenius norm) between the exponentials of `method` and of `fast`; `fast` is exact
/// to 1e-15. Returns infinity for NaN, and 0 for `fast` or without exponentials.
double apply_to_vertices(const weights::VertexBlock& block, const pose::Rows& rows, sym3::Method method,
                         std::span<mesh::Point> positions, std::span<double> sums = {});

class StagedEngine : public Engine {
public:
  /// `binding` must have the members for the staged engine, see Binding.
  StagedEngine(std::shared_ptr<const weights::Binding> binding, pose::RowForm form, base::WorkerPool& pool);

  void set_mask(const weights::Mask& mask) override {
    shares_ = weights::product(binding_->shares, weights::values(mask));
  }
  void set_shape(std::span<const Vec3> displacements) override { displacements_ = displacements; }
  void run(const pose::CageState& state, sym3::Method method) override;
  std::span<const pose::FrameVertex> vertices() const override { return vertices_; }
  /// Positions of the last frame, in double precision.
  std::span<const mesh::Point> positions() const { return positions_; }
  std::span<const mesh::Point> normals() const { return normals_; }
  /// The matrices that the last frame exponentiated; empty if there were none.
  std::span<const sym3::Sym3<double>> matrices() const { return logs_; }

private:
  template <class Body>
  void run_stage(pose::Stage stage, const Body& body);

  std::shared_ptr<const weights::Binding> binding_;
  base::WorkerPool& pool_;
  weights::Shares shares_;
  std::span<const Vec3> displacements_;               // displacements of the shape
  std::vector<double> sums_;                          // [vertex][column]; empty for moment forms
  std::vector<sym3::Sym3<double>> logs_, stretches_;  // for forms with stretches
  std::vector<mesh::Point> positions_, normals_;
  std::vector<pose::FrameVertex> vertices_;
};

}  // namespace viete::deform
