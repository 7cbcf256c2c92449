#include "io/formats/values/label_file.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/files/text_buffer.h"
#include "io/files/text_scanner.h"
#include "io/formats/values/values_file.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {
namespace {

constexpr char format[] = "FreeSurfer's label";
constexpr std::string_view first_line = "#!ascii label";

/// "cortex" of "folder/lh.cortex.label".
std::string name_of_label(const std::string& path) {
  std::string name = stem_of(path);
  if (name.starts_with("lh.") || name.starts_with("rh.")) name.erase(0, 3);
  return name.empty() ? "label" : name;
}

/// The key of the vertices in the label. Throws: WriteError where there are several.
int key_of(const VertexData& data) {
  int key = 0;
  for (const double value : data.columns.front().values) {
    const int other = as_key(value, format);
    if (other == 0 || other == key) continue;
    if (key != 0)
      throw WriteError(format, "holds one label, and " + data.name +
                                   " has several; .annot and .label.gii hold them");
    key = other;
  }
  return key;
}

void require_usable(Eigen::Index vertices, const std::string& name, const ReadOptions& options) {
  if (vertices == 0)
    throw ReadError(name,
                    "a label does not say how many vertices its surface has, which is "
                    "needed: name the surface");
  if (vertices > options.max_vertices)
    throw ReadError(name, "is of " + std::to_string(vertices) + " vertices, over the limit of " +
                              std::to_string(options.max_vertices));
}

long read_count(TextScanner& scanner, long most) {
  if (!scanner.next_filled_line()) scanner.fail("the file ends before its count");
  const long count = scanner.integer();
  if (count < 0 || count > most)
    scanner.fail(std::to_string(count) + " vertices in the label, of " + std::to_string(most));
  return count;
}

/// A vertex of the label, with its number: 0 where it has none.
std::pair<long, double> read_vertex(TextScanner& scanner, Eigen::Index vertices) {
  const long v = scanner.integer();
  if (v < 0 || (vertices != any_vertices && v >= vertices))
    scanner.fail("names vertex " + std::to_string(v) + " of " + std::to_string(vertices) +
                 " (counted from 0)");
  for (int axis = 0; axis < 3; ++axis) scanner.real();
  return {v, scanner.at_line_end() ? 0 : scanner.real()};
}

}  // namespace

bool looks_like_label_file(std::string_view bytes) { return bytes.starts_with(first_line); }

VertexData read_label_file(std::string_view bytes, const std::string& name, Eigen::Index vertices,
                           const ReadOptions& options) {
  TextScanner scanner(bytes, name, options);
  scanner.require_text();
  require_usable(vertices, name, options);
  const bool alone = vertices == any_vertices;
  const long count = read_count(
      scanner, alone ? std::min<long>(options.max_vertices, std::ssize(bytes)) : vertices);
  VertexData data;
  data.format = "FreeSurfer label";
  data.kind = DataKind::Labels;
  data.labels = {{0, {{1, 1, 1, 0}}, "???"}, {1, {{1, 0, 0, 1}}, name_of_label(name)}};
  DataColumn& column = data.columns.emplace_back();
  column.type = ScalarType::Int32;
  column.values.assign(static_cast<std::size_t>(alone ? count : vertices), alone ? 1 : 0);
  long with_number = 0;
  for (long i = 0; i < count; ++i) {
    if (!scanner.next_filled_line())
      scanner.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                   " vertices");
    const auto [v, number] = read_vertex(scanner, vertices);
    with_number += number != 0 && number != 1;
    if (!alone) column.values[static_cast<std::size_t>(v)] = 1;
  }
  if (with_number > 0)
    add_loss(data.notes, "the numbers of " + std::to_string(with_number) + " of " +
                             counted(count, "vertex", "vertices") + " in the label");
  if (scanner.next_filled_line()) data.notes.push_back("lines after the label ignored");
  return data;
}

std::string serialise_label_file(const VertexData& data, const Points* surface) {
  require_labels(data, format);
  require_one_column(data, format);
  const int key = key_of(data);
  const std::vector<double>& values = data.columns.front().values;
  std::int64_t count = 0;
  for (const double value : values) count += key != 0 && value == key;
  TextBuffer text(64 * static_cast<std::size_t>(count) + 64);
  text << first_line << "  , made by sphparam\n" << count << '\n';
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (key == 0 || values[v] != key) continue;
    text << v << ' ';
    for (int axis = 0; axis < 3; ++axis) {
      const double x = surface ? (*surface)(static_cast<Eigen::Index>(v), axis) : 0;
      text << ' ' << static_cast<float>(x);
    }
    text << " 0\n";
  }
  return text.take();
}

}  // namespace sphparam
