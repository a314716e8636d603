#include "bench/stitched.h"

#include <Eigen/SparseCholesky>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/quantity.h"
#include "base/worker_pool.h"
#include "bench/bars.h"
#include "bench/models.h"
#include "bench/solvers.h"
#include "bench/table.h"
#include "bench/timing/rounds.h"
#include "deform/bind.h"
#include "deform/blend.h"
#include "deform/deformer.h"
#include "deform/laplacian.h"
#include "deform/pose_io.h"
#include "deform/stitching.h"
#include "mesh/normals.h"

namespace viete::bench {

namespace {

using deform::Vec3;

Vec3 times(const sym3::Mat3<double>& m, const Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

Vec3 times(const sym3::Sym3<double>& s, const Vec3& x) {
  return {s.xx * x[0] + s.xy * x[1] + s.xz * x[2], s.xy * x[0] + s.yy * x[1] + s.yz * x[2],
          s.xz * x[0] + s.yz * x[1] + s.zz * x[2]};
}

/// What stitch() factors of a model of one part.
deform::SparseMatrix system_of(const mesh::Surface& model, const deform::Stitching& stitching) {
  deform::SparseMatrix k = deform::stiffness_matrix(model.positions, model.triangles);
  const auto add = [&](std::uint32_t vertex, double weight) {
    for (auto i = k.starts[vertex]; i < k.starts[vertex + 1]; ++i)
      k.values[i] += k.rows[i] == int(vertex) ? weight : 0;
  };
  for (const auto& pin : stitching.pins) add(pin.vertex, pin.weight);
  for (const auto& hold : stitching.holds) add(hold.vertex, hold.weight);
  return k;
}

/// The same system as published tools solve it: maps blended by weights of each triangle's centre, one thing
/// after the other, in double, improved SD, a column at a time. Of logs as rows.
class PlainStitching {
public:
  PlainStitching(const mesh::Surface& model, std::shared_ptr<const deform::Cage> cage,
                 const deform::Stitching& stitching, base::WorkerPool& pool)
      : triangles_(model.triangles),
        stitching_(stitching),
        state_(cage, deform::Elements::face, deform::Blend::srl),
        positions_(model.positions.size()),
        normals_(model.positions.size()),
        around_(mesh::vertex_triangles(model.positions.size(), model.triangles)),
        right_(Eigen::Index(model.positions.size()), 3) {
    const deform::SparseMatrix k = system_of(model, stitching);
    const auto n = static_cast<int>(k.size());
    factors_.compute(Eigen::Map<const Eigen::SparseMatrix<double>>(n, n, k.starts.back(), k.starts.data(),
                                                                   k.rows.data(), k.values.data()));
    mesh::Surface centers;
    for (const auto& [a, b, c] : stitching.triangles)
      centers.positions.push_back((1.0 / 3) * (model.positions[a] + model.positions[b] + model.positions[c]));
    binding_ = deform::bind(centers, *cage, {}, pool);
    sums_.resize(centers.positions.size() * deform::log_shape.columns);
  }

  void deform(const deform::Pose& pose) {
    state_.set_pose(pose);
    const deform::Rows rows = state_.rows();
    blend(binding_, rows, 0, stitching_.triangles.size(), sums_);
    right_.setZero();
    for (std::size_t t = 0; t < stitching_.triangles.size(); ++t) load(t);
    for (std::size_t i = 0; i < stitching_.pins.size(); ++i) add_pin(i, rows);
    solve();
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      const auto x = solution_.row(Eigen::Index(v));
      positions_[v] = rows.origin + Vec3{x[0], x[1], x[2]};
    }
    mesh::vertex_normals(positions_, triangles_, around_, 0, positions_.size(), normals_);
  }

  std::span<const mesh::Point> positions() const { return positions_; }

private:
  void solve() {
    solution_.resize(right_.rows(), 3);
    for (int c = 0; c < 3; ++c) solution_.col(c) = factors_.solve(right_.col(c));
  }

  static sym3::Mat3<double> linear(const sym3::Sym3<double>& log, const Vec3& turn) {
    const auto s = sym3::exp(log, sym3::Method::improved_sd);
    const auto r = sym3::exp_rotation<double>(turn);
    sym3::Mat3<double> m;
    for (int c = 0; c < 3; ++c) {
      const Vec3 column = times(r, times(s, Vec3{double(c == 0), double(c == 1), double(c == 2)}));
      m[c] = column[0], m[3 + c] = column[1], m[6 + c] = column[2];
    }
    return m;
  }

  void load(std::size_t t) {
    const auto& [a, b, c] = stitching_.triangles[t];
    const double* s = sums_.data() + t * deform::log_shape.columns;
    const auto m = linear({s[0], s[1], s[2], s[3], s[4], s[5]}, {s[6], s[7], s[8]});
    const Vec3 first = times(m, stitching_.gradients[t][0]), second = times(m, stitching_.gradients[t][1]);
    add(a, first), add(b, second), add(c, Vec3{0, 0, 0} - (first + second));
  }

  void add_pin(std::size_t i, const deform::Rows& rows) {
    const auto& pin = stitching_.pins[i];
    const double* r = rows.values.data() + pin.handle * rows.columns();
    const auto m = linear({r[0], r[1], r[2], r[3], r[4], r[5]}, {r[6], r[7], r[8]});
    add(pin.vertex, pin.weight * (times(m, stitching_.pinned.offsets[i]) + Vec3{r[9], r[10], r[11]}));
  }

  void add(std::uint32_t v, const Vec3& load) {
    for (int c = 0; c < 3; ++c) right_(Eigen::Index(v), c) += load[c];
  }

  std::span<const mesh::Triangle> triangles_;
  const deform::Stitching& stitching_;
  deform::Binding binding_;  // of the triangles' centres
  deform::CageState state_;
  std::vector<double> sums_;
  std::vector<mesh::Point> positions_, normals_;
  mesh::Adjacency around_;
  Eigen::MatrixXd right_, solution_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

/// Everything that is measured of one model in one cage and pose.
class StitchedRuns {
public:
  explicit StitchedRuns(const StitchedOptions& options) {
    const scene::Document opened = open_model(options.model, options.cage);
    model_ = *opened.model.surface;
    cage_ = opened.cage;
    std::vector<std::string> warnings;
    pose_ = deform::read_pose(options.pose, *cage_, warnings);
    stitching_ = std::make_shared<const deform::Stitching>(stitch());
    binding_ = std::make_shared<const deform::Binding>(
        deform::bind(model_, *cage_, {}, deform::EngineKind::fused, nullptr, pool_));
    plain_ = std::make_unique<PlainStitching>(model_, cage_, *stitching_, pool_);
    for (const int iterations : {0, 1, 2}) frames_.push_back(frame(iterations));
  }

  std::vector<BenchResult> run(std::size_t rounds) {
    std::vector<RoundCase> cases;
    const auto add = [&](const char* name, auto what) {
      cases.push_back({name, size(), [what](std::size_t) { what(); }});
    };
    add("plain frame", [this] { plain_->deform(pose_); });
    add("frame, not stitched", [this] { frames_[0]->deform(pose_, sym3::Method::fast); });
    add("frame, 1 iteration", [this] { frames_[1]->deform(pose_, sym3::Method::fast); });
    add("frame, 2 iterations", [this] { frames_[2]->deform(pose_, sym3::Method::fast); });
    add("factored", [this] { stitch(); });
    base::Progress progress;
    return measure_rounds(cases, rounds, progress);
  }

  std::vector<BenchResult> compare(std::size_t rounds) const {
    return compare_solvers(system_of(model_, *stitching_), rounds);
  }

  std::size_t size() const { return model_.positions.size(); }
  std::size_t elements() const { return cage_->element_count(); }
  const deform::LinkTimes links() const { return frames_[1]->times(); }
  /// Of the stitched frame from the plain one, in diagonals of the cage.
  double difference() const {
    double largest = 0;
    const auto positions = frames_[1]->positions();
    for (std::size_t v = 0; v < size(); ++v) {
      const double off = mesh::norm(positions[v] - plain_->positions()[v]);
      largest = std::isnan(largest) || off <= largest ? largest : off;  // NaN counts
    }
    return largest / cage_->diagonal;
  }

private:
  deform::Stitching stitch() { return deform::stitch(model_, *cage_, pool_); }

  std::unique_ptr<deform::Deformer> frame(int iterations) {
    deform::Scheme scheme;
    scheme.iterations = iterations;
    return std::make_unique<deform::Deformer>(cage_, binding_, scheme, pool_, stitching_);
  }

  mesh::Surface model_;
  std::shared_ptr<const deform::Cage> cage_;
  deform::Pose pose_;
  base::WorkerPool pool_{1};
  std::shared_ptr<const deform::Stitching> stitching_;
  std::shared_ptr<const deform::Binding> binding_;
  std::unique_ptr<PlainStitching> plain_;
  std::vector<std::unique_ptr<deform::Deformer>> frames_;  // by iterations
};

void print(const StitchedRuns& runs, const std::vector<BenchResult>& results) {
  std::printf(
      "stitched: %s vertices, %zu cage triangles, kernel %s; one thread, its processor time, medians of "
      "interleaved runs\n",
      base::with_thousands(runs.size()).c_str(), runs.elements(), std::string(sym3::kernel_name()).c_str());
  for (const auto& r : results) {
    std::printf("  %-24s %9.2f ms\n", r.name.c_str(),
                r.ns_per_item * static_cast<double>(runs.size()) * 1e-6);
  }
  std::printf("  1 iteration by links, ms:");
  const auto links = runs.links();
  for (std::size_t l = 0; l < deform::link_count; ++l) {
    if (links.ms[l] > 0)
      std::printf(" %s %.2f", std::string(name(static_cast<deform::Link>(l))).c_str(), links.ms[l]);
  }
  std::printf("\n  frame and plain frame differ by %.1e diagonals\n", runs.difference());
}

}  // namespace

void bench_stitched(const StitchedOptions& options) {
  StitchedRuns runs(options);
  const auto results = runs.run(options.rounds);
  print(runs, results);
  const auto solvers = runs.compare(options.rounds);
  const auto ms = [&](const char* name) {
    return time_of(results, name) * static_cast<double>(runs.size()) * 1e-6;
  };
  Bars bars;
  bars.check("plain frame / frame, 1 iteration", ms("plain frame") / ms("frame, 1 iteration"), 5, true);
  bars.check("three columns: Eigen / ours",
             time_of(solvers, "three columns, Eigen") / time_of(solvers, "three columns, ours"), 2, true);
  if (runs.size() <= 50'000) {
    bars.check("frame, 1 iteration, ms", ms("frame, 1 iteration"), 12, false);
    bars.check("factored, ms", ms("factored"), 500, false);
  }
  write_json(options.json, {{"figure", "stitched"},
                            {"results", to_json(results)},
                            {"solvers", to_json(solvers)},
                            {"difference", runs.difference()},
                            {"bars", bars.rows}});
}

}  // namespace viete::bench
