#pragma once
// What the binding files share: arrays that look at C++ memory, and progress from Python.
#include <camber/base/progress.hpp>
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace camber::python {

namespace py = pybind11;

/// A NumPy array that looks at `size` values of `owner`'s memory and keeps it alive: no copy.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, py::handle owner,
                  bool is_writable) {
  py::array_t<T> array(std::move(shape), data, owner);
  if (!is_writable) {
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  }
  return array;
}

template <class T>
py::array view_of(const std::vector<T>& values, py::handle owner) {
  return view_of(values.data(), {static_cast<py::ssize_t>(values.size())}, owner, false);
}

/// Points as an (n, 3) array.
inline py::array view_of(const Vec3* data, std::size_t count, py::handle owner, bool is_writable) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view_of(reinterpret_cast<const double*>(data), {static_cast<py::ssize_t>(count), 3}, owner,
                 is_writable);
}

/// A CAD and who may use it: runs set its scale, so that they take turns.
struct Geometry {
  std::string path;
  std::unique_ptr<GeometryModel> model;
  bool is_cad = true;  // or without tags for a mesh, in its unit (pipeline/geometry_source.hpp)
  std::mutex turn;
};

/// Calls a Python function (stage, fraction) from C++ that runs without the GIL. What the function
/// raises, or Ctrl-C, cancels the run; rethrow() gives it to the caller.
class PythonProgress {
 public:
  explicit PythonProgress(const py::object& callback);
  [[nodiscard]] Progress progress();
  /// With the GIL held, after the run threw Cancelled.
  [[noreturn]] void rethrow();

 private:
  void keep_error();

  py::object callback_;
  std::optional<py::error_already_set> error_;
  std::mutex error_lock_;
  std::atomic<bool> is_cancelled_ = false;
};

void bind_mesh(py::module_& module);
void bind_pages(py::module_& module);
void bind_runs(py::module_& module);

}  // namespace camber::python
