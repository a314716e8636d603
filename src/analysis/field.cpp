#include "analysis/field.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "sym3/eigenvalues.h"

namespace viete::analysis {

namespace {

constexpr double least_log2 = -20;  // the value for collapsed triangles: a ratio of about 1e-6
constexpr std::size_t portion = 1024;

double log2_of(double ratio) {
  return std::max(std::log2(ratio), least_log2);
}

std::vector<double> distances(std::span<const mesh::Point> a, std::span<const mesh::Point> b,
                              double diagonal) {
  std::vector<double> values;
  values.reserve(a.size());
  for (std::size_t v = 0; v < a.size(); ++v) values.push_back(mesh::norm(a[v] - b[v]) / diagonal);
  return values;
}

template <double (*of)(const Stretches&)>
std::vector<double> strain_means(const FieldInput& in) {
  return in.strain->means(in.drawn, of, *in.pool);
}

double area_log(const Stretches& s) {
  return log2_of(s.larger * s.smaller);
}
double larger_log(const Stretches& s) {
  return log2_of(s.larger);
}
double smaller_log(const Stretches& s) {
  return log2_of(s.smaller);
}
double shear_log(const Stretches& s) {
  return s.larger > 0 ? std::min(std::log2(s.larger / s.smaller), -least_log2) : 0;
}
// Returns the symmetric Dirichlet energy minus its value at rest, which is 4.
double energy_of(const Stretches& s) {
  const double a = std::max(s.larger, 1e-6), b = std::max(s.smaller, 1e-6);
  return a * a + b * b + 1 / (a * a) + 1 / (b * b) - 4;
}

// Returns log2(det(exp S)) = tr S / ln 2 for each blended matrix S.
std::vector<double> volumes(const FieldInput& in) {
  std::vector<double> values;
  values.reserve(in.matrices.size());
  for (const auto& s : in.matrices) values.push_back((s.xx + s.yy + s.zz) / std::log(2.0));
  return values;
}

// Returns for each matrix the smallest gap between eigenvalues, divided by the largest absolute eigenvalue.
std::vector<double> gaps(const FieldInput& in) {
  std::vector<std::array<double, 3>> eigenvalues(in.matrices.size());
  if (in.matrices.empty()) return {};
  sym3::eigenvalues(sym3::packed(in.matrices.data()),
                    sym3::VecView<double>{sym3::Layout::packed, eigenvalues[0].data()}, in.matrices.size());
  std::vector<double> values;
  values.reserve(eigenvalues.size());
  for (const auto& [a, b, c] : eigenvalues) {
    const double size = std::max(std::abs(a), std::abs(c));
    values.push_back(size > 0 ? std::min(b - a, c - b) / size : 0);
  }
  return values;
}

// Returns for each matrix the relative error of exp. The reference has 106 bits and takes about 2 us.
std::vector<double> exp_errors(const FieldInput& in) {
  std::vector<double> values;
  std::vector<sym3::Sym3<double>> computed(portion);
  for (std::size_t begin = 0; begin < in.matrices.size(); begin += portion) {
    if (in.progress)
      in.progress->report(static_cast<double>(begin) / static_cast<double>(in.matrices.size()));
    const auto part = in.matrices.subspan(begin, std::min(portion, in.matrices.size() - begin));
    sym3::exp<double>(part, std::span(computed).first(part.size()), in.method);
    for (std::size_t i = 0; i < part.size(); ++i)
      values.push_back(sym3::relative_error(computed[i], part[i]));
  }
  return values;
}

// Returns each vertex's offset along its normal in the first view, divided by the diagonal.
std::vector<double> signed_differences(const FieldInput& in) {
  std::vector<double> values = in.strain->along_normals(in.first, in.drawn, *in.pool);
  for (double& value : values) value /= in.strain->diagonal();
  return values;
}

// Returns the table entry of a field whose values are ratios to the value at rest.
constexpr FieldEntry factor(const base::Choice& choice, Source source,
                            std::vector<double> (*compute)(const FieldInput&)) {
  return {.choice = choice,
          .source = source,
          .needs_faces = source == Source::surface,
          .scale = Scale::log2,
          .symmetric = true,
          .least_range = 0.1,
          .compute = compute};
}

constexpr FieldEntry table[] = {
    {.choice = {"none", "None", "Show no map."}},
    {.choice = {"displacement", "Displacement",
                "Distance of each vertex from its position at rest, in percent of the model's diagonal."},
     .unit = "% of diagonal",
     .source = Source::surface,
     .least_range = 0.01,
     .compute =
         [](const FieldInput& in) { return distances(in.drawn, in.strain->rest(), in.strain->diagonal()); }},
    factor({"area", "Area change", "Surface area around each vertex, relative to rest."}, Source::surface,
           strain_means<area_log>),
    factor({"larger-stretch", "Larger stretch", "Length in the most stretched direction, relative to rest."},
           Source::surface, strain_means<larger_log>),
    factor(
        {"smaller-stretch", "Smaller stretch", "Length in the least stretched direction, relative to rest."},
        Source::surface, strain_means<smaller_log>),
    {.choice = {"shear", "Shear",
                "Ratio of the larger to the smaller stretch. It is 1 where angles are preserved."},
     .source = Source::surface,
     .needs_faces = true,
     .scale = Scale::log2,
     .least_range = 0.1,
     .compute = strain_means<shear_log>},
    {.choice = {"rotation", "Rotation",
                "Rotation angle of the surface around a vertex, at most 180 degrees."},
     .source = Source::surface,
     .needs_faces = true,
     .least_range = 5,
     .compute = [](const FieldInput& in) { return in.strain->turns(in.drawn, *in.pool); }},
    {.choice = {"energy", "Energy",
                "Symmetric Dirichlet energy minus its value at rest. It is 0 without stretching."},
     .source = Source::surface,
     .needs_faces = true,
     .scale = Scale::log10,
     .least_range = 2,
     .floor = 1e-6,
     .compute = strain_means<energy_of>},
    factor({"volume", "Volume change", "Volume relative to rest: the determinant of the blended stretch."},
           Source::matrices, volumes),
    {.choice = {"gap", "Eigenvalue gap",
                "Smallest gap between eigenvalues of the blended matrix, relative to the largest eigenvalue. "
                "Near 0, the published methods use special cases."},
     .unit = "relative",
     .source = Source::matrices,
     .scale = Scale::log10,
     .least_range = 2,
     .floor = 1e-17,
     .worst_is_least = true,
     .compute = gaps},
    {.choice = {"exp-error", "Exponential error",
                "Relative error of the current method's exponential, compared with 106-bit results."},
     .unit = "relative",
     .source = Source::matrices,
     .scale = Scale::log10,
     .least_range = 2,
     .floor = 1e-20,
     .compute = exp_errors},
    {.choice = {"frame-error", "Frame error",
                "Distance of each drawn vertex from its double precision result, in diagonals of the model."},
     .unit = "in diagonals",
     .source = Source::frame,
     .scale = Scale::log10,
     .least_range = 2,
     .floor = 1e-17,
     .compute = [](const FieldInput& in) { return distances(in.drawn, in.exact, in.strain->diagonal()); }},
    {.choice = {"influence", "Influence", "Weight of the selection at each vertex."},
     .source = Source::shares,
     .least_range = 0.01,
     .compute = [](const FieldInput& in) { return std::vector(in.shares.begin(), in.shares.end()); }},
    {.choice = {"difference", "Difference",
                "Distance of each vertex from its position in the first view, in diagonals."},
     .unit = "in diagonals",
     .source = Source::first,
     .scale = Scale::log10,
     .least_range = 3,
     .floor = 1e-12,
     .compute = [](const FieldInput& in) { return distances(in.drawn, in.first, in.strain->diagonal()); }},
    {.choice = {"signed-difference", "Signed difference",
                "Distance from the first view's surface along its normals: orange outside, blue inside."},
     .unit = "% of diagonal",
     .source = Source::first,
     .needs_faces = true,
     .symmetric = true,
     .least_range = 1e-4,
     .compute = signed_differences}};

float kept(const FieldEntry& e, double value) {
  if (e.scale != Scale::log10) return static_cast<float>(value);
  return std::isnan(value) ? 0.0F : static_cast<float>(std::log10(std::max(value, e.floor)));
}

double quantile(std::vector<float>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

// Rounds up to a power of 2^(1/6), so that the colour range does not flicker during editing.
double rounded_up(double value) {
  if (!(value > 0)) return 0;
  const double steps = std::ceil(6 * std::log2(value) - 1e-9);
  return std::exp2(steps / 6);
}

void fit_range(const FieldEntry& e, std::vector<float> values, FieldStats& stats) {
  constexpr double outliers = 0.005;
  if (e.scale == Scale::log10) {
    stats.low = std::floor(std::max(quantile(values, outliers), std::log10(e.floor)));
    stats.high = std::max(std::ceil(quantile(values, 1 - outliers)), stats.low + e.least_range);
    return;
  }
  const double high = std::max(quantile(values, 1 - outliers), 0.0);
  const double low = e.symmetric ? -std::min(quantile(values, outliers), 0.0) : 0;
  stats.high = std::max(rounded_up(std::max(high, low)), e.least_range);
  stats.low = e.symmetric ? -stats.high : 0;
}

// Sets the colour range from the errors of all methods on a sample of the matrices.
void fit_error_range(std::span<const sym3::Sym3<double>> matrices, FieldStats& stats) {
  constexpr std::size_t most = 4096;
  constexpr double floor = 1e-17, fewest_decades = 2;
  const std::size_t step = matrices.size() / most + 1;
  std::vector<sym3::Sym3<double>> sample;
  for (std::size_t i = 0; i < matrices.size(); i += step) sample.push_back(matrices[i]);
  double worst = floor;
  for (const sym3::Method method : compared_methods) {
    std::vector<sym3::Sym3<double>> computed(sample.size());
    sym3::exp<double>(sample, computed, method);
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const double error = sym3::relative_error(computed[i], sample[i]);
      worst = std::isnan(error) ? 1 : std::max(worst, error);
    }
  }
  stats.low = std::log10(floor);
  stats.high = std::clamp(std::ceil(std::log10(worst)), stats.low + fewest_decades, 0.0);
}

void find_extremes(const FieldEntry& e, std::span<const float> values, FieldStats& stats) {
  const auto [least, most] = std::ranges::minmax_element(values);
  stats.least = static_cast<double>(*least);
  stats.most = static_cast<double>(*most);
  const bool takes_least = e.worst_is_least || (e.symmetric && std::abs(stats.least) > std::abs(stats.most));
  stats.worst = static_cast<std::uint32_t>((takes_least ? least : most) - values.begin());
  std::vector<float> sorted(values.begin(), values.end());
  stats.median = quantile(sorted, 0.5);
}

}  // namespace

const FieldEntry& entry(Field field) {
  return table[static_cast<std::size_t>(field)];
}

std::span<const base::Choice> choices(Field) {
  static const std::vector<base::Choice> all = [] {
    std::vector<base::Choice> made;
    for (const FieldEntry& e : table) made.push_back(e.choice);
    return made;
  }();
  return all;
}

FieldValues measure(Field field, const FieldInput& input) {
  const FieldEntry& e = entry(field);
  FieldValues result;
  result.stats.field = field;
  result.stats.method = input.method;
  if (!e.compute) return result;
  const std::vector<double> values = e.compute(input);
  result.stats.vertices = values.size();
  if (values.empty()) return result;
  result.values.reserve(values.size());
  for (const double value : values) {
    result.stats.is_nan |= std::isnan(value);
    result.values.push_back(kept(e, value));
  }
  find_extremes(e, result.values, result.stats);
  if (field == Field::exp_error) {
    fit_error_range(input.matrices, result.stats);
  } else {
    fit_range(e, result.values, result.stats);
  }
  fit_counts(result.values, result.stats);
  return result;
}

void fit_counts(std::span<const float> values, FieldStats& stats) {
  stats.counts = {};
  const double bins = static_cast<double>(stats.counts.size()), width = stats.high - stats.low;
  for (const float value : values) {
    const double at = (static_cast<double>(value) - stats.low) / width * bins;
    ++stats.counts[static_cast<std::size_t>(std::clamp(at, 0.0, bins - 1))];
  }
}

std::string text(Field field, double value) {
  const FieldEntry& e = entry(field);
  if (e.scale == Scale::log10) return base::formatted("%.1e", std::pow(10, value));
  if (e.scale == Scale::log2) return base::formatted("%.3g x", std::exp2(value));
  if (field == Field::turn) return base::formatted("%.3g\u00b0", value);
  return base::formatted("%.3g %%", 100 * value);
}

}  // namespace viete::analysis
