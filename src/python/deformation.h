// The deformer in Python: files, cages, bound models, shapes, poses and sessions.
#pragma once

#include <pybind11/pybind11.h>

namespace viete::python {

/// Defines Error and everything below.
void define_deformation(pybind11::module_& m);

/// Defines Surface, read, write, make_cage.
void define_files(pybind11::module_& m);
/// Defines Deformer.
void define_deformer(pybind11::module_& m);
/// Defines ShapeSpace, PoseSpace.
void define_spaces(pybind11::module_& m);
/// Defines Session.
void define_session(pybind11::module_& m);

}  // namespace viete::python
