#include "deform/splats.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/spherical_harmonics.h"
#include "sym3/decomposition.h"
#include "sym3/polar.h"
#include "sym3/small_matrices.h"

namespace viete::deform {

namespace {

using sym3::Mat3;

constexpr std::size_t block = 2048;  // number of splats that are processed at once

/// Returns the unit quaternion of a rotation, from its largest component (Shepperd 1978).
template <class T>
std::array<float, 4> quaternion_of(const Mat3<T>& r) {
  const T squares[4] = {1 + r[0] + r[4] + r[8], 1 + r[0] - r[4] - r[8], 1 - r[0] + r[4] - r[8],
                        1 - r[0] - r[4] + r[8]};
  const T a = r[7] - r[5], b = r[2] - r[6], c = r[3] - r[1];
  const T xy = r[1] + r[3], xz = r[2] + r[6], yz = r[5] + r[7];
  const T rows[4][4] = {
      {squares[0], a, b, c}, {a, squares[1], xy, xz}, {b, xy, squares[2], yz}, {c, xz, yz, squares[3]}};
  const std::size_t largest = std::max_element(squares, squares + 4) - squares;
  const T* q = rows[largest];
  const T scale = 1 / std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {float(q[0] * scale), float(q[1] * scale), float(q[2] * scale), float(q[3] * scale)};
}

/// Returns the derivative of the deformation at splat i.
Mat3<double> derivative_at(std::span<const mesh::Point> positions, double step, std::size_t i) {
  const std::size_t n = positions.size() / 4;
  Mat3<double> f;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row)
      f[3 * row + k] = (positions[(k + 1) * n + i][row] - positions[i][row]) / step;
  return f;
}

bool is_identity(const Mat3<double>& f) {
  constexpr double rounding = 1e-9;
  for (std::size_t k = 0; k < 9; ++k)
    if (!(std::abs(f[k] - (k % 4 == 0)) <= rounding)) return false;
  return true;
}

/// Directions in which 7 harmonics of degree 3, 5 of degree 2 and 3 of degree 1 are linearly independent.
std::array<sym3::Vec3<double>, 7> sample_directions() {
  std::array<sym3::Vec3<double>, 7> all;
  for (std::size_t k = 0; k < all.size(); ++k) {  // a spiral from pole to pole, but not symmetric
    const double z = 0.95 - 1.75 * static_cast<double>(k) / 6, angle = 2.39996 * static_cast<double>(k);
    const double r = std::sqrt(1 - z * z);
    all[k] = {r * std::cos(angle), r * std::sin(angle), z};
  }
  return all;
}

/// Turns coefficients of spherical harmonics: the values of the turned function at some directions are those
/// of the function at the directions turned back, and determine its coefficients, degree by degree.
class HarmonicsTurner {
public:
  explicit HarmonicsTurner(int degree) : degree_(degree) {
    for (int l = 1; l <= degree; ++l) inverses_[l] = inverse_of(l);
  }

  /// `harmonics`: 3 channels of degree (degree + 2) coefficients.
  void turn(const Mat3<double>& r, float* harmonics) const {
    std::array<std::array<double, 15>, 7> back;
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const auto& d = directions_[k];
      const auto along = [&](std::size_t column) {
        return r[column] * d[0] + r[3 + column] * d[1] + r[6 + column] * d[2];
      };
      back[k] = base::harmonics_at(along(0), along(1), along(2), degree_);
    }
    for (int channel = 0; channel < 3; ++channel)
      for (int l = 1; l <= degree_; ++l) {
        turn_degree(l, back, harmonics);
        harmonics += 2 * l + 1;
      }
  }

private:
  static std::size_t first(int l) { return static_cast<std::size_t>(l * l - 1); }

  void turn_degree(int l, const std::array<std::array<double, 15>, 7>& back, float* coefficients) const {
    const Eigen::Index m = 2 * l + 1;
    Eigen::Map<Eigen::VectorXf> all(coefficients, m);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1> values(m);
    for (Eigen::Index k = 0; k < m; ++k)
      values[k] = Eigen::Map<const Eigen::VectorXd>(back[static_cast<std::size_t>(k)].data() + first(l), m)
                      .dot(all.cast<double>());
    all = (inverses_[static_cast<std::size_t>(l)] * values).cast<float>();
  }

  /// Returns the inverse of the matrix of the harmonics of degree l at the first 2 l + 1 directions.
  Eigen::MatrixXd inverse_of(int l) const {
    const Eigen::Index m = 2 * l + 1;
    Eigen::MatrixXd a(m, m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const auto& d = directions_[static_cast<std::size_t>(k)];
      const auto at = base::harmonics_at(d[0], d[1], d[2], l);
      a.row(k) = Eigen::Map<const Eigen::RowVectorXd>(at.data() + first(l), m);
    }
    return a.inverse();
  }

  int degree_;
  std::array<sym3::Vec3<double>, 7> directions_ = sample_directions();
  std::array<Eigen::MatrixXd, 4> inverses_;  // [degree]
};

/// Changes splat i of `splats` by the derivative f, if both are usable.
void pose_splat(const Mat3<double>& f, const HarmonicsTurner& turner, std::size_t i, mesh::Splats& splats) {
  auto& scales = splats.log_scales[i];
  const double largest = *std::ranges::max_element(scales);
  Mat3<double> axes = sym3::product(f, sym3::rotation_of_quaternion(splats.rotations[i]));
  for (std::size_t k = 0; k < 9; ++k) axes[k] *= std::exp(std::max(scales[k % 3] - largest, -600.0));
  const auto [u, values, v] = sym3::svd(axes);
  std::array<float, 3> posed;
  for (std::size_t k = 0; k < 3; ++k) posed[k] = static_cast<float>(largest + std::log(std::abs(values[k])));
  if (!std::ranges::all_of(posed, [](float x) { return std::isfinite(x); })) return;
  scales = posed;
  splats.rotations[i] = quaternion_of(u);
  if (splats.degree > 0)
    turner.turn(sym3::polar(f).rotation, splats.harmonics.data() + 3 * splats.bands() * i);
}

/// How a splat is split: the places of the parts along the axis, and their deviation, both relative to the
/// deviation of the splat. The mean of the squared places, plus the squared deviation, is 1.
struct Split {
  std::vector<double> places;
  double deviation;
};

Split split_of(double growth) {
  if (growth > 4) return {{-0.95, 0, 0.95}, 0.6312};
  if (growth > 2.5) return {{-0.66, 0.66}, 0.7513};
  return {{0}, 1};
}

/// Returns the logit of the opacity of each part. The parts together have the opacity of the splat in their
/// middle.
float opacity_of_part(float opacity, const Split& split) {
  const double through = 1 / (1 + std::exp(static_cast<double>(opacity)));  // light that passes
  double low = 0, high = 1;
  for (int step = 0; step < 50; ++step) {
    const double middle = (low + high) / 2;
    double passes = 1;
    for (const double place : split.places)
      passes *= 1 - middle * std::exp(-0.5 * place * place / (split.deviation * split.deviation));
    (passes > through ? low : high) = middle;
  }
  constexpr double most = 1 - 1e-6;
  const double part = std::min(low, most);
  return static_cast<float>(std::log(part / (1 - part)));
}

/// Appends item i of a list whose items have `size` numbers.
template <class T>
void append_item(const std::vector<T>& from, std::size_t i, std::size_t size, std::vector<T>& to) {
  const auto first = from.begin() + static_cast<std::ptrdiff_t>(i * size);
  to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(size));
}

}  // namespace

double tip_step(const mesh::Surface& model, const pose::Cage& cage, double distance) {
  const double diagonal = mesh::bounds(cage.surface.positions).diagonal();
  const double size = diagonal > 0 ? diagonal : mesh::bounds(model.positions).diagonal();
  return distance * (size > 0 ? size : 1);
}

mesh::Surface with_tips(const mesh::Surface& model, double step) {
  const std::size_t n = model.positions.size();
  mesh::Surface all;
  all.positions.reserve(4 * n);
  all.positions = model.positions;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < n; ++i) all.positions.emplace_back(model.positions[i])[k] += step;
  return all;
}

weights::Mask with_tips(const weights::Mask& mask) {
  if (!mask) return nullptr;
  std::vector<float> all;
  all.reserve(4 * mask->size());
  for (int k = 0; k < 4; ++k) all.insert(all.end(), mask->begin(), mask->end());
  return std::make_shared<const std::vector<float>>(std::move(all));
}

weights::SharedShape with_tips(const weights::SharedShape& shape, double step) {
  if (!shape) return nullptr;
  mesh::Surface surface;
  surface.positions = *shape;
  return std::make_shared<const std::vector<mesh::Point>>(std::move(with_tips(surface, step).positions));
}

mesh::Splats posed_splats(const mesh::Splats& splats, std::span<const mesh::Point> positions, double step,
                          base::WorkerPool& pool) {
  mesh::Splats posed = splats;
  const HarmonicsTurner turner(splats.degree);
  pool.for_blocks(splats.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Mat3<double> f = derivative_at(positions, step, i);
      if (!is_identity(f)) pose_splat(f, turner, i, posed);
    }
  });
  return posed;
}

SplitSplats split_stretched(const mesh::Splats& rest, const mesh::Splats& posed,
                            std::span<const mesh::Point> positions) {
  SplitSplats all;
  all.splats.degree = posed.degree;
  for (std::size_t i = 0; i < posed.size(); ++i) {
    const auto& scales = posed.log_scales[i];
    const std::size_t axis = std::ranges::max_element(scales) - scales.begin();
    const double growth = std::exp(scales[axis] - *std::ranges::max_element(rest.log_scales[i]));
    const Split split = split_of(growth);
    const Mat3<double> rotation = sym3::rotation_of_quaternion(posed.rotations[i]);
    const double deviation = std::exp(static_cast<double>(scales[axis]));
    const bool is_split = split.places.size() > 1 && std::isfinite(rotation[0] * deviation);
    all.split += is_split;
    for (const double place : is_split ? split.places : std::vector<double>{0}) {
      mesh::Point p = positions[i];
      for (std::size_t k = 0; is_split && k < 3; ++k) p[k] += place * deviation * rotation[3 * k + axis];
      all.positions.push_back(p);
      all.sources.push_back(static_cast<std::uint32_t>(i));
      all.splats.log_scales.push_back(scales);
      if (is_split) all.splats.log_scales.back()[axis] += static_cast<float>(std::log(split.deviation));
      all.splats.rotations.push_back(posed.rotations[i]);
      all.splats.opacities.push_back(is_split ? opacity_of_part(posed.opacities[i], split)
                                              : posed.opacities[i]);
      all.splats.colors.push_back(posed.colors[i]);
      append_item(posed.harmonics, i, 3 * posed.bands(), all.splats.harmonics);
    }
  }
  return all;
}

std::vector<SplatShape> rest_shapes(const mesh::Splats& splats) {
  std::vector<SplatShape> shapes(splats.size());
  base::for_blocks(shapes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Mat3<double> r = sym3::rotation_of_quaternion(splats.rotations[i]);
      const Mat3<double> turn = std::isfinite(r[0]) ? r : Mat3<double>{1, 0, 0, 0, 1, 0, 0, 0, 1};
      for (std::size_t k = 0; k < 9; ++k)
        shapes[i][k] =
            static_cast<float>(turn[k] * std::exp(static_cast<double>(splats.log_scales[i][k % 3])));
    }
  });
  return shapes;
}

SplatFrame::SplatFrame(std::shared_ptr<const mesh::Splats> splats)
    : rest_(rest_shapes(*splats)), shapes_(rest_) {
  if (splats->degree > 0) turns_.assign(rest_.size(), {1, 0, 0, 0});
}

void SplatFrame::run(std::span<const pose::FrameVertex> vertices, double step, base::WorkerPool& pool) {
  pool.for_blocks(rest_.size(), block, [&](std::size_t begin, std::size_t end) {
    run_block(vertices, static_cast<float>(1 / step), begin, end);
  });
}

void SplatFrame::run_block(std::span<const pose::FrameVertex> vertices, float inverse_step, std::size_t begin,
                           std::size_t end) {
  const std::size_t n = rest_.size();
  std::array<Mat3<float>, block> derivatives;
  for (std::size_t i = begin; i < end; ++i) {
    Mat3<float>& f = derivatives[i - begin];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t row = 0; row < 3; ++row)
        f[3 * row + k] = (vertices[(k + 1) * n + i].position[row] - vertices[i].position[row]) * inverse_step;
    const Shape& rest = rest_[i];
    for (std::size_t row = 0; row < 9; row += 3)
      for (std::size_t k = 0; k < 3; ++k)
        shapes_[i][row + k] = f[row] * rest[k] + f[row + 1] * rest[3 + k] + f[row + 2] * rest[6 + k];
  }
  if (turns_.empty()) return;
  const sym3::MatView<float> view(sym3::Layout::packed, derivatives[0].data());
  sym3::polar(view, view, end - begin);
  for (std::size_t i = begin; i < end; ++i) turns_[i] = quaternion_of(derivatives[i - begin]);
}

}  // namespace viete::deform
