#include "deform/bound.h"

using namespace viete::test;
using viete::sym3::Method;
namespace sym3 = viete::sym3;

namespace {

using std::numbers::pi;

const viete::mesh::Surface& probed_tube() {
  static const auto tube_model = tube(60, 24, 0.3, 1.5);
  return tube_model;
}

Influence within(double radius, Falloff falloff = Falloff::smooth) {
  return {falloff, radius};
}

Probe probe_at(const Vec3& place, const Influence& influence) {
  return {place, influence, influence, influence, false, {}};
}

// Returns a pose with a large rotation, stretch and translation.
ProbePose strong() {
  return {{0.7, -1.9, 1.1}, {0.3, 0.1, -0.2, -0.4, 0.15, 0.25}, {0.2, -0.1, 0.4}};
}

Vec3 moved_by_map(const Probe& p, const Vec3& x) {
  return p.place + times(linear_part(p.pose), x - p.place) + p.pose.move;
}

// Returns the positions, moved only by the probes.
std::vector<Vec3> moved_by(const Probes& probes, std::vector<Vec3> positions, const Mask& mask = nullptr,
                           int threads = 2) {
  viete::base::WorkerPool pool(threads);
  const auto rest = positions;
  ProbeLayer layer(rest, pool);
  layer.set(probes, mask);
  layer.move_all(positions, Method::fast);
  return positions;
}

std::vector<Vec3> moved_by(const Probes& probes) {
  return moved_by(probes, probed_tube().positions);
}

std::vector<ProbeWeights> probe_weights_at(const Probes& probes, const Vec3& point) {
  std::vector<ProbeWeights> weights(probes.all.size());
  probe_weights(probes, point, weights);
  return weights;
}

// Returns two probes near the tube's ends, with a locked probe between them.
Probes some_probes() {
  Probes probes;
  probes.all = {probe_at({0.1, 0, -1}, within(1.2)), probe_at({0, 0.1, 1.1}, within(0.9, Falloff::round)),
                probe_at({0, 0, 0}, within(0.5, Falloff::endless))};
  probes.all[0].pose = strong();
  probes.all[1].pose = {{-2, 0.4, 0.3}, {-0.2, 0, 0.1, 0.3, 0, 0.1}, {0, 0.3, -0.1}};
  probes.all[2].locked = true;
  return probes;
}

}  // namespace

TEST_CASE("a_model_with_full_weight_follows_the_map_of_its_probe") {
  for (const ProbeMix mix : {ProbeMix::partial, ProbeMix::whole, ProbeMix::softmax}) {
    Probes probes{{probe_at({0.2, -0.3, 0.5}, within(100, Falloff::even))}, mix};
    probes.all[0].pose = strong();
    const auto positions = moved_by(probes);
    for (std::size_t v = 0; v < positions.size(); ++v)
      CHECK(norm(positions[v] - moved_by_map(probes.all[0], probed_tube().positions[v])) < 1e-14);
  }
}

TEST_CASE("probes_act_by_their_weights") {
  Probe p = probe_at({0.1, 0, 0.2}, within(1));
  p.turn = within(1.3, Falloff::linear);
  p.stretch = within(0.8, Falloff::sharp);
  p.move = within(0.6);
  p.pose = strong();
  const auto positions = moved_by({{p}});
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& x = probed_tube().positions[v];
    const double d = norm(x - p.place);
    const double turn = std::max(0.0, 1 - d / 1.3), stretch = std::pow(std::max(0.0, 1 - d / 0.8), 2);
    const double t = std::min(1.0, d / 0.6), move = 1 - 3 * t * t + 2 * t * t * t;
    const auto& s = p.pose.stretch;
    const auto r = sym3::exp_rotation(turn * p.pose.turn);
    const auto e = sym3::exp(sym3::Sym3<double>{stretch * s.xx, stretch * s.xy, stretch * s.xz,
                                                stretch * s.yy, stretch * s.yz, stretch * s.zz},
                             Method::diag);
    CHECK(norm(positions[v] - (p.place + times(r, times(e, x - p.place)) + move * p.pose.move)) < 1e-14);
  }
}

TEST_CASE("vertices_out_of_reach_and_resting_probes_change_no_bit") {
  Probes probes{{probe_at({0, 0, -0.7}, within(0.6)), probe_at({0, 0, 1}, within(1))}};
  CHECK(moved_by(probes) == probed_tube().positions);
  probes.all[0].pose = strong();
  const auto positions = moved_by(probes);
  std::size_t changed = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3& x = probed_tube().positions[v];
    changed += positions[v] != x;
    if (norm(x - probes.all[0].place) >= 0.6) CHECK(positions[v] == x);
  }
  CHECK(changed > 50);
}

TEST_CASE("falloffs_begin_at_one_never_rise_and_end_at_the_radius") {
  for (const Falloff falloff : viete::base::all_values<Falloff>()) {
    INFO(std::string(viete::base::entry_of(falloff).word));
    CHECK(viete::base::value_of_word<Falloff>(viete::base::entry_of(falloff).word) == falloff);
    if (falloff == Falloff::none) {
      CHECK(weight_at(falloff, 0) == 0);
      continue;
    }
    CHECK(weight_at(falloff, 0) == 1);
    for (int i = 0; i < 300; ++i) CHECK(weight_at(falloff, 0.01 * (i + 1)) <= weight_at(falloff, 0.01 * i));
    CHECK((weight_at(falloff, 1) == 0) == (falloff != Falloff::endless));
  }
  CHECK(weight_at(Falloff::endless, 1) == 0.5);
  for (const Falloff falloff : viete::base::all_values<Falloff>())
    CHECK(weight_at(falloff, HUGE_VAL) == 0);  // distance / radius, for a radius of almost 0
  CHECK(weight_at(Falloff::smooth, 0.5) == 0.5);
}

TEST_CASE("probes_share_a_vertex_by_their_mix") {
  const auto sum = [](const std::vector<ProbeWeights>& all, double ProbeWeights::*part) {
    return std::accumulate(all.begin(), all.end(), 0.0, [&](double s, const auto& w) { return s + w.*part; });
  };
  Probes probes{
      {probe_at({0, 0, 0}, within(1)), probe_at({0.5, 0, 0}, within(1)), probe_at({0, 3, 0}, within(1))}};
  probes.all[1].move = within(1, Falloff::none);
  for (const double x : {-0.9, -0.4, 0.0, 0.2, 0.3, 0.9, 1.4}) {
    INFO(x);
    const Vec3 point{x, 0, 0};
    const double a = weight_at(Falloff::smooth, std::abs(x)),
                 b = weight_at(Falloff::smooth, std::abs(x - 0.5));
    probes.mix = ProbeMix::partial;
    auto w = probe_weights_at(probes, point);
    CHECK(w[0].turn == doctest::Approx(a / std::max(1.0, a + b)).epsilon(1e-14));
    CHECK(w[0].move == doctest::Approx(a).epsilon(1e-14));
    CHECK(w[1].move == 0);
    CHECK(w[2].turn == 0);
    for (const ProbeMix mix : {ProbeMix::partial, ProbeMix::whole, ProbeMix::softmax}) {
      probes.mix = mix;
      w = probe_weights_at(probes, point);
      CHECK(sum(w, &ProbeWeights::pivot) == doctest::Approx(1).epsilon(1e-14));
      if (mix != ProbeMix::partial) CHECK(sum(w, &ProbeWeights::turn) == doctest::Approx(1).epsilon(1e-14));
    }
    // Softmax gives the nearer probe at least as much weight as division by the sum.
    const double even = a / (a + b), sharp = w[0].turn;
    CHECK((even > 0.5 ? sharp >= even : even < 0.5 ? sharp <= even : sharp == doctest::Approx(0.5)));
  }
  probes.mix = ProbeMix::added;
  CHECK(probe_weights_at(probes, {0, 0, 0})[0].turn == 1);
  for (const ProbeMix mix : viete::base::all_values<ProbeMix>())
    CHECK(viete::base::value_of_word<ProbeMix>(viete::base::entry_of(mix).word) == mix);
}

TEST_CASE("probes_do_not_depend_on_position_or_unit_of_the_scene") {
  const Probes probes = some_probes();
  const auto here = moved_by(probes);
  const Vec3 away{1000, -300, 50};
  constexpr double unit = 1024;
  Probes other = probes;
  auto positions = probed_tube().positions;
  for (Vec3& x : positions) x = unit * (x + away);
  for (Probe& p : other.all) {
    p.place = unit * (p.place + away);
    p.pose.move = unit * p.pose.move;
    for (const auto part : {&Probe::turn, &Probe::stretch, &Probe::move}) (p.*part).radius *= unit;
  }
  const auto there = moved_by(other, positions);
  for (std::size_t v = 0; v < here.size(); ++v) CHECK(norm((1 / unit) * there[v] - away - here[v]) < 1e-12);
}

TEST_CASE("mirrored_probes_move_a_mirrored_model_as_its_mirror_image") {
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double at = 0.3;
    const auto mirror = [&](Vec3 x) {
      x[std::size_t(axis)] = 2 * at - x[std::size_t(axis)];
      return x;
    };
    const Probes probes = some_probes();
    Probes other = probes;
    for (Probe& p : other.all) p = mirrored(p, axis, at);
    auto positions = probed_tube().positions;
    for (Vec3& x : positions) x = mirror(x);
    const auto expected = moved_by(probes), found = moved_by(other, positions);
    for (std::size_t v = 0; v < expected.size(); ++v) CHECK(norm(found[v] - mirror(expected[v])) < 1e-13);
    for (std::size_t i = 0; i < probes.all.size(); ++i) {
      const Probe back = mirrored(other.all[i], axis, at);
      CHECK(norm(back.place - probes.all[i].place) < 1e-15);
      CHECK(back.pose == probes.all[i].pose);
    }
  }
}

TEST_CASE("turning_is_smooth_through_360_and_540_degrees") {
  Probe p = probe_at({0, 0, 1.2}, within(1.5));
  const Vec3 axis = (1 / std::sqrt(14.0)) * Vec3{1, 2, 3};
  constexpr double step = pi / 60;
  auto before = moved_by({{p}});
  for (int i = 1; i <= 240; ++i) {  // two turns
    p.pose = turned(p.pose, axis, step);
    CHECK(norm(p.pose.turn - (i * step) * axis) < 1e-11);
    const auto now = moved_by({{p}});
    for (std::size_t v = 0; v < now.size(); ++v)
      CHECK(norm(now[v] - before[v]) <= step * 1.0001 * norm(probed_tube().positions[v] - p.place) + 1e-12);
    before = now;
  }
  CHECK(norm(turned({}, axis, 4 * pi).turn - p.pose.turn) < 1e-11);
}

TEST_CASE("turns_and_scales_compose_like_matrices") {
  const Vec3 axis{0, 0.6, -0.8};
  const ProbePose one = turned(strong(), axis, 2.2);
  const auto expected = times(sym3::exp_rotation(2.2 * axis), linear_part(strong()));
  const ProbePose two = scaled(strong(), {2, 0.5, 1.5});
  const auto m = linear_part(strong()), n = linear_part(two);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(linear_part(one)[i] == doctest::Approx(expected[i]).epsilon(1e-13));
    CHECK(n[i] == doctest::Approx(m[i] * (i < 3 ? 2 : i < 6 ? 0.5 : 1.5)).epsilon(1e-13));
  }
  CHECK(one.stretch.xx == strong().stretch.xx);
  CHECK(turned(strong(), axis, 0) == strong());
  // The pose keeps whole turns. It never mirrors or collapses.
  ProbePose wound;
  wound.turn = {0, 0, 5 * pi};
  CHECK(norm(scaled(wound, {1.5, 1.5, 1.5}).turn - wound.turn) < 1e-12);
  const ProbePose flat = scaled({}, {-3, 0, 1});
  const auto f = linear_part(flat);
  CHECK(f[0] == doctest::Approx(least_factor));
  CHECK(f[4] == doctest::Approx(least_factor));
  CHECK(f[8] == doctest::Approx(1));
}

TEST_CASE("a_mask_counts_for_probes_and_results_do_not_depend_on_threads") {
  std::vector<float> shares(probed_tube().positions.size(), 0.0f);
  std::fill(shares.begin(), shares.begin() + 500, 1.0f);
  const auto mask = std::make_shared<const std::vector<float>>(shares);
  const auto whole = moved_by(some_probes()), masked = moved_by(some_probes(), probed_tube().positions, mask);
  for (std::size_t v = 0; v < whole.size(); ++v)
    CHECK(masked[v] == (v < 500 ? whole[v] : probed_tube().positions[v]));
  CHECK(moved_by(some_probes(), probed_tube().positions, nullptr, 1) == whole);
}

TEST_CASE("probes_follow_the_cage_in_every_engine") {
  const Twist twist{2, {0, 0, 0}, -1, 1, 0, 100 * degree};
  for (const Deformer& deformer :
       {Deformer{faces}, Deformer{faces, Blend::linear}, Deformer{mean_values, Blend::linear},
        Deformer{biharmonics}, Deformer{.weighting = {}, .iterations = 1}}) {
    CAPTURE(text(deformer));
    Frames f(probed_tube(), box(), deformer);
    const Pose pose = f.staged.pose(twist);
    const auto without = f.deform(pose);
    // The probes move the positions that a frame without probes has.
    auto carried = without;
    ProbeLayer layer(probed_tube().positions, f.staged.pool);
    layer.set(some_probes(), nullptr);
    layer.move_all(carried, Method::fast);
    f.set_probes(some_probes());
    CHECK(f.deform(pose) == carried);
    CHECK(f.fused.times()[Stage::probes] > 0);
    if (deformer.stitched()) continue;
    // Each probe follows the position of its nearest vertex in a frame without probes.
    const auto ridden = f.fused.probes().carried();
    const double diagonal = f.staged.cage->diagonal;
    for (std::size_t i = 0; i < ridden.size(); ++i) {
      const auto v = f.fused.probes().anchors()[i];
      const Vec3 displacement = without[v] - probed_tube().positions[v];
      CHECK(norm(f.fused.origin() + ridden[i] - (some_probes().all[i].place + displacement)) / diagonal <
            2e-5);
    }
    // A frame does not depend on earlier frames, nor on a drag.
    const auto whole = f.fused.positions();
    f.fused.begin_drag(std::array{0u, 1u});
    for (int n = 0; n < 3; ++n) f.fused.deform(pose, Method::fast);
    CHECK(largest_distance(f.fused.positions(), whole) / diagonal < 2e-6);
    f.set_probes({});
    CHECK(f.deform(pose) == without);
    CHECK(f.fused.times()[Stage::probes] == 0);
    CHECK(f.fused.probes().places().empty());
  }
}

TEST_CASE("places_of_probes_are_moved_by_the_other_probes") {
  viete::base::WorkerPool pool(2);
  const auto& rest = probed_tube().positions;
  for (const ProbeMix mix : {ProbeMix::partial, ProbeMix::added, ProbeMix::whole}) {
    Probes probes = some_probes();
    probes.mix = mix;
    for (const std::uint32_t v : {100u, 700u, 1300u}) {
      probes.all[2].place = rest[v];  // at rest
      ProbeLayer layer(rest, pool);
      layer.set(probes, nullptr);
      auto positions = rest;
      layer.move_all(positions, Method::fast);
      CHECK(norm(layer.places()[2] - positions[v]) < 1e-13);
    }
  }
}

TEST_CASE("without_a_cage_a_model_stays_at_rest_and_follows_probes") {
  viete::base::WorkerPool pool(2);
  const auto cage = std::make_shared<const Cage>(no_cage(viete::mesh::used_bounds(probed_tube())));
  const auto binding = std::make_shared<const Binding>(
      viete::weights::bind(std::make_shared<const viete::mesh::Surface>(probed_tube()), *cage,
                           no_motion().weighting, EngineKind::fused, nullptr, pool));
  FrameDeformer deformer(cage, binding, no_motion(), pool);
  deformer.set_probes({{probe_at({0, 0, 1}, within(0.8))}});
  deformer.deform(rest_pose(*cage), Method::fast);
  CHECK(largest_distance(deformer.positions(), probed_tube().positions) < 1e-6);
  CHECK(norm(deformer.probes().places()[0] - Vec3{0, 0, 1}) < 1e-6);
  deformer.set_probes(some_probes());
  deformer.deform(rest_pose(*cage), Method::fast);
  CHECK(largest_distance(deformer.positions(), moved_by(some_probes())) < 2e-6);
  const auto exact = deform_exactly(probed_tube(), cage, no_motion(), rest_pose(*cage), Method::fast, pool,
                                    nullptr, nullptr, some_probes());
  CHECK(largest_distance(exact.positions, moved_by(some_probes())) < 1e-14);
  // The normals belong to the displayed surface.
  const auto normals = deformer.normals();
  std::vector<Vec3> expected;
  for (const auto& v : deformer.vertices()) expected.push_back(viete::base::unpack_normal(v.normal));
  CHECK(largest_distance(normals, expected) == 0);
  for (const Vec3& n : normals) CHECK(norm(n) == doctest::Approx(1).epsilon(1e-5));
}
