#include "deform/splats.h"

#include <Eigen/Dense>
#include <limits>
#include <numbers>

#include "base/spherical_harmonics.h"
#include "deform/bound.h"
#include "weights/bind.h"

using namespace viete;
using namespace viete::test;

namespace {

using Matrix = Eigen::Matrix3d;
using std::numbers::pi;

struct Capture {
  mesh::Surface centres;
  mesh::Splats splats;
};

/// Random splats in a ball, some of them needles or plates; quaternions have various lengths.
Capture random_capture(std::size_t count, int degree) {
  Random random(17);
  Capture c;
  c.splats.degree = degree;
  for (std::size_t i = 0; i < count; ++i) {
    c.centres.positions.push_back(random.vector(0.7));
    const Vec3 s = random.vector(2), q = random.vector(1), color = random.vector(1);
    c.splats.log_scales.push_back({float(s[0] - 5), float(s[1] - 5), float(s[2] - 5)});
    c.splats.rotations.push_back({float(q[0]), float(q[1]), float(q[2]), 0.5F + float(i % 7)});
    c.splats.opacities.push_back(float(color[0]));
    c.splats.colors.push_back({float(color[0]), float(color[1]), float(color[2])});
    for (std::size_t k = 0; k < c.splats.bands(); ++k)
      for (const double x : random.vector(0.5)) c.splats.harmonics.push_back(float(x));
  }
  return c;
}

/// R diag(deviations) of a splat.
Matrix axes_of(const mesh::Splats& splats, std::size_t i) {
  const auto& q = splats.rotations[i];
  const Matrix r = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  const auto& s = splats.log_scales[i];
  return r * Eigen::Vector3d(std::exp(s[0]), std::exp(s[1]), std::exp(s[2])).asDiagonal();
}

Matrix covariance(const Matrix& axes) {
  return axes * axes.transpose();
}

double relative(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / b.norm();
}

template <class Map>
std::vector<mesh::Point> mapped_tips(const Capture& c, double step, const Map& map) {
  auto positions = deform::with_tips(c.centres, step).positions;
  for (mesh::Point& p : positions) p = map(p);
  return positions;
}

mesh::Splats posed(const Capture& c, const std::vector<mesh::Point>& positions, double step,
                   int threads = 2) {
  base::WorkerPool pool(threads);
  return deform::posed_splats(c.splats, positions, step, pool);
}

/// Returns the part of the colour of a channel that depends on the direction.
double color_in(const mesh::Splats& splats, std::size_t i, std::size_t channel, const Eigen::Vector3d& d) {
  const auto at = base::harmonics_at(d.x(), d.y(), d.z(), splats.degree);
  const float* c = splats.harmonics.data() + (3 * i + channel) * splats.bands();
  double sum = 0;
  for (std::size_t k = 0; k < splats.bands(); ++k) sum += at[k] * c[k];
  return sum;
}

deform::ExactModel exact(const Capture& c, const pose::Cage& cage, const pose::Deformer& deformer,
                         const pose::Pose& pose, const weights::Mask& mask = nullptr) {
  base::WorkerPool pool(2);
  return deform::deform_exactly(c.centres, std::make_shared<const pose::Cage>(cage), deformer, pose,
                                sym3::Method::fast, pool, nullptr, mask, {}, nullptr,
                                std::make_shared<const mesh::Splats>(c.splats));
}

/// Rotates the upper side of the box by 70 degrees.
const Twist twist{2, {0, 0, 0}, -1, 1, 0, 1.2};
/// Returns the splats posed by the map x -> m x + (3, 0, -1).
mesh::Splats posed_by(const Capture& c, const Matrix& m) {
  const auto map = [&](const mesh::Point& p) {
    const Eigen::Vector3d q = m * Eigen::Vector3d(p[0], p[1], p[2]);
    return mesh::Point{q[0] + 3, q[1], q[2] - 1};
  };
  return posed(c, mapped_tips(c, 1e-3, map), 1e-3);
}
const Matrix some_map = (Matrix() << 1.4, 0.3, -0.2, 0.1, 0.6, 0.4, -0.5, 0.2, 1.1).finished();

}  // namespace

TEST_CASE("an_affine_map_changes_covariances_exactly") {
  const Capture c = random_capture(500, 0);
  for (const Matrix& m : {some_map, Matrix(-some_map), Matrix(Matrix::Identity() * 1e3)}) {
    const auto splats = posed_by(c, m);
    for (std::size_t i = 0; i < splats.size(); ++i)
      CHECK(relative(covariance(axes_of(splats, i)), covariance(m * axes_of(c.splats, i))) <= 1e-6);
  }
}

TEST_CASE("needles_and_plates_of_any_size_keep_their_shortest_axis") {
  Capture c = random_capture(200, 0);
  for (std::size_t i = 0; i < c.splats.size(); ++i)
    c.splats.log_scales[i] = {i % 2 ? 80.0F : -80.0F, i % 3 ? -80.0F : 0.0F, i % 5 ? 1.0F : -12.0F};
  const auto splats = posed_by(c, (Matrix() << 0, 2, 0, -2, 0, 0, 0, 0, 2).finished());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    auto before = c.splats.log_scales[i], after = splats.log_scales[i];
    std::ranges::sort(before);
    std::ranges::sort(after);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(after[k] == doctest::Approx(before[k] + std::log(2)).epsilon(1e-6));
  }
}

TEST_CASE("colours_turn_with_the_splat_in_every_degree") {
  const Matrix turn = (Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -2).normalized())).toRotationMatrix();
  Random random(23);
  for (const int degree : {1, 2, 3}) {
    const Capture c = random_capture(50, degree);
    const auto splats = posed_by(c, turn);
    CHECK(splats.colors == c.splats.colors);
    for (int n = 0; n < 30; ++n) {
      const Vec3 v = random.vector(1);
      const Eigen::Vector3d d = Eigen::Vector3d(v[0], v[1], v[2]).normalized();
      for (std::size_t i = 0; i < splats.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
          CHECK(std::abs(color_in(splats, i, channel, d) -
                         color_in(c.splats, i, channel, turn.transpose() * d)) <= 2e-6);
    }
  }
}

TEST_CASE("unmoved_and_unusable_splats_keep_all_bits") {
  Capture c = random_capture(100, 3);
  const auto same = [](const mesh::Splats& a, const mesh::Splats& b, std::size_t i) {
    return std::memcmp(&a.log_scales[i], &b.log_scales[i], sizeof a.log_scales[i]) == 0 &&
           std::memcmp(&a.rotations[i], &b.rotations[i], sizeof a.rotations[i]) == 0 &&
           std::memcmp(&a.harmonics[45 * i], &b.harmonics[45 * i], 45 * sizeof(float)) == 0;
  };
  const auto moved = posed(c,
                           mapped_tips(c, 1e-3,
                                       [](mesh::Point p) {
                                         return p + mesh::Point{5, 0, 1};
                                       }),
                           1e-3);
  for (std::size_t i = 0; i < moved.size(); ++i) CHECK(same(moved, c.splats, i));
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinity = std::numeric_limits<float>::infinity();
  c.splats.log_scales[0] = {nan, 0, 0};
  c.splats.log_scales[1] = {infinity, 0, 0};
  c.splats.log_scales[2] = {-infinity, -infinity, -infinity};
  c.splats.rotations[3] = {0, 0, 0, 0};
  c.splats.rotations[4] = {nan, 0, 0, 1};
  auto positions = mapped_tips(c, 1e-3, [](mesh::Point p) { return 2.0 * p; });
  for (const std::size_t tip : {105, 205, 305}) positions[tip] = positions[5];  // F = 0
  const auto doubled = posed(c, positions, 1e-3);
  for (std::size_t i = 0; i < doubled.size(); ++i) CHECK(same(doubled, c.splats, i) == (i < 6));
}

TEST_CASE("splats_of_every_deformer_follow_the_differences_of_the_deformed_points") {
  const Capture c = random_capture(400, 2);
  const pose::Cage cage = pose::make_cage(box());
  pose::Pose bent = pose::rest_pose(cage);
  for (mesh::Point& p : bent.positions) p = twist(p);
  for (const pose::Preset preset : {pose::Preset::paper, pose::Preset::mean_value, pose::Preset::local}) {
    const pose::Deformer deformer = pose::deformer_of(preset);
    const auto result = exact(c, cage, deformer, bent);
    REQUIRE(result.splats);
    constexpr double h = 1e-4;  // central differences with another step than the implementation's
    Capture points;
    for (const double side : {0.0, 1.0, -1.0})
      for (std::size_t k = 0; k < (side == 0 ? 1 : 3); ++k)
        for (mesh::Point p : c.centres.positions) {
          p[k] += side * h;
          points.centres.positions.push_back(p);
        }
    base::WorkerPool pool(2);
    const auto moved = deform::deform_exactly(points.centres, std::make_shared<const pose::Cage>(cage),
                                              deformer, bent, sym3::Method::fast, pool)
                           .positions;
    const std::size_t n = c.splats.size();
    std::vector<double> errors;
    for (std::size_t i = 0; i < n; ++i) {
      Matrix f;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < 3; ++row)
          f(row, k) = (moved[(k + 1) * n + i][row] - moved[(k + 4) * n + i][row]) / (2 * h);
      errors.push_back(
          relative(covariance(axes_of(*result.splats, i)), covariance(f * axes_of(c.splats, i))));
      CHECK(result.positions[i] == moved[i]);
    }
    std::ranges::sort(errors);
    CHECK(errors[n / 2] <= 1e-3);
    CHECK(errors[n * 99 / 100] <= 1e-2);
  }
}

TEST_CASE("parts_of_a_split_splat_have_its_covariance_and_opacity_together") {
  Capture c = random_capture(6, 2);
  c.splats.log_scales.assign(6, {-5, -6, -9});
  c.splats.opacities = {-3, 0, 2, 9, 40, -40};
  for (const auto& [factor, parts] : {std::pair(2.4, 1), std::pair(3.0, 2), std::pair(6.0, 3)}) {
    mesh::Splats posed = c.splats;
    for (auto& scales : posed.log_scales) scales[0] += static_cast<float>(std::log(factor));
    const auto split = deform::split_stretched(c.splats, posed, c.centres.positions);
    CHECK(split.split == (parts > 1 ? 6 : 0));
    REQUIRE(split.splats.size() == 6 * std::size_t(parts));
    CHECK(split.splats.harmonics.size() == 3 * posed.bands() * split.splats.size());
    for (std::size_t i = 0; i < 6; ++i) {
      Matrix sum = Matrix::Zero();
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      double through = 1;
      const auto& middle = c.centres.positions[i];
      for (std::size_t k = i * std::size_t(parts); k < (i + 1) * std::size_t(parts); ++k) {
        CHECK(split.sources[k] == i);
        const Vec3 off = split.positions[k] - middle;
        const Eigen::Vector3d d(off[0], off[1], off[2]);
        const Matrix part = covariance(axes_of(split.splats, k));
        sum += (part + d * d.transpose()) / parts;
        mean += d;
        const double density = std::exp(-0.5 * d.dot(part.inverse() * d));
        through *= 1 - density / (1 + std::exp(-double(split.splats.opacities[k])));
      }
      CHECK(relative(sum, covariance(axes_of(posed, i))) <= 1e-3);
      CHECK(mean.norm() <= 1e-12);
      const double opacity = 1 / (1 + std::exp(-double(c.splats.opacities[i])));
      CHECK(1 - through == doctest::Approx(std::min(opacity, parts == 2 ? 0.8975 : 1.0)).epsilon(1e-3));
    }
  }
}

TEST_CASE("frames_show_the_splats_that_files_get") {
  const Capture c = random_capture(3000, 3);
  const auto cage = std::make_shared<const pose::Cage>(pose::make_cage(box()));
  pose::Pose bent = pose::rest_pose(*cage);
  for (mesh::Point& p : bent.positions) p = twist(p);
  const pose::Deformer deformer = pose::deformer_of(pose::Preset::paper);
  const auto whole = exact(c, *cage, deformer, bent);
  base::WorkerPool pool(2);
  const double step = deform::tip_step(c.centres, *cage, deform::tip_in_float);
  const auto points = std::make_shared<const mesh::Surface>(deform::with_tips(c.centres, step));
  for (const sym3::Method method : {sym3::Method::fast, sym3::Method::diag}) {
    weights::Binding binding =
        weights::bind(points, *cage, deformer.weighting, pose::engine_for(deformer, method), nullptr, pool);
    binding.tip_step = step;
    deform::FrameDeformer frame(cage, std::make_shared<const weights::Binding>(std::move(binding)), deformer,
                                pool);
    frame.set_splats(std::make_shared<const mesh::Splats>(c.splats));
    frame.deform(bent, method);
    CHECK(frame.vertices().size() == c.splats.size());
    CHECK(frame.positions().size() == c.splats.size());
    CHECK(frame.normals().size() == c.splats.size());
    CHECK(frame.sampled_error() <= 1e-4);
    std::vector<double> errors;
    for (std::size_t i = 0; i < c.splats.size(); ++i) {
      const Matrix shape =
          Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(frame.splats()->shapes()[i].data())
              .cast<double>();
      errors.push_back(relative(covariance(shape), covariance(axes_of(*whole.splats, i))));
      // The turned colour of the frame is the colour of the file.
      const auto& q = frame.splats()->turns()[i];
      const Matrix turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
      const Eigen::Vector3d d = Eigen::Vector3d(1, -2, 2) / 3;
      CHECK(std::abs(color_in(c.splats, i, 1, turn.transpose() * d) - color_in(*whole.splats, i, 1, d)) <=
            0.1);
    }
    std::ranges::sort(errors);
    CHECK(errors[errors.size() / 2] <= 5e-3);
    CHECK(errors[errors.size() * 99 / 100] <= 5e-2);
  }
}

TEST_CASE("held_splats_stay_and_threads_do_not_matter") {
  const Capture c = random_capture(300, 1);
  const pose::Cage cage = pose::make_cage(box());
  pose::Pose bent = pose::rest_pose(cage);
  for (mesh::Point& p : bent.positions) p = twist(p);
  std::vector<float> mask(300, 1);
  for (std::size_t i = 0; i < 300; i += 2) mask[i] = 0;
  const auto result = exact(c, cage, pose::deformer_of(pose::Preset::mean_value), bent,
                            std::make_shared<const std::vector<float>>(mask));
  for (std::size_t i = 0; i < 300; ++i) {
    CHECK((result.splats->log_scales[i] == c.splats.log_scales[i]) == (i % 2 == 0));
    if (i % 2 == 0)
      CHECK(largest_distance(std::span(&result.positions[i], 1), std::span(&c.centres.positions[i], 1)) <=
            1e-15);
  }
  const auto positions = mapped_tips(c, 1e-3, [](mesh::Point p) { return twist(p); });
  const auto one = posed(c, positions, 1e-3, 1), four = posed(c, positions, 1e-3, 4);
  CHECK(one.log_scales == four.log_scales);
  CHECK(one.rotations == four.rotations);
  CHECK(one.harmonics == four.harmonics);
}
