// The one place that knows all formats of numbers a vertex.

#include "sphparam/io/vertex_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "io/files/file_bytes.h"
#include "io/files/gzip.h"
#include "io/files/read_back.h"
#include "io/formats/gifti/gifti_reader.h"
#include "io/formats/gifti/gifti_values.h"
#include "io/formats/values/annot.h"
#include "io/formats/values/curv.h"
#include "io/formats/values/label_file.h"
#include "io/formats/values/mgh.h"
#include "io/formats/values/values_file.h"
#include "number_text.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {
namespace {

enum class ValuesFormat { Gifti, Curv, Annot, LabelFile, Mgh };

constexpr std::array<std::string_view, 7> curv_endings = {
    ".curv", ".thickness", ".sulc", ".area", ".volume", ".avg_curv", ".jacobian_white"};

bool is_of_hemisphere(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  return name.size() > 3 && (name.starts_with("lh.") || name.starts_with("rh."));
}

/// By its name; nothing where that says nothing.
std::optional<ValuesFormat> named_format(const std::string& path) {
  const std::string extension = inner_extension_of(path);
  if (extension == ".gii") return ValuesFormat::Gifti;
  if (extension == ".annot") return ValuesFormat::Annot;
  if (extension == ".label") return ValuesFormat::LabelFile;
  if (extension == ".mgh" || extension == ".mgz") return ValuesFormat::Mgh;
  if (std::ranges::find(curv_endings, extension) != curv_endings.end() || is_of_hemisphere(path))
    return ValuesFormat::Curv;
  return std::nullopt;
}

/// What makes numbers of a text columns of the mesh: such files say nothing of their numbers.
std::string advice_on_text(const std::string& path) {
  const std::string extension = inner_extension_of(path);
  const bool is_json = extension == ".json";
  static constexpr std::array<std::string_view, 4> texts = {".txt", ".csv", ".tsv", ".dat"};
  if (!is_json && std::ranges::find(texts, extension) == texts.end()) return "";
  return std::string(". In Python numbers of a text become a column of the mesh: m = ") +
         "sphparam.read(\"mesh.ply\"); sphparam.Mesh(m.vertices, m.faces, values={\"label\": " +
         (is_json ? "json.load(open(" : "numpy.loadtxt(") + sphparam::quoted(path) +
         (is_json ? "))[\"labels\"]" : ", dtype=int)") + "}).save(\"labelled.ply\")";
}

ValuesFormat format_of(std::string_view bytes, const std::string& name) {
  if (looks_like_gifti(bytes)) return ValuesFormat::Gifti;
  if (looks_like_curv(bytes)) return ValuesFormat::Curv;
  if (looks_like_label_file(bytes)) return ValuesFormat::LabelFile;
  if (looks_like_mgh(bytes)) return ValuesFormat::Mgh;
  if (const std::optional<ValuesFormat> named = named_format(name)) return *named;
  throw ReadError(name, "is no file of values that is known; " + written_data_names() + " are" +
                            advice_on_text(name));
}

VertexData read_as(ValuesFormat format, std::string_view bytes, const std::string& name,
                   Eigen::Index vertices, const ReadOptions& options) {
  switch (format) {
    case ValuesFormat::Gifti:
      return read_gifti_values(bytes, name, options);
    case ValuesFormat::Curv:
      return read_curv(bytes, name, options);
    case ValuesFormat::Annot:
      return read_annot(bytes, name, options);
    case ValuesFormat::LabelFile:
      return read_label_file(bytes, name, vertices, options);
    default:
      return read_mgh(bytes, name, options);
  }
}

std::string write_as(ValuesFormat format, const VertexData& data, const Points* surface) {
  switch (format) {
    case ValuesFormat::Gifti:
      return serialise_gifti_values(data);
    case ValuesFormat::Curv:
      return serialise_curv(data);
    case ValuesFormat::Annot:
      return serialise_annot(data);
    case ValuesFormat::LabelFile:
      return serialise_label_file(data, surface);
    default:
      return serialise_mgh(data);
  }
}

/// A name of GIFTI may say what is in it, and other programs believe it.
void require_kind_of_name(const std::string& path, const VertexData& data) {
  const auto says = [&](const std::string& ending) {
    return path.ends_with(ending) || path.ends_with(ending + ".gz");
  };
  if (says(".label.gii")) require_labels(data, ".label.gii");
  if (says(".shape.gii")) require_measures(data, ".shape.gii");
  if (says(".func.gii")) require_measures(data, ".func.gii");
}

/// Without folder and endings.
std::string name_of_data(const std::string& path) {
  const std::string name = parse_brain_name(path).what;
  return name.empty() ? "data" : name;
}

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// GIFTI is written with six digits, which all colours of eight bits come back from.
bool is_same_colour(const Label& a, const Label& b) {
  constexpr float last_digit = 1e-6F;
  if (!a.colour || !b.colour) return a.colour == b.colour;
  return std::ranges::equal(*a.colour, *b.colour, [](float one, float other) {
    return std::abs(one - other) <= last_digit;
  });
}

/// Labels that are not what they were; those of no label may have any key that is not positive.
std::int64_t changed_labels(const VertexData& written, const VertexData& read) {
  return std::ranges::count_if(written.labels, [&](const Label& label) {
    const bool is_none = label.key <= 0 && label.name == "???";
    return !is_none && std::ranges::none_of(read.labels, [&](const Label& other) {
      return other.key == label.key && other.name == label.name && is_same_colour(other, label);
    });
  });
}

/// Lines of metadata that are not there, or not as they were.
std::int64_t changed_lines(const Metadata& written, const Metadata& read) {
  return std::ranges::count_if(
      written, [&](const auto& line) { return std::ranges::find(read, line) == read.end(); });
}

/// What the numbers are, in the words of the format.
void compare_meanings(const VertexData& written, const VertexData& read,
                      std::vector<std::string>& losses) {
  const bool is_series = written.kind == DataKind::TimeSeries;
  if (is_series && read.kind != written.kind)
    add_loss(losses, "that the columns are a time series (NIFTI_INTENT_TIME_SERIES)");
  std::int64_t intents = 0;
  for (std::size_t k = 0; k < written.columns.size(); ++k) {
    const std::string& intent = written.columns[k].intent;
    intents += !intent.empty() && intent != read.columns[k].intent;
  }
  if (written.kind == DataKind::Metric && intents > 0)
    add_loss(losses, "the intent of " + counted(intents, "column") + " (" +
                         written.columns.front().intent + ")");
  if (!written.structure.empty() && written.structure != read.structure)
    add_loss(losses, "the structure " + written.structure);
  if (const std::int64_t changed = changed_labels(written, read); changed > 0)
    add_loss(losses, "key, name or colour, as they were, of " + std::to_string(changed) + " of " +
                         counted(std::ssize(written.labels), "label"));
}

/// Numbers of 32 bits are what these formats have. Of labels nothing may change, but −1 for 0.
std::vector<std::string> losses_of_writing(const VertexData& written, const VertexData& read,
                                           const std::string& path) {
  std::vector<std::string> losses;
  if (written.columns.size() != read.columns.size())
    throw WriteError(path, "as written, it has other columns");
  std::int64_t rounded = 0, metadata = 0, unnamed = 0;
  for (std::size_t k = 0; k < written.columns.size(); ++k) {
    const DataColumn &before = written.columns[k], &after = read.columns[k];
    for (std::size_t v = 0; v < before.values.size(); ++v) {
      const double value = before.values[v];
      if (is_same(value, after.values[v])) continue;
      const bool is_no_label = value <= 0 && after.values[v] <= 0;
      const bool is_rounded =
          is_same(static_cast<double>(static_cast<float>(value)), after.values[v]);
      if (written.kind == DataKind::Labels
              ? !is_no_label && named_format(path) != ValuesFormat::LabelFile
              : !is_rounded)
        throw WriteError(path, "as written, it has other values");
      rounded += written.kind != DataKind::Labels;
    }
    metadata += changed_lines(before.metadata, after.metadata);
    unnamed += !before.name.empty() && after.name != before.name;
  }
  metadata += changed_lines(written.metadata, read.metadata);
  compare_meanings(written, read, losses);
  if (rounded > 0)
    add_loss(losses,
             "the last digits of " + counted(rounded, "value") + ": they have 32 bits there");
  if (unnamed > 0) add_loss(losses, "names of columns");
  if (metadata > 0) add_loss(losses, counted(metadata, "line", "lines") + " of metadata");
  return losses;
}

bool is_packed(const std::string& path) {
  return is_packed_name(path) || extension_of(path) == ".mgz";
}

}  // namespace

VertexData read_vertex_data(std::string_view bytes, const std::string& name, Eigen::Index vertices,
                            const ReadOptions& options) {
  if (bytes.size() > options.max_file_bytes)
    throw ReadError(name, "is larger than " + file_limit(options.max_file_bytes));
  std::string unpacked;
  if (looks_like_gzip(bytes)) {
    unpacked = unzip(bytes, name, options.max_file_bytes).bytes;
    bytes = unpacked;
  }
  if (bytes.empty()) throw ReadError(name, "the file is empty");
  VertexData data = read_as(format_of(bytes, name), bytes, name, vertices, options);
  if (vertices > 0 && data.vertex_count() != vertices)
    throw ReadError(name, "has values of " + std::to_string(data.vertex_count()) +
                              " vertices, and the surface has " + std::to_string(vertices));
  data.name = name_of_data(name);
  if (data.structure.empty()) data.structure = structure_of_name(name);
  return data;
}

VertexData read_vertex_data(const std::string& path, Eigen::Index vertices,
                            const ReadOptions& options) {
  const FileBytes bytes(path, options);
  return read_vertex_data(bytes.view(), bytes.name(), vertices, options);
}

std::string title_of_column(const VertexData& data, std::size_t column) {
  const std::string& name = data.columns[column].name;
  if (!name.empty()) return name;
  return data.columns.size() == 1 ? data.name : data.name + "_" + std::to_string(column + 1);
}

bool is_written_data(const std::string& path) { return named_format(path).has_value(); }

std::string written_data_names() {
  return ".shape.gii, .func.gii, .label.gii, .annot, .label, .mgh, .mgz and lh.NAME";
}

std::string serialise_vertex_data(const std::string& path, const VertexData& data,
                                  const Points* surface) {
  const std::optional<ValuesFormat> format = named_format(path);
  if (!format) throw WriteError(path, "values are written as " + written_data_names());
  if (data.columns.empty()) throw WriteError(path, "there are no values to write");
  try {
    require_kind_of_name(path, data);
    std::string bytes = write_as(*format, data, surface);
    if (is_packed(path)) return zip(bytes);
    return bytes;
  } catch (const WriteError& error) {
    throw WriteError(path, error.what());
  }
}

std::vector<std::string> add_vertex_data(PendingFiles& files, const std::string& path,
                                         const VertexData& data, const Points* surface) {
  std::vector<std::string> losses;
  files.add(path, serialise_vertex_data(path, data, surface), [&](std::string_view written) {
    losses = losses_of_writing(data, read_vertex_data(written, path, data.vertex_count(), own_file),
                               path);
  });
  return losses;
}

void write_vertex_data(const std::string& path, const VertexData& data, const Points* surface) {
  write_file(path, serialise_vertex_data(path, data, surface));
}

}  // namespace sphparam
