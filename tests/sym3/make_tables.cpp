// Computes the coefficients of the files *_tables.h in 113 bits, prints them, and compares them with the
// headers. Interpolated coefficients must be equal after rounding. Minimax coefficients may differ, but the
// error of the header's polynomial must be at most the documented error.
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>

#include "sym3/approximation.h"
#include "sym3/exp_tables.h"
#include "sym3/rotation_tables.h"
#include "sym3/spectral_tables.h"

using namespace viete::sym3;
using namespace viete::test;

namespace {

bool failed = false;

template <class T>
constexpr double u = sizeof(T) == 8 ? 0x1p-53 : 0x1p-24;

template <class T, std::size_t N>
Polynomial as_quad(const T (&table)[N], Quad unit = 1) {
  Polynomial p;
  for (const T c : table) p.push_back(c * unit);
  return p;
}

template <class T>
void print(const std::string& name, const Polynomial& p, Quad unit = 1) {
  std::printf("%s, %s:\n ", name.c_str(), sizeof(T) == 8 ? "double" : "float");
  for (const Quad c : p) std::printf(" %a", static_cast<double>(static_cast<T>(c / unit)));
  std::printf("\n");
}

void report(bool ok, const std::string& what) {
  std::printf("  %s%s\n", what.c_str(), ok ? "" : " - FAILED");
  failed = failed || !ok;
}

template <class T, std::size_t N>
void check_interpolated(const std::string& name, const T (&table)[N], const QuadFunction& f, Quad end) {
  const Polynomial p = interpolated(f, end, N);
  print<T>(name, p);
  int different = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const Quad ulp = std::nextafter(std::fabs(table[k]), T(2)) - std::fabs(table[k]);
    different += fabsq(p[k] - table[k]) > 0.6Q * ulp;  // 0.5 for rounding, and 0.1 for the error of 113 bits
  }
  report(different == 0, std::to_string(different) + " of " + std::to_string(N) + " differ");
}

/// `error` is the error that the header documents, in u.
template <class T>
void check_minimax(const std::string& name, const Target& t, const Polynomial& made, const Polynomial& table,
                   double error, Quad unit = 1) {
  print<T>(name, made, unit);
  const auto in_u = [](Quad x) { return static_cast<double>(x) / u<T>; };
  const double of_made = in_u(largest(t.errors(made))), of_table = in_u(largest(t.errors(table)));
  char text[100];
  std::snprintf(text, sizeof text, "largest error %.5f u, of the header %.5f u", of_made, of_table);
  report(of_table <= error && of_made <= 1.1 * error, text);
}

Quad one(Quad) {
  return 1;
}

// Returns f(sqrt(x)). `at_zero` is the value at 0.
QuadFunction of_root(Quad (*f)(Quad), Quad at_zero) {
  return [=](Quad x) { return x > 0 ? f(sqrtq(x)) : at_zero; };
}

template <class T>
void spectral() {
  using C = SpectralTables<T>;
  check_interpolated("sin((2/3) atan x) / x", C::sine,
                     of_root([](Quad x) { return sinq(2 * atanq(x) / 3) / x; }, Quad(2) / 3), 1);
  check_interpolated("cos((2/3) atan x)", C::cosine,
                     of_root([](Quad x) { return cosq(2 * atanq(x) / 3); }, 1), 1);
  check_interpolated("atanh x / x", C::atanh, of_root([](Quad x) { return atanhq(x) / x; }, 1), 0.0445Q);
}

template <class T>
void rotations(double cosine_error, double sine_error, double arc_error) {
  using C = RotationTables<T>;
  const Target cosine = {of_root(cosq, 1), one, 0, 2.63Q};
  const Target sine = {of_root([](Quad x) { return sinq(x) / (2 * x); }, 0.5), one, 0, 2.63Q};
  const auto arc_of_root = of_root([](Quad x) { return atanq(x) / x; }, 1);
  const Target arc = {arc_of_root, [=](Quad x) { return 1 / arc_of_root(x); }, 0, 1};
  const auto make = [](const Target& t, Quad first, int count) {
    return rounded_minimax<T>(t, {first}, count, count);
  };
  check_minimax<T>("cos x", cosine, make(cosine, 1, std::size(C::cosine)), as_quad(C::cosine), cosine_error);
  check_minimax<T>("sin x / (2 x)", sine, make(sine, 0.5, std::size(C::sine)), as_quad(C::sine), sine_error);
  Polynomial both;
  for (std::size_t k = 0; k < std::size(C::arc_even) + std::size(C::arc_odd); ++k)
    both.push_back(k % 2 ? C::arc_odd[k / 2] : C::arc_even[k / 2]);
  check_minimax<T>("atan x / x", arc, make(arc, 1, static_cast<int>(both.size())), both, arc_error);
}

/// Returns the number with the most accurate reciprocal in T, among x and the next 2000 smaller numbers. The
/// callers divide coefficients by this number, so that the rounded polynomial is accurate at 0.
template <class T>
T divisor_of_one(T x) {
  T best = x;
  for (int i = 0; i < 2000; ++i) {
    x = std::nextafter(x, T(0));
    if (fabsq(rounded<T>(1, x) - 1) < fabsq(rounded<T>(1, best) - 1)) best = x;
  }
  return best;
}

/// Returns f at the possible eigenvalues of A. The weights make errors relative to the norm (exp_tables.h).
template <class T>
Target matrix_target(const QuadFunction& f) {
  const Quad reach = 2 * sqrtq(Quad(ExpTables<T>::p_limit) / 3);
  return {f, [](Quad x) { return 1 / std::max(expq(x), expq(-x / 2)); }, -reach, reach};
}

template <class T>
void exponential(double matrix_error, double scalar_error) {
  using C = ExpTables<T>;
  constexpr int count = std::size(C::matrix_exp), scalar_count = std::size(C::scalar_exp);
  const Target matrix = matrix_target<T>(expq);
  const Quad lead = divisor_of_one(static_cast<T>(minimax(matrix, Polynomial(count, 0), 0).back()));
  std::printf("lead %a, of the header %a\n", static_cast<double>(lead), static_cast<double>(C::lead));
  const Target rest = matrix_target<T>([=](Quad x) { return expq(x) - lead * powq(x, count - 1); });
  Polynomial made = rounded_minimax<T>(rest, {rounded<T>(1, lead)}, count - 1, count - 1, lead);
  made.push_back(lead);
  check_minimax<T>("e^x / lead", matrix, made, as_quad(C::matrix_exp, C::lead), matrix_error, lead);
  const Target scalar = {expq, [](Quad x) { return expq(-x); }, -0.3467Q, 0.3467Q};
  check_minimax<T>("e^r", scalar, rounded_minimax<T>(scalar, {1, 1}, scalar_count, scalar_count),
                   as_quad(C::scalar_exp), scalar_error);
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(p[k] * static_cast<int>(k));
  return d;
}

/// Computes and checks the polynomial whose derivative is minimax.
template <class T>
void exponential_with_derivative(double error, double derivative_error) {
  using C = ExpDerivativeTables<T>;
  constexpr int count = std::size(C::matrix_exp);
  const Target matrix = matrix_target<T>(expq);
  Polynomial slope = {1}, made = {1};  // exact for the zero matrix
  slope.resize(count - 1, 0);
  slope = minimax(matrix, slope, 1);
  for (int k = 1; k < count; ++k) made.push_back(slope[k - 1] / k);
  const Quad lead = divisor_of_one(static_cast<T>(made.back()));
  made.back() = lead;
  for (Quad& c : made) c = rounded<T>(c, lead);
  std::printf("lead %a, of the header %a\n", static_cast<double>(lead), static_cast<double>(C::lead));
  const Polynomial table = as_quad(C::matrix_exp, C::lead);
  check_minimax<T>("e^x / lead, differentiable", matrix, made, table, error, lead);
  check_minimax<T>("its derivative", matrix, derivative(made), derivative(table), derivative_error, lead);
}

}  // namespace

int main() {
  spectral<double>();
  spectral<float>();
  rotations<double>(0.07, 0.0021, 0.09);
  rotations<float>(1.3, 0.07, 0.19);
  exponential<double>(0.45, 0.04);
  exponential<float>(0.51, 0.06);
  exponential_with_derivative<double>(0.56, 1.29);
  exponential_with_derivative<float>(0.38, 0.51);
  return failed;
}
