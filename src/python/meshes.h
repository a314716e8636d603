// From numpy arrays to meshes of the library and back.
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

/// (n, 3) of any real type, order and strides, as doubles one after the other. Raises TypeError or ValueError
/// that names the function.
py::array_t<double> rows_of_3(const char* function, const py::object& object);
std::span<const double> numbers_of(const py::array_t<double>& array);
Points points_of(const char* function, const py::object& object);
py::array_t<double> array_of(const Points& points);

/// Faces: an array (m, k), or sequences of their own length each.
Mesh mesh_of(const char* function, const py::object& vertices, const py::object& faces);
/// (m, k) where all have as many corners, else a list.
py::object faces_of(const std::vector<std::uint32_t>& corners, const std::vector<std::uint32_t>& starts);

/// Of long work, see Watch: Ctrl-C ends it, as it ends Python's own.
void heed_signals(double done);

/// Makes the calls of one object take turns.
class CallLock {
public:
  /// Ask for it while holding Python's lock, lock it after releasing that one. A child of fork() gets a new
  /// one, because a thread that only the parent has may hold the old one.
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

/// Of a class of the module: an object whose __init__() was not called yet is refused. For
/// pybind11::detail::type_caster.
template <class T>
struct Initialised : py::detail::type_caster_base<T> {
  bool load(py::handle from, bool convert) {
    if (!py::detail::type_caster_base<T>::load(from, convert)) return false;
    auto* object = reinterpret_cast<py::detail::instance*>(from.ptr());
    if (object && !from.is_none() && !object->get_value_and_holder().holder_constructed())
      throw py::type_error("viete: __init__() of this object was not called yet");
    return true;
  }
};

}  // namespace viete::python
