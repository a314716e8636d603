#include "python/deformation.h"

#include <exception>
#include <string>

#include "base/error.h"

namespace viete::python {

namespace py = pybind11;

namespace {

// Messages may contain file names that are not UTF-8; these are decoded as Python decodes paths.
void raise(PyObject* type, const std::string& sentence) {
  const auto text = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(sentence.data(), static_cast<py::ssize_t>(sentence.size()), "surrogateescape"));
  if (text) PyErr_SetObject(type, text.ptr());
}

}  // namespace

void define_deformation(py::module_& m) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "viete.Error", "Raised for invalid files and arrays; the message says what is wrong and what to do.",
      PyExc_ValueError, nullptr);
  m.attr("Error") = py::reinterpret_borrow<py::object>(error);
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const base::Error& e) {
      raise(error, e.what());
    }
  });
  define_files(m);
  define_deformer(m);
  define_spaces(m);
  define_session(m);
}

}  // namespace viete::python
