#include "python/deformation.h"

#include <cctype>
#include <exception>
#include <string>

#include "base/error.h"

namespace viete::python {

namespace py = pybind11;

namespace {

// Options are words here: "--mean-value" is mean_value.
std::string in_python(const std::string& sentence) {
  std::string words;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    const bool begins = i == 0 || sentence[i - 1] == ' ';
    if (!begins || sentence.compare(i, 2, "--") != 0) {
      words += sentence[i];
      continue;
    }
    for (i += 2;
         i < sentence.size() && (std::isalpha(static_cast<unsigned char>(sentence[i])) || sentence[i] == '-');
         ++i)
      words += sentence[i] == '-' ? '_' : sentence[i];
    --i;
  }
  return words;
}

// Names of files need not be UTF-8: what is not comes as Python has it in paths.
void raise(PyObject* type, const std::string& sentence) {
  const auto text = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(sentence.data(), static_cast<py::ssize_t>(sentence.size()), "surrogateescape"));
  if (text) PyErr_SetObject(type, text.ptr());
}

}  // namespace

void define_deformation(py::module_& m) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "viete.Error", "What is wrong with files or arrays, and what to do.", PyExc_ValueError, nullptr);
  m.attr("Error") = py::reinterpret_borrow<py::object>(error);
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const base::Error& e) {
      raise(error, in_python(e.what()));
    }
  });
  define_files(m);
  define_deformer(m);
  define_spaces(m);
  define_session(m);
}

}  // namespace viete::python
