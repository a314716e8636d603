// The deformer for the module: files, cages, models bound to them, shapes, poses and sessions.
#pragma once

#include <pybind11/pybind11.h>

namespace viete::python {

/// All of the below, and Error.
void define_deformation(pybind11::module_& m);

/// Surface, read, write, make_cage.
void define_files(pybind11::module_& m);
/// Deformer.
void define_deformer(pybind11::module_& m);
/// ShapeSpace, PoseSpace.
void define_spaces(pybind11::module_& m);
/// Session.
void define_session(pybind11::module_& m);

}  // namespace viete::python
