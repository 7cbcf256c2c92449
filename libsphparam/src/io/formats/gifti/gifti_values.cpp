#include "io/formats/gifti/gifti_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "io/formats/gifti/gifti_data.h"
#include "io/formats/gifti/gifti_image.h"
#include "io/formats/gifti/gifti_xml.h"
#include "io/formats/values/values_file.h"
#include "sphparam/io/losses.h"

// The structure is in the metadata of the file; some programs write it into that of the arrays.
// What metadata says of how a file came about is not true of another one that is made of it.

namespace sphparam {
namespace {

constexpr std::int64_t most_inflation = 1032;  // of zlib: a mask may be zeros alone
constexpr std::size_t longest_value = 1 << 16;
constexpr std::int64_t most_columns = 100000;
constexpr std::string_view structure_key = "AnatomicalStructurePrimary";
constexpr std::string_view label_intent = "NIFTI_INTENT_LABEL";
constexpr std::string_view time_intent = "NIFTI_INTENT_TIME_SERIES";
constexpr std::array<std::string_view, 9> of_its_making = {
    "ParentProvenance", "ProgramProvenance", "Provenance", "WorkingDirectory",
    "UniqueID",         "Caret-Version",     "Date",       "UserName",
    "FileSource"};

template <class Arrays>
bool all_are(const Arrays& arrays, std::string_view intent) {
  return std::ranges::all_of(arrays,
                             [&](const GiftiArray& array) { return array.intent == intent; });
}

class ValuesReader {
 public:
  ValuesReader(GiftiDocument document, const std::string& name, const ReadOptions& options)
      : document_(std::move(document)), name_(name), options_(options) {}

  VertexData read() {
    data_.format = "GIFTI";
    require_values();
    data_.kind = kind();
    for (const GiftiArray& array : document_.arrays) add_columns(array);
    keep_metadata(document_.metadata, data_.metadata);
    for (const GiftiArray& array : document_.arrays)
      if (data_.structure.empty()) data_.structure = structure_in(array.metadata);
    if (const std::string said = structure_in(document_.metadata); !said.empty())
      data_.structure = said;
    data_.labels = std::move(document_.labels);
    if (!left_.empty()) add_loss(data_.notes, "metadata " + enumerated(left_));
    return std::move(data_);
  }

 private:
  void require_values() const {
    if (document_.arrays.empty()) throw ReadError(name_, "has no arrays");
    for (const GiftiArray& array : document_.arrays) {
      if (array.intent == "NIFTI_INTENT_POINTSET" || array.intent == "NIFTI_INTENT_TRIANGLE")
        fail_in_array(name_, array, "makes this a surface; a file of values is wanted");
      if (array.intent == "NIFTI_INTENT_NODE_INDEX")
        fail_in_array(name_, array, "makes this sparse, which is not supported");
      if (array.dimensions.front() != document_.arrays.front().dimensions.front())
        fail_in_array(name_, array, "has another number of rows than the first array");
    }
    if (document_.arrays.front().dimensions.front() == 0)
      fail_in_array(name_, document_.arrays.front(), "is of no vertex");
    if (document_.arrays.front().dimensions.front() > options_.max_vertices)
      fail_in_array(name_, document_.arrays.front(),
                    "has more vertices than the limit of " + std::to_string(options_.max_vertices));
  }

  DataKind kind() const {
    if (all_are(document_.arrays, label_intent)) return DataKind::Labels;
    for (const GiftiArray& array : document_.arrays)
      if (array.intent == label_intent)
        fail_in_array(name_, array, "has labels beside arrays that have none");
    return all_are(document_.arrays, time_intent) ? DataKind::TimeSeries : DataKind::Metric;
  }

  void add_columns(const GiftiArray& array) {
    const std::int64_t count = gifti_count(array, most_inflation, name_);
    const std::int64_t rows = array.dimensions.front(), columns = count / rows;
    if (columns == 0) fail_in_array(name_, array, "has no numbers");
    if (columns > most_columns)
      fail_in_array(name_, array,
                    "has more columns than the limit of " + std::to_string(most_columns));
    const std::vector<double> numbers = decode_gifti(array, name_);
    if (data_.kind == DataKind::Labels) require_keys(array, numbers);
    for (std::int64_t k = 0; k < columns; ++k) {
      DataColumn column{.name = {}, .type = gifti_type(array, name_), .values = {}};
      column.intent = array.intent;
      column.values.reserve(static_cast<std::size_t>(rows));
      for (std::int64_t v = 0; v < rows; ++v)
        column.values.push_back(numbers[static_cast<std::size_t>(v * columns + k)]);
      for (const auto& [key, value] : array.metadata)
        if (key == "Name") column.name = value;
      keep_metadata(array.metadata, column.metadata);
      data_.columns.push_back(std::move(column));
    }
  }

  void require_keys(const GiftiArray& array, const std::vector<double>& numbers) const {
    const auto is_key = [](double number) {
      return number == std::floor(number) && std::abs(number) <= std::numeric_limits<int>::max();
    };
    if (!std::ranges::all_of(numbers, is_key))
      fail_in_array(name_, array, "has labels that are no whole numbers");
  }

  static std::string structure_in(const Metadata& metadata) {
    for (const auto& [key, value] : metadata)
      if (key == structure_key) return one_line(value);
    return {};
  }

  void keep_metadata(const Metadata& metadata, Metadata& kept) {
    for (const auto& [key, value] : metadata) {
      if (key.empty() || key == "Name" || key == structure_key) continue;
      const bool is_of_making = std::ranges::find(of_its_making, key) != of_its_making.end();
      if (!is_of_making && value.size() <= longest_value) {
        kept.emplace_back(key, value);
      } else if (std::ranges::find(left_, quoted(key)) == left_.end()) {
        left_.push_back(quoted(key));
      }
    }
  }

  GiftiDocument document_;
  const std::string& name_;
  const ReadOptions& options_;
  VertexData data_;
  std::vector<std::string> left_;
};

int intent_of(const VertexData& data, const DataColumn& column) {
  if (data.kind == DataKind::Labels) return NIFTI_INTENT_LABEL;
  if (data.kind == DataKind::TimeSeries) return NIFTI_INTENT_TIME_SERIES;
  if (column.intent.empty() || column.intent == label_intent) return NIFTI_INTENT_SHAPE;
  const int intent = gifti_intent_from_string(column.intent.c_str());
  return gifti_intent_is_valid(intent) ? intent : NIFTI_INTENT_NONE;
}

/// Programs show columns by their names; moments of a series have none but their number.
std::string name_of(const VertexData& data, std::size_t column) {
  const bool is_moment = data.kind == DataKind::TimeSeries;
  return is_moment ? data.columns[column].name : title_of_column(data, column);
}

void fill_column(giiDataArray& array, const VertexData& data, std::size_t k) {
  const DataColumn& column = data.columns[k];
  const std::span<const double> values(column.values);
  const bool has_keys = data.kind == DataKind::Labels;
  for (const double value : values) {
    if (has_keys)
      as_key(value, "GIFTI");
    else
      as_float32(value, "GIFTI");
  }
  if (has_keys)
    fill_gifti<int>(array, NIFTI_INTENT_LABEL, NIFTI_TYPE_INT32, values, 1);
  else
    fill_gifti<float>(array, intent_of(data, column), NIFTI_TYPE_FLOAT32, values, 1);
  add_gifti_metadata(array.meta, "Name", name_of(data, k));
  for (const auto& [key, value] : column.metadata) add_gifti_metadata(array.meta, key, value);
}

/// Workbench wants a key for what has no label.
std::vector<Label> table_of(const VertexData& data) {
  std::vector<Label> labels = data.labels;
  if (std::ranges::none_of(labels, [](const Label& label) { return label.key == 0; }))
    labels.insert(labels.begin(), Label{0, {{1, 1, 1, 0}}, "???"});
  return labels;
}

}  // namespace

VertexData read_gifti_values(std::string_view bytes, const std::string& name,
                             const ReadOptions& options) {
  return ValuesReader(parse_gifti_xml(bytes, name), name, options).read();
}

std::string serialise_gifti_values(const VertexData& data) {
  const GiftiTurn turn;
  const GiftiImage image = make_gifti_image(static_cast<int>(data.columns.size()));
  for (std::size_t k = 0; k < data.columns.size(); ++k) fill_column(*image->darray[k], data, k);
  add_gifti_metadata(image->meta, std::string(structure_key), data.structure);
  for (const auto& [key, value] : data.metadata) add_gifti_metadata(image->meta, key, value);
  if (data.kind == DataKind::Labels) add_gifti_labels(*image, table_of(data));
  return gifti_bytes(*image);
}

}  // namespace sphparam
