#include "io/formats/values/annot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "io/formats/values/values_file.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/safe_file.h"

// Number of vertices; vertex and colour of each; 1, where there is a table: −2, the largest key and
// one, its file, the number of its lines, and these: key, name, R, G, B, 255 − A. Older tables
// start with the number of lines, and have no keys. Texts have their length before them.

namespace sphparam {
namespace {

constexpr char format[] = "FreeSurfer's annot";
constexpr std::int32_t table_tag = 1, second_version = -2, longest_text = 10000;
constexpr std::int32_t most_keys = 1000000;
constexpr int no_key = -1;
constexpr std::string_view table_file = "FreeSurfer colour table";
constexpr std::string_view no_label = "???";

std::int32_t colour_number(int red, int green, int blue) {
  return red + (green << 8) + (blue << 16);
}

class AnnotReader {
 public:
  AnnotReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : reader_(bytes, name, std::endian::big), options_(options) {}

  VertexData read() {
    data_.format = "FreeSurfer annot";
    data_.kind = DataKind::Labels;
    read_colours();
    if (reader_.remaining() == 0 || number("the tag of its colour table") != table_tag)
      reader_.fail("has no colour table, so that its labels have no names");
    read_table();
    if (reader_.remaining() > 0)
      add_loss(data_.notes, std::to_string(reader_.remaining()) + " bytes after the colour table");
    name_colours();
    return std::move(data_);
  }

 private:
  std::int32_t number(const char* what) { return reader_.number<std::int32_t>(what); }

  void read_colours() {
    const std::int32_t count = number("its number of vertices");
    require_vertex_count(reader_, count, options_);
    reader_.require(8 * static_cast<std::uint64_t>(count), "the labels of vertices");
    colours_.assign(static_cast<std::size_t>(count), 0);
    std::vector<char> seen(colours_.size(), 0);
    for (std::int32_t i = 0; i < count; ++i) {
      const std::int32_t v = number("the labels");
      const std::int32_t colour = number("the labels");
      if (v < 0 || v >= count)
        reader_.fail("names vertex " + std::to_string(v) + " of " + std::to_string(count) +
                     " (counted from 0)");
      if (seen[static_cast<std::size_t>(v)]++)
        reader_.fail("names vertex " + std::to_string(v) + " twice");
      colours_[static_cast<std::size_t>(v)] = colour;
    }
  }

  std::string text(const char* what) {
    const std::int32_t length = number(what);
    if (length < 0 || length > longest_text)
      reader_.fail("a text of " + std::to_string(length) + " bytes");
    return trimmed_text(reader_.take(static_cast<std::uint64_t>(length), what));
  }

  void read_table() {
    const std::int32_t first = number("its colour table");
    if (first < 0 && first != second_version)
      reader_.fail("has a colour table of version " + std::to_string(-std::int64_t{first}) +
                   ", which is not supported; 2 is");
    const bool has_keys = first == second_version;
    if (has_keys) number("its colour table");
    if (const std::string file = text("its colour table"); !file.empty())
      data_.metadata.emplace_back(table_file, file);
    const std::int32_t lines = has_keys ? number("its colour table") : first;
    if (lines < 0) reader_.fail("has a colour table of " + std::to_string(lines) + " lines");
    for (std::int32_t i = 0; i < lines; ++i) read_label(has_keys ? number("its colour table") : i);
  }

  void read_label(std::int32_t key) {
    if (key < 0 || key > most_keys) reader_.fail("has a label of number " + std::to_string(key));
    if (!keys_.insert(key).second) reader_.fail("has two labels of number " + std::to_string(key));
    Label label{key, {}, text("a label")};
    int channels[4];
    for (int& channel : channels) {
      channel = number("a label's colour");
      if (channel < 0 || channel > 255)
        reader_.fail("has a label with a colour of " + std::to_string(channel));
    }
    channels[3] = 255 - channels[3];
    label.colour.emplace();
    for (std::size_t k = 0; k < 4; ++k)
      (*label.colour)[k] = static_cast<float>(channels[k]) / 255.0F;
    const std::int32_t colour = colour_number(channels[0], channels[1], channels[2]);
    if (!by_colour_.insert({colour, key}).second) others_[colour].push_back(quoted(label.name));
    data_.labels.push_back(std::move(label));
  }

  void name_colours() {
    const int unlabelled = keys_.contains(0) ? no_key : 0;
    DataColumn& column = data_.columns.emplace_back();
    column.type = ScalarType::Int32;
    column.values.reserve(colours_.size());
    long unknown = 0;
    bool any_unlabelled = false;
    for (const std::int32_t colour : colours_) {
      const auto found = by_colour_.find(colour);
      column.values.push_back(found == by_colour_.end() ? unlabelled : found->second);
      any_unlabelled |= found == by_colour_.end();
      unknown += found == by_colour_.end() && colour != 0;
    }
    tell_shared_colours();
    if (any_unlabelled)
      data_.labels.insert(data_.labels.begin(),
                          Label{unlabelled, {{0, 0, 0, 0}}, std::string(no_label)});
    if (unknown > 0)
      add_loss(data_.notes, "labels of " + std::to_string(unknown) + " of " +
                                counted(static_cast<long>(colours_.size()), "vertex", "vertices") +
                                ": the colour table has no such colours");
  }

  /// Vertices of several labels have those of the first.
  void tell_shared_colours() {
    const auto name_of = [&](int key) {
      return quoted(std::ranges::find(data_.labels, key, &Label::key)->name);
    };
    for (const auto& [colour, others] : others_) {
      const long count = std::ranges::count(colours_, colour);
      if (count == 0) continue;  // they are told apart where nothing has them
      add_loss(data_.notes, "vertices of " + enumerated(others) + ": " + std::to_string(count) +
                                " of " + counted(std::ssize(colours_), "vertex", "vertices") +
                                " have one colour with " + name_of(by_colour_.at(colour)) +
                                ", and are taken for it");
    }
  }

  ByteReader reader_;
  const ReadOptions& options_;
  VertexData data_;
  std::vector<std::int32_t> colours_;                        // by vertex
  std::map<std::int32_t, int> by_colour_;                    // the first label of each
  std::map<std::int32_t, std::vector<std::string>> others_;  // of that colour too
  std::set<std::int32_t> keys_;                              // that there are
};

void append_int(std::string& bytes, std::int64_t value) {
  append_number(bytes, static_cast<std::int32_t>(value), std::endian::big);
}

void append_text(std::string& bytes, const std::string& text) {
  append_int(bytes, std::ssize(text) + 1);
  bytes += text;
  bytes += '\0';
}

/// The colour of each label that is used, as vertices have it.
class LabelColours {
 public:
  explicit LabelColours(const VertexData& data) {
    for (const Label& label : data.labels) labels_[label.key] = &label;
    for (const double value : data.columns.front().values) {
      const int key = as_key(value, format);
      if (key >= 0 && !used_.contains(key)) use(key);
    }
  }

  std::int32_t of(double value) const { return value < 0 ? 0 : used_.at(static_cast<int>(value)); }

  static std::array<int, 4> bytes_of(const Label& label) {
    std::array<int, 4> bytes{};
    for (std::size_t k = 0; k < 4; ++k)
      bytes[k] = static_cast<int>(std::lround(255 * std::clamp((*label.colour)[k], 0.0F, 1.0F)));
    return bytes;
  }

 private:
  void use(int key) {
    const auto found = labels_.find(key);
    if (found == labels_.end())
      throw WriteError(format,
                       "key " + std::to_string(key) + " is used and not in the label table");
    const Label& label = *found->second;
    if (!label.colour)
      throw WriteError(format, "label '" + label.name + "' has no colour; .label.gii holds it");
    const auto [red, green, blue, alpha] = bytes_of(label);
    const std::int32_t colour = colour_number(red, green, blue);
    const auto [other, is_new] = taken_.insert({colour, key});
    if (!is_new)
      throw WriteError(format, "labels '" + labels_[other->second]->name + "' and '" + label.name +
                                   "' have one colour, which is all that tells them apart there; "
                                   ".label.gii holds them");
    used_[key] = colour;
  }

  std::map<int, const Label*> labels_;
  std::map<int, std::int32_t> used_;
  std::map<std::int32_t, int> taken_;
};

/// Those that an annotation has a place for: with a key of its own and a colour.
std::vector<const Label*> written_labels(const VertexData& data) {
  std::vector<const Label*> labels;
  for (const Label& label : data.labels) {
    if (label.key > most_keys)
      throw WriteError(format, "key " + std::to_string(label.key) + " is over the limit of " +
                                   std::to_string(most_keys) + "; .label.gii holds it");
    if (label.key >= 0 && label.colour) labels.push_back(&label);
  }
  std::ranges::sort(labels, {}, [](const Label* label) { return label->key; });
  return labels;
}

std::string file_of_table(const VertexData& data) {
  for (const auto& [key, value] : data.metadata)
    if (key == table_file) return value;
  return "NOFILE";
}

}  // namespace

VertexData read_annot(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return AnnotReader(bytes, name, options).read();
}

std::string serialise_annot(const VertexData& data) {
  require_labels(data, format);
  require_one_column(data, format);
  const LabelColours colours(data);
  const std::vector<const Label*> labels = written_labels(data);
  const std::vector<double>& values = data.columns.front().values;
  std::string bytes;
  bytes.reserve(8 * values.size() + 64 * labels.size() + 64);
  append_int(bytes, std::ssize(values));
  for (std::size_t v = 0; v < values.size(); ++v) {
    append_int(bytes, static_cast<std::int64_t>(v));
    append_int(bytes, colours.of(values[v]));
  }
  append_int(bytes, table_tag);
  append_int(bytes, second_version);
  append_int(bytes, labels.empty() ? 0 : labels.back()->key + 1);
  append_text(bytes, file_of_table(data));
  append_int(bytes, std::ssize(labels));
  for (const Label* label : labels) {
    append_int(bytes, label->key);
    append_text(bytes, label->name);
    const auto [red, green, blue, alpha] = LabelColours::bytes_of(*label);
    for (const int channel : {red, green, blue, 255 - alpha}) append_int(bytes, channel);
  }
  return bytes;
}

}  // namespace sphparam
