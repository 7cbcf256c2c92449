// Exceptions of the library as those of the package: what is wrong with a mesh comes along as data.

#include <pybind11/stl.h>

#include <algorithm>

#include "binding.h"
#include "sphparam/bake/bake_errors.h"
#include "sphparam/bake/fields.h"
#include "sphparam/correspondence/likeness.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/gltf/export.h"
#include "sphparam/image/image_format.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/mesh_refusal.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/names.h"
#include "sphparam/paint/paint.h"

namespace sphparam::python {
namespace {

/// By a name that is always the same object: Python remembers where types have their attributes by
/// the address of the name, 4096 of them, and one made anew for each call would fill that up.
py::object attribute(const py::handle& owner, const char* name) {
  const auto kept = py::reinterpret_steal<py::object>(PyUnicode_InternFromString(name));
  return py::getattr(owner, kept);
}

py::object class_of(const char* name) {
  return attribute(py::module_::import("sphparam._errors"), name);
}

/// The message may have names of files in it, and words of these, and options of the program, which
/// are said as they are typed in Python.
void set_error(const py::handle& type, const std::string& message) {
  const py::object here = class_of("as_typed_here")(as_text(message));
  PyErr_SetObject(type.ptr(), here.ptr());
}

void raise(const char* name, const std::exception& error) {
  set_error(class_of(name), error.what());
}

/// Of `repair`, those keyword arguments that are not as they are unasked.
py::dict keywords(const RepairOptions& options) {
  py::dict wanted;
  const RepairOptions defaults;
  if (options.keep_holes) wanted["keep_holes"] = true;
  if (options.component > 0) wanted["component"] = options.component;
  if (options.weld_share >= 0) wanted["weld_share"] = options.weld_share;
  if (options.largest_hole != defaults.largest_hole) wanted["largest_hole"] = options.largest_hole;
  if (options.longest_handle != defaults.longest_handle) {
    wanted["longest_handle"] = options.longest_handle;
  }
  return wanted;
}

/// What the parts of a mesh need; None where nothing maps them all.
py::object advice(const PartsTrial* parts) {
  if (!parts || parts->mended < parts->parts) return py::none();
  return py::make_tuple(parts->as_they_are, keywords(parts->options));
}

/// What would mend a mesh that was refused, and what else there is.
py::object advice(const RepairTrial& trial, const PartsTrial* parts) {
  const auto fills = [](const RepairAction& done) { return done.kind == RepairKind::HoleFilled; };
  py::dict found;
  found["options"] = keywords(trial.options);
  found["actions"] = as_list(trial.actions);
  found["remaining"] = as_list(trial.remaining);
  found["kept"] = kept_share(trial);
  found["fills"] = std::ranges::any_of(trial.actions, fills);
  found["parts"] = advice(parts);
  found["wrap"] = wrap_keeps_more(trial);
  return std::move(found);
}

void raise_mesh_error(const MeshError& error) {
  const auto* const refusal = dynamic_cast<const MeshRefusal*>(&error);
  const auto* const of_parts = dynamic_cast<const PartsRefusal*>(&error);
  py::object trial = py::none();
  if (refusal && refusal->trial())
    trial = advice(*refusal->trial(), of_parts ? &of_parts->parts() : nullptr);
  const py::object type = class_of("MeshError");
  const py::object value = attribute(type, "_of")(as_list(error.defects()), trial);
  PyErr_SetObject(type.ptr(), value.ptr());
}

void raise_not_one_to_one(const NotOneToOne& error) {
  const py::object type = class_of("NotCertified");
  const py::object value =
      attribute(type, "_of")(as_text(error.what()), as_dict(error.certificate()));
  PyErr_SetObject(type.ptr(), value.ptr());
}

/// With the names that there are.
void raise_field_error(const FieldError& error) {
  std::string known;
  for (const std::string& name : error.known())
    known += (known.empty() ? "; there are " : ", ") + name;
  set_error(PyExc_ValueError, error.what() + known);
}

template <class... Errors>
bool is_one_of(const std::exception& error) {
  return (dynamic_cast<const Errors*>(&error) || ...);
}

/// Whether it says all of what is wrong with something that was given.
bool is_of_a_value(const std::exception& error) {
  return is_one_of<UnmeasurableMesh, LookError, ImageOfOtherChart, UnlikeSurfaces, OtherSphereError,
                   AtlasError, NoSuchComponent, std::invalid_argument, std::range_error>(error);
}

}  // namespace

void declare_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const MeshError& error) {
      raise_mesh_error(error);
    } catch (const NotOneToOne& error) {
      raise_not_one_to_one(error);
    } catch (const NotCertifiedError& error) {
      raise("NotCertified", error);
    } catch (const UnreachableLandmarks& error) {
      raise("NotCertified", error);
    } catch (const MirroredLandmarks& error) {
      raise("NotCertified",
            std::runtime_error(error.what() + std::string("; match(…, mirror=True) or False")));
    } catch (const Cancelled& error) {
      raise("Cancelled", error);
    } catch (const ReadError& error) {
      raise("ReadError", error);
    } catch (const WriteError& error) {
      raise("WriteError", error);
    } catch (const ImageError& error) {
      raise("ImageError", error);
    } catch (const SolveError& error) {
      raise("SolveError", error);
    } catch (const FieldError& error) {
      raise_field_error(error);
    } catch (const BakeSettingError& error) {
      const std::string name = error.setting() == "width"  ? "size"
                               : error.setting() == "from" ? "surface"
                                                           : error.setting();
      set_error(PyExc_ValueError, name + ": " + error.reason());
    } catch (const FrontError& error) {
      set_error(PyExc_ValueError, std::string("front: ") + error.what());
    } catch (const NoSuchVertex& error) {
      set_error(PyExc_ValueError, error.whose() + ": " + error.what());
    } catch (const std::exception& error) {
      if (!is_of_a_value(error)) throw;
      set_error(PyExc_ValueError, error.what());
    }
  });
}

}  // namespace sphparam::python
