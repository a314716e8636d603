#include "sym3/exp.h"

#include <cassert>
#include <type_traits>

#include "sym3/call_kernel.h"
#include "sym3/exp_paper.h"

namespace viete::sym3 {

namespace {

constexpr MethodEntry table[] = {
    {Method::diag, "diag", "Diag", "Full diagonalisation by QR."},
    {Method::sd, "sd", "SD", "Spectral decomposition with eigenvalues by QR."},
    {Method::improved_sd, "improved_sd", "Improved SD",
     "Spectral decomposition with eigenvalues by Viete's formula."},
    {Method::improved_sd_faithful, "improved_sd_faithful", "ISD unguarded",
     "Improved SD (ISD) without checks: NaN for many matrices with equal eigenvalues."},
    {Method::fast, "fast", "Fast", "A recurrence in two invariants that needs no eigenvalues (default)."},
};

// The kernels read and write a Sym3 as six contiguous numbers.
static_assert(sizeof(Sym3<double>) == 6 * sizeof(double) && sizeof(Sym3<float>) == 6 * sizeof(float));
static_assert(std::is_standard_layout_v<Sym3<double>> && std::is_standard_layout_v<Sym3<float>>);

template <class T>
Sym3<T> exp_fast(const Sym3<T>& s) {
  return call_one<Sym3<T>>(&KernelFunctions<T>::exp, &s.xx);
}

template <class T>
auto one_by(Method method) -> Sym3<T> (*)(const Sym3<T>&) {
  switch (method) {
    case Method::diag: return exp_diag<T>;
    case Method::sd: return exp_sd<T>;
    case Method::improved_sd: return exp_improved_sd<T>;
    case Method::improved_sd_faithful: return exp_improved_sd_faithful<T>;
    case Method::fast: break;
  }
  return exp_fast<T>;
}

}  // namespace

std::span<const MethodEntry> methods() {
  return table;
}

std::string_view name(Method method) {
  return table[static_cast<std::size_t>(method)].name;
}

std::string_view label(Method method) {
  return table[static_cast<std::size_t>(method)].label;
}

std::optional<Method> method_from_name(std::string_view name) {
  for (const MethodEntry& entry : table) {
    if (entry.name == name) return entry.method;
  }
  return std::nullopt;
}

template <class T>
Sym3<T> exp(const Sym3<T>& s, Method method) {
  if (method == Method::fast) return exp_fast(s);
  return one_by<T>(method)(s);
}

template <class T>
void exp(std::span<const Sym3<T>> in, std::span<Sym3<T>> out, Method method) {
  assert(in.size() == out.size());
  if (method == Method::fast) return exp(packed(in.data()), packed(out.data()), in.size());
  const auto one = one_by<T>(method);
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = one(in[i]);
}

#define VIETE_FOR(T)                                                                                   \
  template Sym3<T> exp(const Sym3<T>&, Method);                                                        \
  template void exp(std::span<const Sym3<T>>, std::span<Sym3<T>>, Method);                             \
  void exp(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) { \
    call_many(&KernelFunctions<T>::exp, in, out, count, batch);                                        \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
