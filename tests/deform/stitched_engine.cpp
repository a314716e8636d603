#include "deform/stitched_engine.h"

#include <doctest/doctest.h>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/exact.h"
#include "mesh/normals.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr auto fast = sym3::Method::fast;

mesh::Surface stitched_model() {
  return tube(60, 24, 0.5, 4);
}

const Twist stitched_twist{2, {0.1, 0, 0}, -2.2, 2.2, -60 * degree, 70 * degree};

// A stitched model as in the program.
struct StitchedFrame {
  explicit StitchedFrame(const Scheme& scheme_, const mesh::Surface& model_ = stitched_model(),
                         int threads = 2)
      : model(model_),
        cage(std::make_shared<const Cage>(make_cage(tube(9, 7, 0.8, 4.4)))),
        scheme(scheme_),
        pool(threads),
        binding(std::make_shared<const Binding>(
            bind(model, *cage, scheme.weighting, EngineKind::fused, nullptr, pool))),
        stitching(std::make_shared<const Stitching>(stitch(model, *cage, pool))),
        deformer(cage, binding, scheme, pool, stitching) {}

  template <class Map>
  Pose pose(const Map& map) const {
    return {mapped(cage->surface.positions, map), {}};
  }
  std::vector<mesh::Point> deform(const Pose& pose, sym3::Method method = fast) {
    deformer.deform(pose, method);
    return deformer.positions();
  }
  std::vector<mesh::Point> exactly(const Pose& pose) {
    return deform_exactly(model, cage, scheme, pose, fast, pool).positions;
  }

  mesh::Surface model;
  std::shared_ptr<const Cage> cage;
  Scheme scheme;
  base::WorkerPool pool;
  std::shared_ptr<const Binding> binding;
  std::shared_ptr<const Stitching> stitching;
  Deformer deformer;
};

Scheme stitched_srl(int iterations = 1) {
  return {.weighting = {Elements::face, Weights::inverse}, .iterations = iterations};
}

}  // namespace

TEST_CASE("stitched_frames_equal_double_precision_up_to_the_sums") {
  for (Scheme scheme : whole_schemes()) {
    for (scheme.iterations = 1; scheme.iterations <= 2; ++scheme.iterations) {
      if (conflict(scheme)) continue;
      CAPTURE(text(scheme));
      StitchedFrame f(scheme);
      CHECK(f.deformer.engine(fast) == EngineKind::stitched);
      CHECK(largest_distance(f.deform(rest_pose(*f.cage)), f.model.positions) < 1e-12 * f.cage->diagonal);
      for (const Pose& pose : {f.pose(similarity({1, -2, 3}, 150 * degree, 2, {30, 4, 5})), f.pose(shear()),
                               f.pose(stitched_twist)}) {
        const auto exact = f.exactly(pose);
        CHECK(largest_distance(f.deform(pose), exact) < 1e-5 * f.cage->diagonal);
        CHECK(f.deformer.ran() == EngineKind::stitched);
        for (std::size_t v = 0; v < exact.size(); ++v) {
          const auto& p = f.deformer.vertices()[v].position;
          CHECK(norm(f.deformer.origin() + Vec3{p[0], p[1], p[2]} - exact[v]) < 1.1e-5 * f.cage->diagonal);
        }
      }
    }
  }
}

TEST_CASE("normals_of_stitched_frames_are_of_the_stitched_surface") {
  StitchedFrame f(stitched_srl());
  const auto posed = f.deform(f.pose(stitched_twist));
  std::vector<mesh::Point> normals(posed.size());
  mesh::vertex_normals(posed, f.model.triangles, mesh::vertex_triangles(posed.size(), f.model.triangles), 0,
                       posed.size(), normals);
  CHECK(largest_distance(f.deformer.normals(), normals) < 1e-4);
}

TEST_CASE("a_stitched_drag_is_a_full_frame") {
  for (const int iterations : {1, 2}) {
    StitchedFrame dragged(stitched_srl(iterations)), whole(stitched_srl(iterations));
    Pose pose = dragged.pose(stitched_twist);
    dragged.deform(pose);
    const std::vector<std::uint32_t> vertices = {40};
    dragged.deformer.begin_drag(vertices);
    for (int step = 0; step < 4; ++step) {
      pose.positions[40] = pose.positions[40] + Vec3{0.1, 0.05, 0};
      CHECK(largest_distance(dragged.deform(pose), whole.deform(pose)) < 1e-5 * whole.cage->diagonal);
    }
    dragged.deformer.end_drag();
    CHECK(dragged.deform(pose) == whole.deform(pose));
  }
}

TEST_CASE("stitched_frames_have_the_same_bits_on_any_number_of_threads_and_in_any_order") {
  StitchedFrame one(stitched_srl(2), stitched_model(), 1), three(stitched_srl(2), stitched_model(), 3);
  const auto first = one.deform(one.pose(stitched_twist));
  CHECK(three.deform(three.pose(stitched_twist)) == first);
  one.deform(one.pose(shear()));
  CHECK(one.deform(one.pose(stitched_twist)) == first);  // no state remains from other poses
}

TEST_CASE("vertices_with_holds_reach_their_blended_positions_in_stitched_frames") {
  mesh::Surface model = together(stitched_model(), tube(6, 5, 0.1, 0.5));
  model.positions.push_back({0.2, 0.1, 0.3});
  for (const Blend blend : {Blend::srl, Blend::linear}) {
    Scheme scheme = stitched_srl();
    scheme.blend = blend;
    StitchedFrame f(scheme, model);
    REQUIRE(f.stitching->holds.size() == 6 * 5 + 3);
    const Pose pose = f.pose(stitched_twist);
    CHECK(largest_distance(f.deform(pose), f.exactly(pose)) < 1e-5 * f.cage->diagonal);
  }
}

TEST_CASE("without_a_stitching_a_stitched_scheme_falls_back_to_blending") {
  StitchedFrame f(stitched_srl());
  Deformer waiting(f.cage, f.binding, f.scheme, f.pool);
  CHECK(!waiting.engine(fast));
  waiting.deform(f.pose(stitched_twist), fast);
  CHECK(waiting.ran() == EngineKind::fused);
  Scheme blended = f.scheme;
  blended.iterations = 0;
  Deformer other(f.cage, f.binding, blended, f.pool, f.stitching);
  other.deform(f.pose(stitched_twist), fast);
  CHECK(other.ran() == EngineKind::fused);
  CHECK(waiting.positions() == other.positions());
}

TEST_CASE("stitched_frames_run_every_method_and_time_their_links") {
  StitchedFrame f(stitched_srl());
  const auto by_fast = f.deform(f.pose(stitched_twist));
  CHECK(largest_distance(f.deform(f.pose(stitched_twist), sym3::Method::diag), by_fast) < 1e-12);
  const LinkTimes times = f.deformer.times();
  for (const Link link : {Link::blend, Link::triangle_maps, Link::solve, Link::normals})
    CHECK(times[link] > 0);
  CHECK(times[Link::fused] == 0);
}

TEST_CASE("the_error_of_a_stitched_frame_is_that_of_its_blended_vertices") {
  for (const auto& mask :
       {Mask(), std::make_shared<const std::vector<float>>(stitched_model().positions.size(), 0.4f)}) {
    StitchedFrame f(stitched_srl());
    f.deformer.set_mask(mask);
    f.deform(f.pose(stitched_twist));
    Scheme blended = f.scheme;
    blended.iterations = 0;
    Deformer other(f.cage, f.binding, blended, f.pool);
    other.set_mask(mask);
    other.deform(f.pose(stitched_twist), sym3::Method::fast);
    REQUIRE(other.ran() == EngineKind::fused);
    CHECK(f.deformer.sampled_error() > 0);
    CHECK(std::abs(f.deformer.sampled_error() - other.sampled_error()) < 3e-7);
  }
}
