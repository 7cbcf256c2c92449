#include "io/formats/vtk/legacy_vtk_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/formats/vtk/legacy_vtk_scanner.h"
#include "io/formats/vtk/vtk_surface.h"
#include "sphparam/io/losses.h"

// Three lines (version, title, encoding), DATASET POLYDATA, then keywords with their data in any
// order. POINT_DATA and CELL_DATA say whose the arrays after them are; before, they are field data.
// Cells are "degree, corners" one after another, from version 5 on offsets and corners apart.

namespace sphparam {
namespace {

constexpr std::string_view first_words = "# vtk DataFile Version";
constexpr std::int64_t most_arrays = 256;

class LegacyVtkReader {
 public:
  LegacyVtkReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : scanner_(bytes, name), name_(name), options_(options) {}

  MeshFile read() {
    read_header();
    for (std::string keyword = scanner_.next_keyword(); !keyword.empty();
         keyword = scanner_.next_keyword())
      read_section(keyword);
    MeshFile file = as_mesh_file(std::move(surface_), name_, options_);
    file.format = binary_ ? "VTK legacy binary" : "VTK legacy ASCII";
    return file;
  }

 private:
  enum class Target { Field, Points, Cells };

  void read_header() {
    if (!scanner_.line().starts_with(first_words))
      scanner_.fail("expected '" + std::string(first_words) + "'");
    scanner_.line();  // the title
    const std::string encoding = scanner_.next_keyword();
    if (encoding != "ASCII" && encoding != "BINARY")
      scanner_.fail("expected ASCII or BINARY, found " + quoted(encoding));
    scanner_.word();
    const std::string dataset = scanner_.next_keyword();
    scanner_.word();
    const std::string kind = scanner_.next_keyword();
    if (dataset != "DATASET")
      scanner_.fail("expected DATASET, found " + quoted(dataset) + ": it holds no surface");
    if (kind != "POLYDATA")
      scanner_.fail("holds the dataset " + quoted(kind) +
                    ", which is not supported; POLYDATA is (a filter such as Extract Surface "
                    "makes one)");
    scanner_.word();
    binary_ = encoding == "BINARY";
    scanner_.set_binary(binary_);
  }

  void read_section(const std::string& keyword) {
    scanner_.word();
    if (keyword == "POINTS") return read_points();
    if (keyword == "VERTICES" || keyword == "LINES") return read_other_cells();
    if (keyword == "POLYGONS") return read_polygons();
    if (keyword == "TRIANGLE_STRIPS") return read_strips();
    if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      target_ = keyword == "POINT_DATA" ? Target::Points : Target::Cells;
      tuples_ = scanner_.count("the number of tuples");
      return;
    }
    if (keyword == "FIELD") return read_field();
    if (keyword == "METADATA") return skip_metadata();
    read_attribute(keyword);
  }

  void read_points() {
    if (surface_.points) scanner_.fail("second POINTS");
    const std::int64_t count = scanner_.count("the number of points");
    if (count > options_.max_vertices)
      scanner_.fail(std::to_string(count) + " points are over the limit of " +
                    std::to_string(options_.max_vertices));
    surface_.points = read_array("Points", 3, count, scanner_.word(), TextDigits::AllThatMatter);
  }

  // --- Cells ---

  /// Degrees and corners of cells, whichever way they are written.
  struct Cells {
    std::vector<std::int64_t> starts{0};
    std::vector<std::int64_t> corners;
  };

  std::vector<std::int64_t> whole_numbers(std::string_view type, std::int64_t count) {
    VtkType kept{};
    const std::vector<double> values = scanner_.numbers(type, count, kept);
    std::vector<std::int64_t> numbers;
    numbers.reserve(values.size());
    for (const double value : values) {
      constexpr double most = 2147483647;
      if (value != std::floor(value) || !(std::abs(value) <= most))
        scanner_.fail("a cell has a number that is no index");
      numbers.push_back(static_cast<std::int64_t>(value));
    }
    return numbers;
  }

  Cells read_cells() {
    const std::int64_t count = scanner_.count("the number of cells");
    const std::int64_t size = scanner_.count("the size of the list of cells");
    if (count > options_.max_faces)
      scanner_.fail(std::to_string(count) + " cells are over the limit of " +
                    std::to_string(options_.max_faces));
    Cells cells = scanner_.next_keyword() == "OFFSETS" ? cells_by_offsets(count, size)
                                                       : cells_by_degree(count, size);
    const std::int64_t points = surface_.points ? surface_.points->count() : 0;
    for (const std::int64_t v : cells.corners)
      if (v < 0 || v >= points)
        scanner_.fail("cell names point " + std::to_string(v) + " of " + std::to_string(points) +
                      " (counted from 0)");
    return cells;
  }

  Cells cells_by_degree(std::int64_t count, std::int64_t size) {
    const std::vector<std::int64_t> list = whole_numbers("int", size);
    Cells cells;
    std::size_t at = 0;
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t degree = at < list.size() ? list[at++] : -1;
      if (degree < 0 || degree > std::ssize(list) - static_cast<std::int64_t>(at))
        scanner_.fail("the list of cells ends before cell " + std::to_string(i) + " of " +
                      std::to_string(count));
      cells.corners.insert(cells.corners.end(), list.begin() + static_cast<std::ptrdiff_t>(at),
                           list.begin() + static_cast<std::ptrdiff_t>(at) + degree);
      at += static_cast<std::size_t>(degree);
      cells.starts.push_back(std::ssize(cells.corners));
    }
    if (at != list.size()) scanner_.fail("the list of cells is longer than its cells");
    return cells;
  }

  Cells cells_by_offsets(std::int64_t offsets, std::int64_t corners) {
    scanner_.word();
    Cells cells;
    const std::string_view offset_type = scanner_.word();
    cells.starts = whole_numbers(offset_type, offsets);
    if (scanner_.next_keyword() != "CONNECTIVITY") scanner_.fail("expected CONNECTIVITY");
    scanner_.word();
    const std::string_view corner_type = scanner_.word();
    cells.corners = whole_numbers(corner_type, corners);
    const bool good = !cells.starts.empty() && cells.starts.front() == 0 &&
                      cells.starts.back() == corners &&
                      std::is_sorted(cells.starts.begin(), cells.starts.end());
    if (!good && offsets > 0) scanner_.fail("the offsets of the cells do not fit their corners");
    if (cells.starts.empty()) cells.starts = {0};
    return cells;
  }

  void read_other_cells() { surface_.other_cells += std::ssize(read_cells().starts) - 1; }

  void read_polygons() {
    if (surface_.polygons.count() > 0 && !surface_.has_strips) scanner_.fail("second POLYGONS");
    const Cells cells = read_cells();
    for (std::size_t i = 0; i + 1 < cells.starts.size(); ++i) {
      for (std::int64_t c = cells.starts[i]; c < cells.starts[i + 1]; ++c)
        surface_.polygons.add_corner(static_cast<int>(cells.corners[static_cast<std::size_t>(c)]));
      const std::string problem = surface_.polygons.close_polygon(options_);
      if (!problem.empty()) scanner_.fail("polygon " + std::to_string(i) + ": " + problem);
    }
  }

  void read_strips() {
    const Cells cells = read_cells();
    for (std::size_t i = 0; i + 1 < cells.starts.size(); ++i) {
      const std::vector<int> strip(cells.corners.begin() + cells.starts[i],
                                   cells.corners.begin() + cells.starts[i + 1]);
      const std::string problem = add_strip(surface_, strip, options_);
      if (!problem.empty()) scanner_.fail("strip " + std::to_string(i) + ": " + problem);
    }
  }

  // --- Arrays ---

  VtkArray read_array(std::string name, std::int64_t width, std::int64_t tuples,
                      std::string_view type, TextDigits digits = TextDigits::AsDeclared) {
    VtkArray array;
    array.name = std::move(name);
    if (width < 1 || width > most_arrays)
      scanner_.fail("an array of " + std::to_string(width) + " components");
    array.width = width;
    VtkType kept{};
    array.values = scanner_.numbers(type, width * tuples, kept, digits);
    array.type = kept_type(kept, array, surface_.notes);
    return array;
  }

  void add(VtkArray array) {
    std::vector<VtkArray>& arrays =
        target_ == Target::Cells ? surface_.cell_arrays : surface_.point_arrays;
    if (target_ == Target::Field)
      add_loss(surface_.notes, "field data " + quoted(array.name));
    else if (std::ssize(arrays) >= most_arrays)
      add_loss(surface_.notes, "array " + quoted(array.name) + ": only " +
                                   std::to_string(most_arrays) + " are kept");
    else
      arrays.push_back(std::move(array));
  }

  void read_field() {
    scanner_.word();  // its name, which is always the same
    const std::int64_t arrays = scanner_.count("the number of arrays");
    for (std::int64_t i = 0; i < arrays; ++i) {
      if (scanner_.next_keyword() == "METADATA") {
        scanner_.word();
        skip_metadata();
      }
      const std::string name = scanner_.name_word();
      if (name.empty()) scanner_.fail("the file ends within field data");
      if (name == "NULL_ARRAY") continue;
      const std::int64_t width = scanner_.count("the number of components");
      const std::int64_t tuples = scanner_.count("the number of tuples");
      const std::string_view type = scanner_.word();
      if (LegacyVtkScanner::is_string_type(type))
        read_strings(name, width * tuples);
      else if (width == 0 || tuples == 0)
        add_empty(name, type, width);
      else
        add(read_array(name, width, tuples, type));
    }
  }

  void add_empty(const std::string& name, std::string_view type, std::int64_t width) {
    VtkType kept{};
    scanner_.numbers(type, 0, kept);
    VtkArray array{.name = name};
    array.width = std::max<std::int64_t>(width, 1);
    array.type = kept_type(kept, array, surface_.notes);
    add(std::move(array));
  }

  void read_strings(const std::string& name, std::int64_t count) {
    std::vector<std::string> strings = scanner_.strings(count);
    const bool taken = target_ == Target::Field && take_strings(surface_, name, std::move(strings));
    if (!taken) add_loss(surface_.notes, "strings " + quoted(name));
  }

  void read_attribute(const std::string& keyword) {
    if (keyword == "LOOKUP_TABLE") return skip_lookup_table();
    static constexpr struct {
      std::string_view keyword;
      std::int64_t width;
      VtkRole role;
    } fixed[] = {{"VECTORS", 3, VtkRole::Plain},    {"NORMALS", 3, VtkRole::Normals},
                 {"TENSORS", 9, VtkRole::Plain},    {"TENSORS6", 6, VtkRole::Plain},
                 {"GLOBAL_IDS", 1, VtkRole::Plain}, {"PEDIGREE_IDS", 1, VtkRole::Plain},
                 {"EDGE_FLAGS", 1, VtkRole::Plain}};
    for (const auto& [known, width, role] : fixed) {
      if (keyword != known) continue;
      std::string name = scanner_.name_word();
      VtkArray array = read_array(std::move(name), width, tuples_, scanner_.word());
      array.role = role;
      return add(std::move(array));
    }
    if (keyword == "SCALARS") return read_scalars();
    if (keyword == "COLOR_SCALARS") return read_colours();
    if (keyword == "TEXTURE_COORDINATES") return read_texcoords();
    scanner_.fail("unknown keyword " + quoted(keyword));
  }

  // SCALARS name type [components], LOOKUP_TABLE name, the numbers.
  void read_scalars() {
    const std::string name = scanner_.name_word();
    const std::string type(scanner_.word());
    std::int64_t width = 1;
    if (scanner_.next_keyword() != "LOOKUP_TABLE") width = scanner_.count("components");
    if (scanner_.next_keyword() != "LOOKUP_TABLE") scanner_.fail("expected LOOKUP_TABLE");
    scanner_.word();
    scanner_.word();
    add(read_array(name, width, tuples_, type));
  }

  // Bytes in BINARY, fractions in ASCII.
  void read_colours() {
    std::string name = scanner_.name_word();
    const std::int64_t width = scanner_.count("the number of components");
    VtkArray array =
        read_array(std::move(name), width, tuples_, binary_ ? "unsigned_char" : "float");
    array.role = VtkRole::Colours;
    add(std::move(array));
  }

  void read_texcoords() {
    std::string name = scanner_.name_word();
    const std::int64_t width = scanner_.count("the number of dimensions");
    VtkArray array = read_array(std::move(name), width, tuples_, scanner_.word());
    array.role = VtkRole::Texcoords;
    add(std::move(array));
  }

  void skip_lookup_table() {
    const std::string name = scanner_.name_word();
    const std::int64_t size = scanner_.count("the size of the table");
    constexpr std::int64_t channels = 4;
    VtkType kept{};
    scanner_.numbers(binary_ ? "unsigned_char" : "float", channels * size, kept);
    add_loss(surface_.notes, "lookup table " + quoted(name));
  }

  /// Names of components and other words about an array, up to an empty line.
  void skip_metadata() {
    scanner_.line();
    while (!scanner_.next_keyword().empty() && !scanner_.line().empty()) continue;
  }

  LegacyVtkScanner scanner_;
  const std::string& name_;
  const ReadOptions& options_;
  bool binary_ = false;
  Target target_ = Target::Field;
  std::int64_t tuples_ = 0;
  VtkSurface surface_;
};

}  // namespace

bool looks_like_legacy_vtk(std::string_view bytes) {
  if (!bytes.starts_with(first_words)) return false;
  constexpr std::string_view blanks = " \t\r\n";
  for (int line = 0; line < 2; ++line)
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size() - 1) + 1);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(blanks), bytes.size()));
  std::string word(bytes.substr(0, bytes.find_first_of(blanks)));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return word == "ASCII" || word == "BINARY";
}

MeshFile read_legacy_vtk(std::string_view bytes, const std::string& name,
                         const ReadOptions& options) {
  return LegacyVtkReader(bytes, name, options).read();
}

}  // namespace sphparam
