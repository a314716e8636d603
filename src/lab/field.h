// Fields: a number at each vertex of the model, that says what a deformation does there. One table of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "lab/strain.h"
#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::lab {

/// Those that a person chooses from.
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
  opening,
  difference,
  signed_difference
};
std::span<const base::Choice> choices(Field);

/// How a value is kept: as it is, or as its logarithm.
enum class Scale : unsigned char { plain, log2, log10 };
/// What values are computed of.
enum class Source : unsigned char {
  nothing,
  surface,   ///< positions at rest and as they are drawn
  matrices,  ///< the symmetric logs that vertices blend: there must be a blend that takes exponentials
  frame,     ///< positions as they are drawn, and in double
  shares,    ///< how much of the selection's motion a vertex takes
  first,     ///< positions as they are drawn, here and in the first of several views
};

struct FieldInput {
  const Strain* strain;                          ///< of the model at rest
  std::span<const mesh::Point> first;            ///< where the first view has them
  std::span<const mesh::Point> drawn, exact;     ///< in the file's units
  std::span<const sym3::Sym3<double>> matrices;  ///< one a vertex
  std::span<const double> shares;                ///< one a vertex
  sym3::Method method = sym3::Method::fast;      ///< whose error it is
  base::WorkerPool* pool;                        ///< of surfaces
  base::Progress* progress = nullptr;            ///< of matrices; may be null
};

struct FieldEntry {
  Field field;
  base::Choice choice;
  std::string_view unit{};  ///< shown with the title: "in diagonals"
  Source source = Source::nothing;
  Scale scale = Scale::plain;
  bool symmetric = false;  ///< 0 is what it is where nothing happens, in the middle of the colours
  double least_range = 1;  ///< the colours span at least this
  double floor = 0;        ///< of logarithms: what smaller values count as
  bool worst_is_least = false;
  bool has_directions = false;  ///< see strokes()
  std::vector<double> (*compute)(const FieldInput&) = nullptr;
};
const FieldEntry& entry(Field field);

/// As values are kept: logarithms where the entry's scale is one.
struct FieldStats {
  Field field = Field::none;
  sym3::Method method = sym3::Method::fast;  ///< of its error
  std::size_t vertices = 0;                  ///< 0: not computed
  double least = 0, median = 0, most = 0;    ///< of finite values
  std::uint32_t worst = 0;  ///< the vertex of the most, or where that says more, of the least
  bool is_nan = false;      ///< some value was none
  /// From the first colour to the last one. Outliers, half a per cent, are beyond, and have the colours of
  /// the ends.
  double low = 0, high = 1;
  std::array<std::uint32_t, 48> counts{};  ///< of vertices, from low to high, evenly
};
struct FieldValues {
  std::vector<float> values;
  FieldStats stats;
};

/// The source of the field must be given. Throws base::Cancelled. Thread-safe.
FieldValues measure(Field field, const FieldInput& input);
/// Short lines on the surface, pairs of ends in the file's units: along them it is stretched, or squeezed, as
/// their length says. Of fields that have directions, else none.
std::vector<mesh::Point> strokes(const FieldStats& stats, const FieldInput& input);
/// Counts anew from low to high, which stay.
void fit_counts(std::span<const float> values, FieldStats& stats);

/// "1.25x", "12.5 deg", "3.2 %": a value as it is kept, as people read it.
std::string text(Field field, double value);

}  // namespace viete::lab
