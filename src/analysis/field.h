// Measures of a deformation: one number per vertex of the model.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/strain.h"
#include "base/choice.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::analysis {

/// The methods that users can compare.
inline constexpr std::array compared_methods = {sym3::Method::diag, sym3::Method::sd,
                                                sym3::Method::improved_sd, sym3::Method::fast};

enum class Field : unsigned char {
  none,
  displacement,
  area,
  larger_stretch,
  smaller_stretch,
  shear,
  turn,
  energy,
  volume,
  gap,
  exp_error,
  frame_error,
  influence,
  difference,
  signed_difference
};
std::span<const base::Choice> choices(Field);

/// The stored form of values: unchanged, or as logarithms.
enum class Scale : unsigned char { plain, log2, log10 };
/// The input that a field needs.
enum class Source : unsigned char {
  nothing,
  surface,   ///< positions at rest and as displayed
  matrices,  ///< the blended symmetric logarithm at each vertex
  frame,     ///< displayed positions, and positions in double precision
  shares,    ///< weight of the selection at each vertex
  first,     ///< displayed positions in this view and in the first view
};

struct FieldInput {
  const Strain* strain;                          ///< strain of the model at rest
  std::span<const mesh::Point> first;            ///< positions in the first view
  std::span<const mesh::Point> drawn, exact;     ///< `drawn`: displayed; `exact`: in double precision
  std::span<const sym3::Sym3<double>> matrices;  ///< one per vertex
  std::span<const double> shares;                ///< one per vertex
  sym3::Method method = sym3::Method::fast;      ///< the method whose error is computed
  base::WorkerPool* pool;                        ///< for surface fields
  base::Progress* progress = nullptr;            ///< for matrix fields; may be null
};

struct FieldEntry {
  base::Choice choice;
  std::string_view unit{};  ///< displayed after the title, for example "in diagonals"
  Source source = Source::nothing;
  bool needs_faces = false;  ///< true if the values are those of the surface around each vertex
  Scale scale = Scale::plain;
  bool symmetric = false;       ///< true if 0 is the value at rest and has the middle colour
  double least_range = 1;       ///< smallest range of the colours
  double floor = 0;             ///< smallest value before logarithms are taken
  bool worst_is_least = false;  ///< true if the smallest value is the worst, see FieldStats::worst
  std::vector<double> (*compute)(const FieldInput&) = nullptr;
};
const FieldEntry& entry(Field field);

/// Statistics of a field. Values are in stored form (logarithms if the entry's scale is logarithmic).
struct FieldStats {
  Field field = Field::none;
  sym3::Method method = sym3::Method::fast;  ///< the method of Field::exp_error
  std::size_t vertices = 0;                  ///< 0 if the field is not computed
  double least = 0, median = 0, most = 0;    ///< extremes and median; NaN counts as 0
  /// The vertex of the largest value. If FieldEntry::symmetric, the largest absolute value counts.
  std::uint32_t worst = 0;
  bool is_nan = false;  ///< true if a value is NaN
  /// The values of the first and the last colour. At most 0.5 % of the values are below `low`, and at most
  /// 0.5 % are above `high`.
  double low = 0, high = 1;
  std::array<std::uint32_t, 48> counts{};  ///< histogram: number of vertices per interval from low to high
};
struct FieldValues {
  std::vector<float> values;
  FieldStats stats;
};

/// Computes a field. `input` must have the data of the field's Source. Throws base::Cancelled. Thread-safe.
FieldValues measure(Field field, const FieldInput& input);
/// Recomputes the histogram from stats.low and stats.high.
void fit_counts(std::span<const float> values, FieldStats& stats);

/// Formats a value in stored form for display: "1.25 x", "3.2 %".
std::string text(Field field, double value);

}  // namespace viete::analysis
