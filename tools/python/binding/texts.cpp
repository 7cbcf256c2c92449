#include "texts.h"

namespace sphparam::python {

py::str as_text(const std::string& text) {
  PyObject* const decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (!decoded) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::list as_texts(const std::vector<std::string>& lines) {
  py::list list;
  for (const std::string& line : lines) list.append(as_text(line));
  return list;
}

}  // namespace sphparam::python
