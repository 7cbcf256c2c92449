#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/polygons.h"

namespace sphparam {

// What legacy and XML files of VTK share: named arrays of tuples, of points and of cells, and what
// these are among the properties of a mesh file.

/// Types of numbers that VTK writes. Whole numbers of 64 bits are kept as Int32 where all fit,
/// else as Int64.
enum class VtkType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Uint64, Float32, Float64 };

/// Calls function(T{}) with a value of the C++ type behind `type`.
template <class Function>
decltype(auto) with_vtk_type(VtkType type, Function&& function) {
  switch (type) {
    case VtkType::Int64:
      return function(std::int64_t{});
    case VtkType::Uint64:
      return function(std::uint64_t{});
    case VtkType::Int8:
      return function(std::int8_t{});
    case VtkType::Uint8:
      return function(std::uint8_t{});
    case VtkType::Int16:
      return function(std::int16_t{});
    case VtkType::Uint16:
      return function(std::uint16_t{});
    case VtkType::Int32:
      return function(std::int32_t{});
    case VtkType::Uint32:
      return function(std::uint32_t{});
    case VtkType::Float32:
      return function(float{});
    case VtkType::Float64:
      break;
  }
  return function(double{});
}

std::size_t size_in_bytes(VtkType type);

/// What is done with the digits of texts that are declared as float32: the numbers are rounded to
/// that, or are doubles where one of them says more than it holds.
enum class TextDigits { AsDeclared, AllThatMatter };

/// Floats of a text, one after another.
class Float32Texts {
 public:
  explicit Float32Texts(TextDigits digits) : digits_(digits) {}

  /// `value`: the double that `text` is.
  void look_at(std::string_view text, double value);

  /// Of the values that were looked at: rounds them, or makes the type Float64. Others stay.
  void settle(VtkType& type, std::vector<double>& values) const;

 private:
  TextDigits digits_;
  bool exceed_ = false;
};

/// What an array stands for, beside its name.
enum class VtkRole { Plain, Normals, Texcoords, Colours };

/// Tuples of numbers, one after another.
struct VtkArray {
  std::string name = {};
  ScalarType type = ScalarType::Float64;
  std::int64_t width = 1;  // numbers a tuple
  std::vector<double> values = {};
  VtkRole role = VtkRole::Plain;
  std::vector<std::string> component_names = {};  // `width` of them, or none

  std::int64_t count() const { return static_cast<std::int64_t>(values.size()) / width; }
};

/// The type under which such numbers are kept: whole numbers of 64 bits as Int32 where all fit,
/// else as Int64, or as Float64 beyond that; those that doubles round are told.
ScalarType kept_type(VtkType type, const VtkArray& array, std::vector<std::string>& notes);

/// That of an array in two pieces: whole numbers stay labels.
ScalarType common_type(ScalarType first, ScalarType second);

/// What a polydata holds, as it was read.
struct VtkSurface {
  std::optional<VtkArray> points;
  Polygons polygons;
  std::int64_t other_cells = 0;  // vertices and lines: they come before the polygons
  bool has_strips = false;       // among the polygons, as triangles
  long turns = 0;                // triangles of strips that name a vertex twice
  std::vector<VtkArray> point_arrays, cell_arrays;
  std::vector<std::string> comments, materials, notes;
};

/// Adds the triangles of a strip, which has the corners `strip`; every other one is turned over,
/// those that name a vertex twice are left out. Returns what is wrong; empty when all is well.
std::string add_strip(VtkSurface& surface, const std::vector<int>& strip,
                      const ReadOptions& options);

/// Arrays of field data that are strings of ours: comments and materials. True where taken.
bool take_strings(VtkSurface& surface, const std::string& name, std::vector<std::string> strings);

/// The mesh file. What has no room in it is among its notes. Requires: indices are in range.
/// Throws: ReadError for points that are not finite, or are no rows of three.
MeshFile as_mesh_file(VtkSurface surface, const std::string& name, const ReadOptions& options);

/// The other way: properties in their order, nx ny nz as "Normals", s t as "TCoords", red green
/// blue [alpha] as "RGB" or "RGBA", where they stand side by side and are of one type, colours
/// bytes or fractions; all others one by one.
std::vector<VtkArray> vtk_arrays(const std::vector<Property>& properties);

/// Points as they are written: as Float32 where that is what they are.
ScalarType point_type(const MeshFile& file);

/// The faces that are written: polygons where options name them, with what faces have.
struct VtkFaces {
  Polygons polygons;
  std::vector<VtkArray> arrays;  // of cells
};
VtkFaces vtk_faces(const MeshFile& file, const WriteOptions& options);

}  // namespace sphparam
