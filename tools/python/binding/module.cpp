// The module `_core`: what the library has, for the Python that is written above it.

#include "binding.h"
#include "call.h"
#include "sphparam/version.h"

PYBIND11_MODULE(_core, module) {
  using namespace sphparam::python;
  module.doc() = "What the C++ library has; users want the package sphparam, which stands on it.";
  module.attr("version") = sphparam::version;
  declare_errors(module);
  declare_meshes(module);
  declare_repairs(module);
  declare_mapped(module);
  declare_maps(module);
  declare_sphere(module);
  declare_bakes(module);
  declare_images(module);
  declare_grids(module);
  declare_exports(module);
  declare_figures(module);
  declare_matches(module);
  declare_groups(module);
  declare_wraps(module);
  declare_assets(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(end_calls));
  using namespace py::literals;
  py::module_::import("os").attr("register_at_fork")("after_in_child"_a =
                                                         py::cpp_function(forget_calls));
}
