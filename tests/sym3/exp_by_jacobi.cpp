// The kernels' fallback for exp, called directly: right on ordinary matrices too.
#include "sym3/fallback.h"

#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

TEST_CASE("exp_by_jacobi_is_exact_to_16_u_at_any_spread") {
  for (const double spread : {0.0, 1e-9, 1.0, 30.0, 700.0, 1300.0}) {
    for (const auto& s : spreads<double>(spread, -0.6 * spread, 300)) {
      const double in[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
      double out[6];
      sym3::exp_by_jacobi(in, out);
      CHECK(error_in_u(sym3::Sym3<double>{out[0], out[1], out[2], out[3], out[4], out[5]},
                       quad_exp(to_quad(s))) <= 16);
    }
  }
}

TEST_CASE("exp_by_jacobi_works_in_place") {
  double matrix[6] = {1, 2, 3, 4, 5, 6}, copy[6];
  sym3::exp_by_jacobi(matrix, copy);
  sym3::exp_by_jacobi(matrix, matrix);
  for (int i = 0; i < 6; ++i) CHECK(matrix[i] == copy[i]);
}
