#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

namespace sphparam::python {

namespace py = pybind11;

// Files have text of any encoding in them, and names of any bytes.

/// Text of a file, for people: what is no UTF-8 becomes U+FFFD.
py::str as_text(const std::string& text);
py::list as_texts(const std::vector<std::string>& lines);

/// The name of a file, with the bytes that it has: Python's `os.fsdecode` and `os.fsencode`.
struct FilePath : std::string {
  using std::string::string;
  FilePath(std::string name) : std::string(std::move(name)) {}
};

}  // namespace sphparam::python

namespace pybind11::detail {

template <>
class type_caster<sphparam::python::FilePath> {
 public:
  PYBIND11_TYPE_CASTER(sphparam::python::FilePath, const_name("str"));

  bool load(handle source, bool) {
    if (!PyUnicode_Check(source.ptr())) return false;
    const auto bytes = reinterpret_steal<object>(PyUnicode_EncodeFSDefault(source.ptr()));
    if (!bytes) PyErr_Clear();
    if (bytes) value.assign(PyBytes_AsString(bytes.ptr()), PyBytes_Size(bytes.ptr()));
    return static_cast<bool>(bytes);
  }

  static handle cast(const sphparam::python::FilePath& path, return_value_policy, handle) {
    return PyUnicode_DecodeFSDefaultAndSize(path.data(), static_cast<Py_ssize_t>(path.size()));
  }
};

}  // namespace pybind11::detail
