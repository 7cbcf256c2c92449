#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::python {

namespace py = pybind11;

// NumPy's arrays in, and the library's tables out. What goes in was looked at by Python already: a
// number type of the machine or its mirror image, two axes, three columns.

/// Doubles of any array of numbers, #×3, in whatever order its memory has; the array stays as it
/// is. `finite` becomes false where a number is none. Throws: py::type_error for other types.
Points points_of(const py::array& array, bool& finite);

/// Indices of any array of whole numbers, #×3. `inside` becomes false where one is none of 0 …
/// count − 1; what no int holds becomes −1.
Triangles triangles_of(const py::array& array, int count, bool& inside);

/// An array that shows memory which `owner` keeps; nobody may write to it.
template <class Scalar>
py::array shown(const Scalar* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array array(py::dtype::of<Scalar>(), std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class Table>
py::array shown_rows(const Table& table, py::handle owner) {
  return shown(table.data(), {table.rows(), table.cols()}, owner);
}

/// An array that owns what was moved into it, without a copy. The data must stay where it is when
/// the container moves, as that of vectors and tables does.
template <class Container>
py::array owning(Container&& container, std::vector<py::ssize_t> shape) {
  using Kept = std::decay_t<Container>;
  auto* const kept = new Kept(std::forward<Container>(container));
  const py::capsule owner(kept, [](void* pointer) { delete static_cast<Kept*>(pointer); });
  using Scalar = std::remove_cv_t<std::remove_reference_t<decltype(*kept->data())>>;
  return py::array(py::dtype::of<Scalar>(), std::move(shape), kept->data(), owner);
}

template <class Scalar>
py::array owning(std::vector<Scalar> values) {
  const auto count = static_cast<py::ssize_t>(values.size());
  return owning(std::move(values), {count});
}

template <class Table>
py::array owning_rows(Table table) {
  const std::vector<py::ssize_t> shape{table.rows(), table.cols()};
  return owning(std::move(table), shape);
}

/// The values of a property, in its own type.
py::array values_of(const Property& property);

/// Properties as a list of names and arrays.
py::list columns_of(const std::vector<Property>& properties);

}  // namespace sphparam::python
