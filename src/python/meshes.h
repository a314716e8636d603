// Conversion between numpy arrays and meshes.
#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "library/deform.h"
#include "python/matrices.h"

namespace viete::python {

using Points = std::vector<Point3>;

/// Converts an (n, 3) array of any real type, order and strides to contiguous doubles. Raises TypeError or
/// ValueError that names the function.
py::array_t<double> rows_of_3(const char* function, const py::object& object);
std::span<const double> numbers_of(const py::array_t<double>& array);
Points points_of(const char* function, const py::object& object);
py::array_t<double> array_of(const Points& points);

/// faces: an array (m, k), or sequences of different lengths.
Mesh mesh_of(const char* function, const py::object& vertices, const py::object& faces);
/// An array (m, k) if all faces have k corners, otherwise a list.
py::object faces_of(const std::vector<std::uint32_t>& corners, const std::vector<std::uint32_t>& starts);

/// A Watch that raises KeyboardInterrupt after Ctrl-C.
void heed_signals(double done);

/// Serialises the calls on one object.
class CallLock {
public:
  /// Call mutex() while holding the GIL, and lock it after releasing the GIL. A forked child gets a new
  /// mutex, because a thread of the parent may own the old one.
  std::mutex& mutex() {
    if (process_ != getpid()) {
      process_ = getpid();
      static_cast<void>(mutex_.release());
      mutex_ = std::make_unique<std::mutex>();
    }
    return *mutex_;
  }

private:
  pid_t process_ = getpid();
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

/// A type caster that rejects objects whose __init__() was not called, for pybind11::detail::type_caster.
template <class T>
struct Initialised : py::detail::type_caster_base<T> {
  bool load(py::handle from, bool convert) {
    if (!py::detail::type_caster_base<T>::load(from, convert)) return false;
    auto* object = reinterpret_cast<py::detail::instance*>(from.ptr());
    if (object && !from.is_none() && !object->get_value_and_holder().holder_constructed())
      throw py::type_error("viete: __init__() of this object was not called");
    return true;
  }
};

}  // namespace viete::python
