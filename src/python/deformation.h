// The deformer for the module: files, cages, models bound to them, shapes, poses and sessions.
#pragma once

#include <pybind11/pybind11.h>

namespace viete::python {

/// read, write, make_cage, Deformer, ShapeSpace, PoseSpace, Session, and Error.
void define_deformation(pybind11::module_& m);

}  // namespace viete::python
