// Runs one named kernel, whatever this machine would choose.
#pragma once

#include "sym3/exp.h"
#include "sym3/kernel.h"

namespace viete::test {

/// `count` matrices of six numbers each.
template <class T>
void run(const sym3::Kernel& kernel, const T* in, T* out, std::size_t count) {
  sym3::exp(sym3::SymView<const T>(sym3::Layout::packed, in), sym3::SymView<T>(sym3::Layout::packed, out),
            count, {&kernel});
}

template <class T>
sym3::Sym3<T> exp_with(const sym3::Kernel& kernel, const sym3::Sym3<T>& s) {
  sym3::Sym3<T> out;
  run(kernel, &s.xx, &out.xx, 1);
  return out;
}

}  // namespace viete::test
