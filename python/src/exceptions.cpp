#include "bindings.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/solvers/structure/condensation.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::python {

namespace py = pybind11;

namespace {

/// Lives as long as the process, as a translator may be called until its end.
PyObject* scene_error = nullptr;

/// Messages quote files that need not be UTF-8.
py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "replace"));
}

void raise(const app::SceneError& error) {
  py::object instance = py::reinterpret_borrow<py::object>(scene_error)(text_of(error.what()));
  const app::SceneError::Details& details = error.details();
  instance.attr("file") = text_of(details.file);
  instance.attr("line") = details.line;
  instance.attr("override") = text_of(details.override);
  instance.attr("key") = text_of(details.key);
  instance.attr("found") = text_of(details.found);
  instance.attr("allowed") = text_of(details.allowed);
  PyErr_SetObject(scene_error, instance.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const app::SceneError& error) {
    raise(error);
  } catch (const app::IoError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const app::PlotError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace

void add_exceptions(py::module_& module) {
  scene_error = py::exception<app::SceneError>(module, "SceneError", PyExc_ValueError).release().ptr();
  py::register_exception<solvers::InadmissiblePair>(module, "InadmissiblePair", PyExc_ValueError);
  py::register_exception<solvers::SingularSystem>(module, "SingularSystem", PyExc_ArithmeticError);
  py::register_exception_translator(&translate);
}

}  // namespace wavebalance::python
