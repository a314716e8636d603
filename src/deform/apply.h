// Link 5 of the frame: from the blended sums of a vertex to its position.
#pragma once

#include <span>

#include "deform/blend.h"
#include "sym3/exp.h"

namespace viete::deform {

/// What shares make of the sums of vertices [begin, end): they count so many times, and centres are
/// completed. Nothing where shares are empty.
void share_sums(const Binding& binding, const Shares& shares, RowForm form, std::size_t begin,
                std::size_t end, std::span<double> sums);

/// Logs of the stretches of vertices [begin, end), from sums of RowForm::logs; link 4 takes their exponentials.
void stretch_logs(RowForm form, std::span<const double> sums, std::size_t begin, std::size_t end,
                  std::span<sym3::Sym3<double>> logs);

/// Vertices [begin, end) of positions, sums being shared already and of any form but moments. For logs
/// x' = origin + (exp(Y) exp(X) o + c'), stretches being exp(X). The forms and their letters: RowForm.
void apply(const Binding& binding, const Shares& shares, RowForm form, std::span<const double> sums,
           std::span<const sym3::Sym3<double>> stretches, const Vec3& origin, std::size_t begin,
           std::size_t end, std::span<mesh::Point> positions);

/// Links 4 and 5, of sums that are shared already: all vertices of the binding, whose rest, rest_origin,
/// offsets and shares count. Returns what place_vertices() does, if `error` is asked for.
double place_sums(const Binding& binding, RowForm form, std::span<const double> sums, const Vec3& origin,
                  sym3::Method method, std::span<mesh::Point> positions, bool error = false);

}  // namespace viete::deform
