// The native half of the Python package: thin, the names that users see are in python/camber.
#include <camber/base/error.hpp>
#include <camber/pipeline/version.hpp>

#include "bindings.hpp"

namespace camber::python {
namespace {

/// Raises the class of this name in camber._errors, with what, where and remedy.
void raise(const char* name, const Error& error) {
  const py::object type = py::module_::import("camber._errors").attr(name);
  const py::object exception = type(error.message(), error.where(), error.remedy());
  PyErr_SetObject(type.ptr(), exception.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const FileError& error) {
    raise("FileError", error);
  } catch (const MeshError& error) {
    raise("MeshError", error);
  } catch (const GeometryError& error) {
    raise("GeometryError", error);
  } catch (const OptionError& error) {
    raise("OptionError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

PythonProgress::PythonProgress(const py::object& callback) : callback_(callback) {}

void PythonProgress::keep_error() {
  py::error_already_set error;  // takes what Python has raised
  const std::scoped_lock lock(error_lock_);
  if (!error_) error_.emplace(std::move(error));
  is_cancelled_ = true;
}

Progress PythonProgress::progress() {
  Progress progress;
  if (!callback_.is_none()) {
    progress.report = [this](std::string_view stage, double fraction) {
      if (is_cancelled_) return;
      const py::gil_scoped_acquire gil;
      const py::str name(stage.data(), stage.size());
      const py::float_ done(fraction);
      PyObject* result =
          PyObject_CallFunctionObjArgs(callback_.ptr(), name.ptr(), done.ptr(), nullptr);
      if (result) {
        Py_DECREF(result);
      } else {
        keep_error();
      }
    };
  }
  progress.cancelled = [this] {
    if (is_cancelled_) return true;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) keep_error();
    return is_cancelled_.load();
  };
  return progress;
}

void PythonProgress::rethrow() {
  const std::scoped_lock lock(error_lock_);
  throw py::error_already_set(std::move(error_.value()));
}

}  // namespace camber::python

PYBIND11_MODULE(_camber, module) {
  namespace py = camber::python::py;
  module.doc() = "Native half of camber; use the names of the package camber.";
  py::register_exception_translator(camber::python::translate);
  module.attr("__version__") = std::string(camber::version());
  camber::python::bind_mesh(module);
  camber::python::bind_runs(module);
  camber::python::bind_pages(module);
}
