#include "sym3/log.h"

#include "sym3/call_kernel.h"

namespace viete::sym3 {

template <class T>
Sym3<T> log(const Sym3<T>& s) {
  Sym3<T> out;
  call_one(&KernelFunctions<T>::log, &s.xx, &out.xx);
  return out;
}

template <class T>
Sym3<T> sqrt(const Sym3<T>& s) {
  Sym3<T> out;
  call_one(&KernelFunctions<T>::sqrt, &s.xx, &out.xx);
  return out;
}

template <class T>
Sym3<T> inv_sqrt(const Sym3<T>& s) {
  Sym3<T> out;
  call_one(&KernelFunctions<T>::inv_sqrt, &s.xx, &out.xx);
  return out;
}

template <class T>
Sym3<T> pow(const Sym3<T>& s, double p) {
  Sym3<T> out;
  call_one(&KernelFunctions<T>::pow, &s.xx, &out.xx, p);
  return out;
}

#define VIETE_FOR(T)                                                                                        \
  template Sym3<T> log(const Sym3<T>&);                                                                     \
  template Sym3<T> sqrt(const Sym3<T>&);                                                                    \
  template Sym3<T> inv_sqrt(const Sym3<T>&);                                                                \
  template Sym3<T> pow(const Sym3<T>&, double);                                                             \
  void log(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) {      \
    call_many(&KernelFunctions<T>::log, in, out, count, batch);                                             \
  }                                                                                                         \
  void sqrt(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) {     \
    call_many(&KernelFunctions<T>::sqrt, in, out, count, batch);                                            \
  }                                                                                                         \
  void inv_sqrt(const SymView<const T>& in, const SymView<T>& out, std::size_t count, const Batch& batch) { \
    call_many(&KernelFunctions<T>::inv_sqrt, in, out, count, batch);                                        \
  }                                                                                                         \
  void pow(const SymView<const T>& in, double p, const SymView<T>& out, std::size_t count,                  \
           const Batch& batch) {                                                                            \
    call_many(&KernelFunctions<T>::pow, in, out, count, batch, p);                                          \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
