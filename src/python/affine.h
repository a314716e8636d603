// Functions of affine maps on numpy arrays.
#pragma once

#include <pybind11/pybind11.h>

namespace viete::python {

/// Defines affine_log, affine_exp, affine_has_log, affine_combine, affine_interpolate and affine_mean.
void define_affine(pybind11::module_& m);

}  // namespace viete::python
