#include <set>

#include "deform/bound.h"
#include "deform/frame_deformer.h"

using namespace viete::test;

TEST_CASE("apply_stretches_first_then_turns_then_moves") {
  Binding b;
  b.vertices = 1;
  b.rest = std::make_shared<const std::vector<viete::mesh::Point>>(1);
  b.offsets = {{1, 2, 3}};
  const std::vector<double> sums{0, 0, 0, 0, 0, 0, 0, 0, 90 * degree, 10, 20, 30};
  const std::vector<viete::sym3::Sym3<double>> stretches = {{2, 0, 0, 3, 0, 1}};
  std::vector<viete::mesh::Point> out(1);
  apply({b}, RowForm::logs, sums, stretches, {100, 0, 0}, 0, 1, out);
  CHECK(norm(out[0] - Vec3{100 + 10 - 6, 20 + 2, 30 + 3}) < 1e-13);
}

namespace {

Binding random_binding(std::size_t vertices, std::size_t handles, Random& random) {
  Binding b;
  b.vertices = vertices;
  b.handles = handles;
  for (std::size_t i = 0; i < vertices * handles; ++i) b.weights.push_back(random(0, 1));
  for (std::size_t i = 0; i < vertices; ++i) b.offsets.push_back(random.vector(1));
  b.rest = std::make_shared<const std::vector<viete::mesh::Point>>(vertices);
  return b;
}

}  // namespace

TEST_CASE("blend_is_the_sum_over_handles_in_their_order_to_the_last_bit") {
  Random random(13);
  const std::size_t n = 37, k = 23;
  const Binding b = random_binding(n, k, random);
  std::vector<MapLog> logs(k);
  for (auto& l : logs)
    l = {{random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)},
         random.vector(3),
         random.vector(2)};
  std::vector<double> sums(n * log_shape.columns);
  const Rows rows{RowForm::logs, {reinterpret_cast<const double*>(logs.data()), 12 * logs.size()}, {}};
  for (const auto& [begin, end] : {std::pair{0u, 1u}, {1u, 4u}, {4u, 11u}, {11u, 37u}})
    blend({b}, rows, begin, end, sums);
  for (std::size_t i = 0; i < n; ++i) {
    double xy = 0, zz = 0;
    Vec3 rotation{0, 0, 0}, center{0, 0, 0};
    for (std::size_t j = 0; j < k; ++j) {
      const double w = b.weights[i * k + j];
      xy += w * logs[j].stretch.xy;
      zz += w * logs[j].stretch.zz;
      rotation = rotation + w * logs[j].rotation;
      center = center + w * logs[j].center;
    }
    const double* sum = sums.data() + i * log_shape.columns;
    CHECK(sum[1] == xy);
    CHECK(sum[5] == zz);
    CHECK(Vec3{sum[6], sum[7], sum[8]} == rotation);
    CHECK(Vec3{sum[9], sum[10], sum[11]} == center);
  }
}

using viete::sym3::Method;

TEST_CASE("before_the_first_frame_there_are_no_vertices_and_no_turns") {
  const Bound b(tube(20, 12, 0.3, 1.5), box());
  CHECK(b.deformer.vertices().empty());
  CHECK(b.deformer.positions().empty());
  CHECK_FALSE(b.deformer.ran().has_value());
  CHECK(b.report().turns == std::vector<Vec3>{{0, 0, 0}});
}

TEST_CASE("every_staged_link_of_a_blend_is_timed_and_no_other") {
  const auto model = tube(60, 30, 0.3, 1.5);
  const auto timed = [&](const Weighting& weighting, Blend blend) {
    Bound b(model, box(), weighting, 2, blend);
    b.deform(b.pose(shear()));
    CHECK(b.deformer.ran() == EngineKind::staged);
    CHECK(b.deformer.sample_matrices(100).size() == (b.deformer.deformer().exponential() ? 100 : 0));
    std::set<Stage> stages;
    for (std::size_t i = 0; i < stage_count; ++i)
      if (b.deformer.times().ms[i] > 0) stages.insert(static_cast<Stage>(i));
    return stages;
  };
  using S = Stage;
  CHECK(timed(faces, Blend::srl) == std::set{S::maps, S::log_maps, S::blend, S::exp, S::apply, S::normals});
  CHECK(timed(faces, Blend::linear) == std::set{S::maps, S::blend, S::apply, S::normals});
  CHECK(timed(mean_values, Blend::linear) == std::set{S::blend, S::apply, S::normals});
}

TEST_CASE("frames_have_the_same_bits_for_any_number_of_threads") {
  for (const auto& c : {faces, mean_values}) {
    Bound one(tube(50, 30, 0.3, 1.5), box(), c, 1), four(tube(50, 30, 0.3, 1.5), box(), c, 4);
    const Twist twist{2, {0, 0, 0}, -1, 1, 0, 150 * degree};
    one.deform(one.pose(twist));
    four.deform(four.pose(twist));
    CHECK(largest_distance(one.deformer.positions(), four.deformer.positions()) == 0);
    CHECK(largest_distance(one.deformer.normals(), four.deformer.normals()) == 0);
  }
}

TEST_CASE("a_frame_does_not_depend_on_the_frames_before") {
  Bound a(tube(20, 12, 0.3, 1.5), box()), b(tube(20, 12, 0.3, 1.5), box());
  a.deform(a.pose(similarity({1, 2, 3}, 3, 7)));
  const Pose pose = a.pose(shear());
  CHECK(largest_distance(a.deform(pose), b.deform(pose)) == 0);
}

TEST_CASE("normals_turn_with_the_pose") {
  Bound b(tube(20, 12, 0.3, 1.5), box());
  const auto map = similarity({1, 2, 3}, 1.5);
  b.deform(rest_pose(*b.cage));
  const auto expected = mapped(b.deformer.normals(), map);
  b.deform(b.pose(map));
  CHECK(largest_distance(b.deformer.normals(), expected) < 1e-10);
}

TEST_CASE("vertices_are_float_positions_about_the_origin_and_packed_normals") {
  Bound b(tube(20, 12, 0.3, 1.5), box());
  b.deform(b.pose(similarity({1, 2, 3}, 1.5, 2, {1000, 0, 0})));
  const auto positions = b.deformer.positions(), normals = b.deformer.normals();
  REQUIRE(b.deformer.vertices().size() == positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const FrameVertex& v = b.deformer.vertices()[i];
    for (int k = 0; k < 3; ++k)
      CHECK(v.position[k] == static_cast<float>(positions[i][k] - b.deformer.origin()[k]));
    CHECK(viete::base::norm(viete::base::unpack_normal(v.normal) - normals[i]) < 5e-5);
  }
}

TEST_CASE("the_fused_engine_runs_method_fast_and_every_deformer_without_an_exponential") {
  for (const Deformer& deformer : valid_deformers()) {
    CAPTURE(text(deformer));
    Frames f(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2), deformer);
    const bool exponential = deformer.exponential();
    CHECK(exponential == (deformer.blend == Blend::srl));
    CHECK(f.fused.binding().weights.empty());
    CHECK(f.fused.engine(Method::fast) == EngineKind::fused);
    CHECK(f.fused.engine(Method::diag).has_value() == !exponential);
    const Pose pose = f.staged.pose(shear());
    const auto exact = f.deform(pose);
    CHECK(f.fused.times()[Stage::fused] > 0);
    CHECK(f.fused.sampled_error() > 0);
    CHECK(f.staged.deformer.sampled_error() == 0);
    const auto matrices = f.fused.sample_matrices(100), same = f.staged.deformer.sample_matrices(100);
    CHECK(matrices.size() == (exponential ? 100 : 0));
    // The fused engine reads weights along the surface from its tiles, which store floats.
    const double bound = deformer.weighting.on_surface() ? 1e-5 : 1e-13;
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      const auto &a = matrices[i], &b = same[i];
      CHECK(std::abs(a.xx - b.xx) + std::abs(a.xy - b.xy) + std::abs(a.zz - b.zz) < bound);
    }
    const auto both = std::make_shared<const Binding>(
        viete::weights::bind(viete::mesh::lent(f.staged.model), *f.staged.cage, deformer.weighting,
                             EngineKind::staged, &f.fused.binding(), f.staged.pool));
    CHECK(both->tiles == f.fused.binding().tiles);
    FrameDeformer any(f.staged.cage, both, deformer, f.staged.pool);
    any.deform(pose, Method::fast);
    any.deform(pose, Method::diag);
    CHECK(any.ran() == (exponential ? EngineKind::staged : EngineKind::fused));
    CHECK(largest_distance(any.positions(), exact) < (exponential ? 1e-12 : 2e-5) * f.staged.cage->diagonal);
  }
}
