// Functions of affine maps on numpy arrays, for the module.
#pragma once

#include <pybind11/pybind11.h>

namespace viete::python {

/// affine_log, affine_exp, affine_has_log, affine_combine, affine_interpolate and affine_mean.
void define_affine(pybind11::module_& m);

}  // namespace viete::python
