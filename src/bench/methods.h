// Every way to exp that the benchmarks compare: the paper's, ours, and what else people use.
#pragma once

#include <span>

#include "sym3/sym3.h"

namespace viete::bench {

struct ExpMethod {
  const char* name;
  sym3::Sym3<double> (*in_double)(const sym3::Sym3<double>&);
  sym3::Sym3<float> (*in_float)(const sym3::Sym3<float>&);
};

/// Diag, Direct (Eigen's closed-form computeDirect in place of QR), SD, Improved SD as printed and guarded,
/// Pade (scaling and squaring, Eigen's unsupported MatrixBase::exp), and Fast, one matrix a call.
std::span<const ExpMethod> exp_methods();

}  // namespace viete::bench
