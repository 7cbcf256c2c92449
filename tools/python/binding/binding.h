#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sphparam/gltf/texture_format.h"
#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/texture/convention.h"
#include "texts.h"

namespace sphparam::python {

namespace py = pybind11;

// Each file of this folder declares some of the module `_core`: what the library has, in its words,
// with arrays for tables. What users see is written in Python above it.

void declare_errors(py::module_& module);
void declare_meshes(py::module_& module);
void declare_repairs(py::module_& module);
void declare_mapped(py::module_& module);
void declare_maps(py::module_& module);
void declare_sphere(py::module_& module);
void declare_bakes(py::module_& module);
void declare_images(py::module_& module);
void declare_grids(py::module_& module);
void declare_exports(py::module_& module);
void declare_figures(py::module_& module);
void declare_matches(py::module_& module);
void declare_groups(py::module_& module);
void declare_wraps(py::module_& module);
void declare_assets(py::module_& module);

/// A mesh on its way to a map. Python holds it alone until it is mapped.
struct Source {
  MeshSource mesh;
};

/// How a map was made here: seconds by the clock, and of all processors; whether the surface
/// encloses a negative volume; what looked wrong with what was asked.
struct Making {
  double wall = 0, processors = 0;
  bool inside_out = false;
  std::vector<std::string> doubts = {};
};

/// A mesh with its proved map. Copies share it.
///
/// A map that was made here is proved already: it becomes a `MappedMesh`, which proves it again,
/// when that is first wanted, so that who wants its points alone waits for nothing more.
class Mapped {
 public:
  explicit Mapped(MappedMesh mesh);
  /// `made`: how it went; its map is that of the mesh.
  Mapped(MeshSource source, Topology topology, Provenance provenance, Parameterization made,
         Making making, int threads);

  /// In threads of Python it is made by a call, as all that takes a while. It is never left half
  /// made, for what it is made of is there once: who wants a mesh that could not be made hears why
  /// again.
  const MappedMesh& mesh() const;
  const SphereMap& map() const;
  const Certificate& certificate() const;

  /// Nothing where it was read.
  const std::optional<Parameterization>& made() const { return state_->made; }
  const Making& making() const { return state_->making; }  // by the library's call
  const std::vector<RepairAction>& repairs() const { return state_->repairs; }
  const std::vector<HandleLoop>& handles() const { return state_->handles; }
  double added_share() const { return state_->added_share; }

 private:
  struct State {
    std::optional<MappedMesh::Parts> parts = {};  // until the mesh is made
    int threads = 0;
    std::once_flag is_made = {};
    std::atomic<bool> was_made = false;  // or it failed
    std::optional<MappedMesh> mesh = {};
    std::exception_ptr failure = {};  // or why there is none
    std::optional<Parameterization> made = {};
    Making making = {};
    std::vector<RepairAction> repairs = {};
    std::vector<HandleLoop> handles = {};
    double added_share = 0;
  };
  void make_mesh() const;
  std::shared_ptr<State> state_;
};

/// A surface in harmonics, and of what it is told in files.
struct Expansion {
  HarmonicExpansion harmonics;
  std::string mesh;
  Provenance map;
};

/// It, with these coefficients: where they are others, of no known residuals.
HarmonicExpansion with_coefficients(const Expansion& expansion,
                                    const py::array_t<double, py::array::c_style>& coefficients);

/// A map that was to be one-to-one, and what is proved of it instead.
class NotOneToOne : public NotCertifiedError {
 public:
  NotOneToOne(const std::string& message, Certificate certificate)
      : NotCertifiedError(message), certificate_(std::move(certificate)) {}
  const Certificate& certificate() const { return certificate_; }

 private:
  Certificate certificate_;
};

py::dict as_dict(const Certificate& certificate);
py::dict as_dict(const DistortionSummary& summary);
py::dict as_dict(const SurfaceDistance& distance);
py::list as_list(const std::vector<MeshDefect>& defects);
py::list as_list(const std::vector<RepairAction>& actions);
py::list as_list(const std::vector<HandleLoop>& loops);

/// Words, and what they stand for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// Under the library's own words.
template <class Value>
Choices<Value> by_name(std::initializer_list<Value> values) {
  Choices<Value> choices;
  for (const Value value : values) choices.emplace_back(name_of(value), value);
  return choices;
}

/// Throws: py::value_error, which tells the words.
template <class Value>
Value chosen(const std::string& word, const Choices<Value>& choices, const char* argument) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    known += (known.empty() ? "'" : ", '") + name + "'";
  }
  throw py::value_error(std::string(argument) + ": no '" + word + "' among " + known);
}

/// Whether all numbers are finite and all indices those of vertices.
bool is_sound(const MeshInspection& found);

/// "sphparam", "gis" and so on. Throws: py::value_error.
Convention convention_of(const std::string& name);
/// What points up, and what is in front, in words of `direction_named`; nothing where they are
/// empty. Throws: py::value_error.
Up up_of(const std::string& up, const std::string& front);

/// Sets what a dictionary names; every name must be known.
class Settings {
 public:
  explicit Settings(const py::dict& values) : values_(values) {}

  /// Takes the value of this name, where there is one.
  template <class Value>
  Settings& take(const char* name, Value& value) {
    if (has(name)) value = cast<Value>(name);
    return *this;
  }
  /// The same for the name of a file.
  Settings& take_path(const char* name, std::string& value) {
    if (has(name)) value = cast<FilePath>(name);
    return *this;
  }
  /// The same for a word.
  template <class Value>
  Settings& take(const char* name, Value& value,
                 const Choices<std::type_identity_t<Value>>& choices) {
    if (has(name)) value = chosen(cast<std::string>(name), choices, name);
    return *this;
  }
  bool has(const char* name) {
    known_.add(name);
    return values_.contains(name);
  }
  /// Throws py::type_error for a name that nobody has asked for.
  void require_all_known() const {
    for (const auto& [name, value] : values_) {
      if (!known_.contains(name))
        throw py::type_error("no option is called " + py::cast<std::string>(name));
    }
  }

 private:
  template <class Value>
  Value cast(const char* name) const try {
    return py::cast<Value>(values_[name]);
  } catch (const py::cast_error&) {
    if (std::is_integral_v<Value> && py::isinstance<py::int_>(values_[name]))
      throw py::value_error(name +
                            (": beyond what it may be: " + std::string(py::str(values_[name]))));
    const auto given = py::cast<std::string>(py::str(py::type::of(values_[name]).attr("__name__")));
    throw py::type_error(std::string(name) + ": this cannot be a " + given);
  }

  const py::dict& values_;
  py::set known_;
};

/// Limits of what is read, by their names.
void take_limits(const py::dict& limits, ReadOptions& options);

/// What images of glTF files are made.
void take_textures(Settings& settings, TextureFormat& format, int& quality);

}  // namespace sphparam::python
