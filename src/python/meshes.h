// Converts between numpy arrays and meshes. Protects objects from simultaneous calls.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "base/os.h"
#include "library/deform.h"
#include "python/matrices.h"

namespace viete::python {

/// Defines Error, Deformer and the classes and functions of define_files() and define_spaces().
void define_deformation(py::module_& m);
/// Defines Surface, read, write, make_cage.
void define_files(py::module_& m);
/// Defines ShapeSpace, PoseSpace, Session.
void define_spaces(py::module_& m);
/// Defines Splats.
void define_splats(py::module_& m);

using Points = std::vector<Point3>;

/// Converts an array (n, 3) of any real type and layout to contiguous doubles. Raises TypeError or
/// viete.Error with the name of the function.
Contiguous<double> rows_of_3(const char* function, const py::object& object);
std::span<const double> numbers_of(const Contiguous<double>& array);
Points points_of(const char* function, const py::object& object);
py::array_t<double> array_of(const Points& points);

/// Converts vertices and faces. `faces` is an array (m, k) or a list of sequences.
Mesh mesh_of(const char* function, const py::object& vertices, const py::object& faces);
/// If all faces have k corners, returns them as an array (m, k), otherwise as a list of arrays.
py::object faces_of(const Mesh& mesh);

/// A Watch. After Ctrl-C, it raises KeyboardInterrupt.
void heed_signals(double done);

/// An object that runs one call at a time, and releases the GIL during the call.
template <class T>
class Guarded {
public:
  T object;

  explicit Guarded(T&& made) : object(std::move(made)) {}
  template <class Act>
  auto with(const Act& act) {
    if (process_ != base::os::process_id()) {  // after fork(), another thread may have left the mutex locked
      process_ = base::os::process_id();
      static_cast<void>(mutex_.release());
      mutex_ = std::make_unique<std::mutex>();
    }
    std::mutex& mutex = *mutex_;
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex);
    return act(object);
  }

private:
  unsigned long process_ = base::os::process_id();
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

}  // namespace viete::python

/// Raises TypeError for an object whose __init__() was not called.
template <class T>
struct pybind11::detail::type_caster<viete::python::Guarded<T>>
    : pybind11::detail::type_caster_base<viete::python::Guarded<T>> {
  bool load(handle from, bool convert) {
    if (!type_caster_base<viete::python::Guarded<T>>::load(from, convert)) return false;
    auto* object = reinterpret_cast<instance*>(from.ptr());
    if (object && !from.is_none() && !object->get_value_and_holder().holder_constructed())
      throw type_error("viete: __init__() of this object was not called");
    return true;
  }
};
