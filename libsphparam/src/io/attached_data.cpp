// Comments of a mesh, for the K-th file of data: "data K file KIND NAME", "data K structure WORD",
// "data K triangles N", "data K meta KEY VALUE", "data K label KEY R G B A NAME", and for each of
// its columns "data K column PROPERTY INTENT NAME", then "data K column-meta KEY VALUE". Words are
// written with %XX for what a word cannot have; an empty one is "-".

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "free_name.h"
#include "io/data_comments.h"
#include "io/formats/gifti/gifti_labels.h"
#include "io/formats/lossless_type.h"
#include "number_text.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/vertex_data.h"
#include "take_word.h"

namespace sphparam {
namespace {

constexpr std::string_view prefix = "data ";
constexpr std::pair<DataKind, std::string_view> kinds[] = {{DataKind::Metric, "metric"},
                                                           {DataKind::TimeSeries, "time-series"},
                                                           {DataKind::Labels, "labels"}};

std::string as_word(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  if (text.empty()) return "-";
  std::string word;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 0x7f && c != '%' && text != "-") {
      word += c;
    } else {
      word += '%';
      word += digits[byte >> 4];
      word += digits[byte & 15];
    }
  }
  return word;
}

std::string from_word(std::string_view word) {
  if (word == "-") return {};
  std::string text;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned byte = 0;
    const char* const end = word.data() + std::min(i + 3, word.size());
    if (word[i] == '%' && std::from_chars(word.data() + i + 1, end, byte, 16).ptr == end &&
        i + 3 <= word.size()) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += word[i];
    }
  }
  return text;
}

/// A comment of ours, taken apart.
struct Line {
  int file = 0;
  std::string_view what, rest;
};

std::optional<Line> parse_line(std::string_view comment) {
  if (!comment.starts_with(prefix)) return std::nullopt;
  comment.remove_prefix(prefix.size());
  Line line;
  const std::string_view number = take_word(comment);
  const char* const end = number.data() + number.size();
  if (std::from_chars(number.data(), end, line.file).ptr != end || line.file < 1)
    return std::nullopt;
  line.what = take_word(comment);
  line.rest = comment;
  return line;
}

/// Measures that are whole numbers in their file are measures all the same.
ScalarType type_of_property(const VertexData& data, const DataColumn& column) {
  if (data.kind == DataKind::Labels) return ScalarType::Int32;
  if (is_floating(column.type)) return column.type;
  return lossless_type(ScalarType::Float32, column.values.data(),
                       static_cast<Eigen::Index>(column.values.size()));
}

/// In the order of the mesh's vertices.
std::vector<double> values_of_mesh(const MeshFile& mesh, const FileNumbers& numbers,
                                   const std::vector<double>& values) {
  const Eigen::Index count = mesh.mesh.vertex_count();
  const Eigen::Index wanted = vertices_of_file(mesh);
  if (wanted > 0 && std::ssize(values) != wanted)
    throw std::invalid_argument("values of " + std::to_string(values.size()) +
                                " vertices, and the mesh" + (wanted == count ? "" : "'s file") +
                                " has " + std::to_string(wanted));
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(count));
  for (Vertex v = 0; v < count; ++v) {
    const long number = numbers.number(v);
    if (number < 0 || number >= std::ssize(values))
      throw std::invalid_argument("values of " + std::to_string(values.size()) +
                                  " vertices, and the mesh's file has a vertex " +
                                  std::to_string(number));
    result.push_back(values[static_cast<std::size_t>(number)]);
  }
  return result;
}

constexpr std::string_view of_shape[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view of_maps[] = {"sx", "sy", "sz", "theta", "phi"};
constexpr std::string_view of_colours[] = {"red", "green", "blue", "alpha", "r", "g", "b"};
constexpr std::string_view of_other_colours[] = {"diffuse_red", "diffuse_green", "diffuse_blue",
                                                 "diffuse_alpha"};
constexpr std::string_view of_textures[] = {"s", "t", "u", "v", "texture_u", "texture_v"};
constexpr std::string_view of_faces[] = {"material", "texnumber", filler_property};
constexpr std::string_view of_sources[] = {"source_vertex", "source_face"};

/// Names that mean something in a mesh, and are taken for it when it is read.
bool has_a_role(std::string_view name) {
  const auto is_one = [name](const auto&... lists) {
    return ((std::ranges::count(lists, name) > 0) || ...);
  };
  return name.empty() ||
         is_one(of_shape, of_maps, of_colours, of_other_colours, of_textures, of_faces, of_sources);
}

/// What formats take for a name, and unlike those that are there.
std::string new_property_name(const MeshFile& mesh, const std::string& wanted) {
  return free_name(printable_name(wanted), [&](const std::string& name) {
    return has_a_role(name) || mesh.find_vertex_property(name);
  });
}

std::string wanted_name(const VertexData& data, std::size_t k) {
  return data.columns.size() == 1 ? data.name : title_of_column(data, k);
}

std::string_view word_of(DataKind kind) {
  return std::ranges::find(kinds, kind, &std::pair<DataKind, std::string_view>::first)->second;
}

/// What nobody knows is measured.
DataKind kind_named(std::string_view word) {
  const auto found = std::ranges::find(kinds, word, &std::pair<DataKind, std::string_view>::second);
  return found == std::end(kinds) ? DataKind::Metric : found->first;
}

/// Files of it lie beside one another some day.
std::string name_of_its_own(const MeshFile& mesh, DataKind kind, const std::string& name) {
  std::set<std::string> names;
  for (const std::string& comment : mesh.comments) {
    std::optional<Line> line = parse_line(comment);
    if (!line || line->what != "file") continue;
    if (take_word(line->rest) == word_of(kind)) names.insert(from_word(line->rest));
  }
  return free_name(name, [&](const std::string& candidate) { return names.contains(candidate); });
}

/// What begins a file among the comments of a mesh, without its head.
std::string file_line(const MeshFile& mesh, DataKind kind, const std::string& name) {
  return "file " + std::string(word_of(kind)) + " " + as_word(name_of_its_own(mesh, kind, name));
}

std::string head_of(int file) { return std::string(prefix) + std::to_string(file) + " "; }

/// The property that a comment says is a column; nothing of other comments.
std::optional<std::string> column_in(std::string_view comment) {
  std::optional<Line> line = parse_line(comment);
  if (!line || line->what != "column") return std::nullopt;
  return from_word(take_word(line->rest));
}

/// The comments of a file, but those of its columns.
void describe(MeshFile& mesh, const VertexData& data, const std::string& head) {
  const auto add = [&](const std::string& line) { mesh.comments.push_back(head + line); };
  add(file_line(mesh, data.kind, data.name));
  if (!data.structure.empty()) add("structure " + as_word(data.structure));
  if (data.triangles > 0) add("triangles " + std::to_string(data.triangles));
  for (const auto& [key, value] : data.metadata) add("meta " + as_word(key) + " " + as_word(value));
  for (const Label& label : data.labels) add("label " + label_text(label));
}

/// What one comment adds to the file that it is of.
class DataBuilder {
 public:
  explicit DataBuilder(const MeshFile& mesh) : mesh_(mesh) {}

  void add(const Line& line) {
    std::string_view rest = line.rest;
    if (line.what == "file") return start(line.file, rest);
    if (files_.empty() || numbers_.back() != line.file) return;
    VertexData& data = files_.back();
    if (line.what == "structure") data.structure = from_word(rest);
    if (line.what == "triangles")
      std::from_chars(rest.data(), rest.data() + rest.size(), data.triangles);
    if (line.what == "meta") add_metadata(data.metadata, rest);
    if (line.what == "column") add_column(data, rest);
    if (line.what == "column-meta" && in_column_) add_metadata(data.columns.back().metadata, rest);
    if (line.what == "label")
      if (std::optional<Label> label = parse_label(rest)) data.labels.push_back(*std::move(label));
  }

  std::vector<VertexData> finish() {
    std::erase_if(files_, [](const VertexData& data) { return data.columns.empty(); });
    return std::move(files_);
  }

 private:
  void start(int number, std::string_view rest) {
    VertexData data;
    data.kind = kind_named(take_word(rest));
    data.name = from_word(rest);
    data.attached_as = number;
    numbers_.push_back(number);
    files_.push_back(std::move(data));
    in_column_ = false;
  }

  static void add_metadata(Metadata& metadata, std::string_view rest) {
    const std::string key = from_word(take_word(rest));
    metadata.emplace_back(key, from_word(rest));
  }

  void add_column(VertexData& data, std::string_view rest) {
    const std::string property = from_word(take_word(rest));
    const std::string intent = from_word(take_word(rest));
    const Property* const found = mesh_.find_vertex_property(property);
    in_column_ = found != nullptr;
    if (!found) return;
    data.columns.push_back({from_word(rest), found->type, found->values, intent, {}});
    data.properties.push_back(property);
  }

  const MeshFile& mesh_;
  std::vector<int> numbers_;
  std::vector<VertexData> files_;
  bool in_column_ = false;
};

}  // namespace

std::vector<std::string> attach_data(MeshFile& mesh, const VertexData& data) {
  const FileNumbers numbers(mesh);
  const std::string head = head_of(last_attached(mesh) + 1);
  std::vector<Property> properties;
  for (const DataColumn& column : data.columns)
    properties.push_back(
        {"", type_of_property(data, column), values_of_mesh(mesh, numbers, column.values)});
  describe(mesh, data, head);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < properties.size(); ++k) {
    const DataColumn& column = data.columns[k];
    names.push_back(new_property_name(mesh, wanted_name(data, k)));
    properties[k].name = names.back();
    mesh.vertex_properties.push_back(std::move(properties[k]));
    mesh.comments.push_back(head + "column " + as_word(names.back()) + " " +
                            as_word(column.intent) + " " + as_word(column.name));
    for (const auto& [key, value] : column.metadata)
      mesh.comments.push_back(head + "column-meta " + as_word(key) + " " + as_word(value));
  }
  return names;
}

VertexData without_missing(VertexData data, std::vector<std::string>& losses) {
  std::vector<DataColumn> kept;
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    DataColumn& column = data.columns[k];
    const auto missing =
        std::ranges::count_if(column.values, [](double value) { return !std::isfinite(value); });
    if (missing == 0) {
      kept.push_back(std::move(column));
      continue;
    }
    add_loss(losses, "'" + wanted_name(data, k) + "': " + std::to_string(missing) + " of " +
                         counted(std::ssize(column.values), "value") + " are no finite numbers");
  }
  data.columns = std::move(kept);
  return data;
}

std::string structure_of(const MeshFile& surface, const std::string& path) {
  constexpr std::string_view said = "gifti AnatomicalStructurePrimary ";
  for (const std::string& comment : surface.comments)  // "Other" is written where nobody knows
    if (comment.starts_with(said) && comment != std::string(said) + "Other")
      return comment.substr(said.size());
  return structure_of_name(path);
}

std::vector<VertexData> attached_data(const MeshFile& mesh) {
  DataBuilder builder(mesh);
  for (const std::string& comment : mesh.comments)
    if (const std::optional<Line> line = parse_line(comment)) builder.add(*line);
  return builder.finish();
}

int last_attached(const MeshFile& mesh) {
  int last = 0;
  for (const std::string& comment : mesh.comments)
    if (const std::optional<Line> line = parse_line(comment)) last = std::max(last, line->file);
  return last;
}

MeshFile without_data(MeshFile mesh) {
  std::vector<std::string> names;
  for (const std::string& comment : mesh.comments)
    if (std::optional<std::string> name = column_in(comment)) names.push_back(*std::move(name));
  remove_properties(mesh.vertex_properties, names);
  std::erase_if(mesh.comments,
                [](const std::string& comment) { return parse_line(comment).has_value(); });
  return mesh;
}

void rename_vertex_property(MeshFile& mesh, const std::string& old, const std::string& name) {
  for (Property& property : mesh.vertex_properties)
    if (property.name == old) property.name = name;
  for (std::string& comment : mesh.comments) {
    if (column_in(comment) != old) continue;
    std::string_view rest = parse_line(comment)->rest;
    take_word(rest);
    comment =
        head_of(parse_line(comment)->file) + "column " + as_word(name) + " " + std::string(rest);
  }
}

void tell_data_of(MeshFile& mesh, const MeshFile& other) {
  const int last = last_attached(mesh);
  for (const std::string& comment : other.comments) {
    const std::optional<Line> line = parse_line(comment);
    if (!line || line->what == "triangles") continue;  // those of the other mesh
    std::string_view rest = line->rest;
    std::string text = std::string(line->what) + " " + std::string(rest);
    if (line->what == "file") {
      const DataKind kind = kind_named(take_word(rest));
      text = file_line(mesh, kind, from_word(rest));
    }
    mesh.comments.push_back(head_of(last + line->file) + text);
  }
}

}  // namespace sphparam
