#include "sym3/route.h"

#include <doctest/doctest.h>

#include <limits>

using namespace viete::sym3;

TEST_CASE("a_route_says_which_case_of_the_paper_and_how_often_fast_squares") {
  const Sym3<double> apart{0.5, 0.1, 0, -0.2, 0.05, 0.9}, pair{1, 0, 0, 1, 0, 3}, all{2, 0, 0, 2, 0, 2};
  for (const Method method : {Method::sd, Method::improved_sd}) {
    CHECK(route(apart, method).distinct == 3);
    CHECK(route(pair, method).distinct == 2);
    CHECK(route(all, method).distinct == 1);
    // The paper's threshold is 1e-6.
    CHECK(route({1, 0, 0, 1 + 3e-6, 0, 3}, method).distinct == 3);
    CHECK(route({1, 0, 0, 1 + 3e-7, 0, 3}, method).distinct == 2);
  }
  CHECK(route(apart, Method::diag) == Route{});
  CHECK(route(apart, Method::fast) == Route{.degree = 21});
  CHECK(route(all, Method::fast) == Route{.degree = 21});
  // |A|^2 / 2 = 8 is the limit; each halving quarters it.
  const auto spread = [](double x) { return Sym3<double>{x, 0.1, 0, -x, 0, 0}; };
  CHECK(route(spread(2.8), Method::fast).squarings == 0);
  CHECK(route(spread(2.9), Method::fast).squarings == 1);
  CHECK(route(spread(12), Method::fast).squarings == 3);
  CHECK(route(spread(1e4), Method::fast).by_jacobi);
  CHECK(route({20, 0, 0, -20, 0, 1}, Method::fast).by_jacobi);  // diagonal
  CHECK(route({800, 0.1, 0, 0, 0, 0}, Method::fast).by_jacobi);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(route({nan, 0, 0, 0, 0, 0}, Method::fast).by_jacobi);
  CHECK(route({nan, 0, 0, 0, 0, 0}, Method::sd) == Route{});
}
