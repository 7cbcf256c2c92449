#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

class PendingFiles;

// What neuroimaging keeps beside a surface: files of numbers a vertex, in the order of the
// surface's vertices, without the surface.

/// One line of a label table: what a whole number in a column of labels stands for.
struct Label {
  int key = 0;
  std::optional<std::array<float, 4>> colour = {};  // red, green, blue, alpha in [0, 1]
  std::string name = {};
};

/// What the numbers of a file are.
enum class DataKind {
  Metric,      // measured: thickness, curvature
  TimeSeries,  // measured, a column a moment
  Labels,      // keys of a label table, never mixed
};

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// One number a vertex. Those of metrics may be NaN, which is what files say of vertices that have
/// none.
struct DataColumn {
  std::string name;  // as the file has it, maybe empty
  ScalarType type = ScalarType::Float32;
  std::vector<double> values;
  std::string intent = {};  // of GIFTI, where it has one: "NIFTI_INTENT_SHAPE", …
  Metadata metadata = {};   // of the column, but its name
};

/// A file of numbers a vertex.
struct VertexData {
  std::string name;  // of the file, without folder and endings: "lh.thickness"
  DataKind kind = DataKind::Metric;
  std::vector<DataColumn> columns;      // all of one length
  std::vector<Label> labels = {};       // of Labels: the table
  std::string structure = {};           // "CortexLeft", …; empty: nobody says
  Metadata metadata = {};               // of the file, but the structure
  long triangles = 0;                   // that the surface has, where the file says so
  std::string format = {};              // "GIFTI", "FreeSurfer curv", …
  std::vector<std::string> notes = {};  // of the reader: what is not carried (losses.h)
  int attached_as = 0;                  // its number among the data of a mesh, from 1; 0: of none
  std::vector<std::string> properties = {};  // of that mesh, one a column

  Eigen::Index vertex_count() const {
    return columns.empty() ? 0 : static_cast<Eigen::Index>(columns.front().values.size());
  }
};

/// What a column is called: by itself, else after its file.
std::string title_of_column(const VertexData& data, std::size_t column);

/// Of `read_vertex_data`: whatever the file says; a FreeSurfer .label then has values of the
/// vertices in it alone.
inline constexpr Eigen::Index any_vertices = -1;

/// Reads a file of numbers a vertex, as it is or in gzip: .shape.gii, .func.gii, .label.gii;
/// FreeSurfer's curv (lh.thickness, lh.sulc, lh.curv), .annot, .label; overlays in .mgh and .mgz.
///
/// The format is told by the content, then by the name. `vertices`: how many the surface has, which
/// a FreeSurfer .label does not say; 0: not known. Labels of .annot get their number in its table
/// for a key; vertices without one get the key of "???", 0 where that is free, else −1. A .label
/// gives the key 1 to its vertices, 0 to the others. A two-dimensional array of GIFTI is a column a
/// column. Where a file does not say which hemisphere it is of, its name may (brain_names.h).
/// Refused: surfaces, volumes, sparse arrays, a number of vertices other than `vertices`.
/// Ensures: columns are of one length, at least one vertex and one column; keys are whole numbers.
/// Throws: ReadError. Cost: near a copy of the bytes; text 0.2 µs a number.
VertexData read_vertex_data(const std::string& path, Eigen::Index vertices = 0,
                            const ReadOptions& options = {});

/// Reads one from memory. `name` stands in messages, and its endings decide where content does not.
VertexData read_vertex_data(std::string_view bytes, const std::string& name,
                            Eigen::Index vertices = 0, const ReadOptions& options = {});

/// Whether data is written under this name: .gii (metrics, time series, labels), .annot, .label
/// (labels of one column), .mgh, .mgz (metrics); .curv, .thickness, .sulc, .area, .volume, lh.NAME
/// and rh.NAME (one column of a metric). ".gz" after .gii asks for gzip.
bool is_written_data(const std::string& path);

/// Those names, for people.
std::string written_data_names();

/// The bytes of the file, in the format that the name asks for. `surface`: whose coordinates a
/// FreeSurfer .label has beside its vertices; null: it has zeros.
/// Metrics are written as float32, which all programs of the field read; keys as int32. GIFTI has
/// the structure and other metadata of the file in the file's, those of columns in the column's;
/// metrics have the intent that was read, else SHAPE.
/// Throws: WriteError for a name of no format, for what the format has no place for (several
/// columns, labels of one colour in .annot, several keys in .label, numbers beyond float32), and
/// where libgiftiio fails.
std::string serialise_vertex_data(const std::string& path, const VertexData& data,
                                  const Points* surface = nullptr);

/// Adds such a file; once written, it is read back and must have the same numbers. Returns what the
/// format had no place for (losses.h). Throws: WriteError.
std::vector<std::string> add_vertex_data(PendingFiles& files, const std::string& path,
                                         const VertexData& data, const Points* surface = nullptr);

/// Writes it, all or nothing. Throws: WriteError.
void write_vertex_data(const std::string& path, const VertexData& data,
                       const Points* surface = nullptr);

// In a mesh file the columns are properties of vertices. Comments tell which came from which file,
// and keep the label tables, so that any mesh format that has properties and comments carries all.

/// Adds the columns to a mesh as properties. A single one is named as the file is, without its
/// hemisphere ("thickness" of lh.thickness), others by themselves; a name that is taken gets a
/// number, as do those that mean something in a mesh ("theta_2", "red_2", "material_2"). Where
/// vertices were welded or dropped on reading, those that are left have the values of their numbers
/// in the file (`source_vertex`). Returns the names. NaN stays NaN, which mesh files do not hold:
/// see `without_missing`. Throws: std::invalid_argument where the data has not a number for each
/// vertex of the mesh's file. Cost: a copy.
std::vector<std::string> attach_data(MeshFile& mesh, const VertexData& data);

/// The data without columns that have values that are no finite numbers; `losses` tells of them.
VertexData without_missing(VertexData data, std::vector<std::string>& losses);

/// Which part of a brain a surface says it is of, else its name: "CortexLeft"; empty: nobody says,
/// or "Other".
std::string structure_of(const MeshFile& surface, const std::string& path);

/// The data that a mesh carries so, as it is at its vertices; properties that are gone are left
/// out.
std::vector<VertexData> attached_data(const MeshFile& mesh);

/// The number, `attached_as`, of the data that was attached last, also where its properties are
/// gone; 0 where there is none.
int last_attached(const MeshFile& mesh);

/// The mesh without it, its properties and comments.
MeshFile without_data(MeshFile mesh);

}  // namespace sphparam
