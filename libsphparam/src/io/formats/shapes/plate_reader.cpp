#include "io/formats/shapes/plate_reader.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "io/files/text_scanner.h"
#include "io/formats/shapes/plain_table.h"
#include "io/formats/shapes/shape_tables.h"
#include "sphparam/io/polygons.h"

namespace sphparam {
namespace {

/// What rows have besides three numbers, where the first row has one number more: at the beginning
/// their own numbers, or an albedo at the end.
class RowNumbers {
 public:
  /// `are_whole`: the three are.
  RowNumbers(const char* thing, bool are_whole) : thing_(thing), are_whole_(are_whole) {}

  void read(TextScanner& scanner, std::int64_t row) {
    if (row == 0) look_at_first(scanner);
    if (!there_) return;
    const long number = scanner.integer();
    if (row == 0) first_ = number;
    if (first_ != 0 && first_ != 1)
      scanner.fail(std::string("expected the number of the first ") + thing_ + ", 1 or 0, found " +
                   std::to_string(first_));
    if (number != first_ + row)
      scanner.fail(std::string("expected ") + thing_ + " " + std::to_string(first_ + row) +
                   ", found " + std::to_string(number) + " (of 4 numbers a line the first counts)");
  }

  void read_albedo(TextScanner& scanner) {
    if (has_albedo_) albedos_.push_back(table_number(scanner));
  }

  /// Of all rows; empty where they have none.
  std::vector<double> take_albedos() { return std::move(albedos_); }

 private:
  void look_at_first(const TextScanner& scanner) {
    const int words = words_left(scanner);
    if (words > 4) scanner.fail(std::string(thing_) + " has more than 4 numbers");
    const bool ends_otherwise = are_whole_ ? ends_with_real(scanner) : !begins_with_index(scanner);
    there_ = words == 4 && !ends_otherwise;
    has_albedo_ = words == 4 && ends_otherwise;
  }

  const char* thing_;
  bool are_whole_;
  bool has_albedo_ = false;
  bool there_ = false;
  long first_ = 1;
  std::vector<double> albedos_;
};

class PlateReader {
 public:
  PlateReader(const PlainTable& table, const std::string& name, const ReadOptions& options)
      : scanner_(table.text(), name, options, table.first_line()), options_(options) {
    table.note_label(file_);
  }

  MeshFile read() {
    file_.format = "PDS plate table";
    read_counts();
    read_vertices();
    read_plates();
    count_from_zero();
    if (scanner_.next_filled_line()) file_.notes.push_back("data after the last plate ignored");
    adopt_triangulation(file_, triangulate(file_.mesh.positions, polygons_));
    return std::move(file_);
  }

 private:
  /// A number in text takes two bytes with its separator.
  static constexpr std::uint64_t row_bytes = 3 * 2;

  void read_counts() {
    scanner_.require_text();
    if (!next_table_header(scanner_, file_.comments))
      scanner_.fail("the file holds no number of vertices");
    if (three_numbers_left(scanner_))
      scanner_.fail(
          "the table begins with numbers of a row, not with counts: of tables, plates are read "
          "(numbers of vertices and of plates, the vertices, the plates) and ICQ (q, the "
          "vertices), no rows of longitude, latitude and radius");
    vertices_ = table_count(scanner_, "vertices", options_.max_vertices, row_bytes);
    if (!scanner_.at_line_end()) return read_plate_count();
    next_table_row(scanner_, "vertex", 0, vertices_);
    if (words_left(scanner_) == 1)
      read_plate_count();
    else
      at_first_vertex_ = true;
  }

  void read_plate_count() {
    plates_ = table_count(scanner_, "plates", options_.max_faces, row_bytes);
    expect_table_line_end(scanner_);
  }

  void read_vertices() {
    file_.mesh.positions.resize(vertices_, 3);
    RowNumbers numbers("vertex", false);
    for (std::int64_t v = 0; v < vertices_; ++v) {
      if (v > 0 || !at_first_vertex_) next_table_row(scanner_, "vertex", v, vertices_);
      numbers.read(scanner_, v);
      file_.mesh.positions.row(v) = table_vector(scanner_, options_.non_finite);
      numbers.read_albedo(scanner_);
      expect_table_line_end(scanner_);
    }
    if (auto albedos = numbers.take_albedos(); !albedos.empty())
      file_.set_vertex_property({"albedo", ScalarType::Float64, std::move(albedos)});
  }

  void read_plates() {
    if (!plates_) {
      if (!scanner_.next_filled_line()) scanner_.fail("the file ends before the number of plates");
      read_plate_count();
    }
    polygons_.corners.reserve(static_cast<std::size_t>(3 * *plates_));
    polygons_.starts.reserve(static_cast<std::size_t>(*plates_ + 1));
    RowNumbers numbers("plate", true);
    for (std::int64_t plate = 0; plate < *plates_; ++plate) {
      next_table_row(scanner_, "plate", plate, *plates_);
      if (plate == 0) degrees_before_ = words_left(scanner_) == 1;
      if (degrees_before_) read_degree(plate);
      numbers.read(scanner_, plate);
      read_corners(numbers);
    }
    if (auto albedos = numbers.take_albedos(); !albedos.empty())
      file_.set_face_property({"albedo", ScalarType::Float64, std::move(albedos)});
  }

  /// The line before each plate that says how many corners it has.
  void read_degree(std::int64_t plate) {
    if (scanner_.integer() != 3) scanner_.fail("plate has not 3 corners");
    expect_table_line_end(scanner_);
    next_table_row(scanner_, "plate", plate, *plates_);
  }

  void read_corners(RowNumbers& numbers) {
    for (int k = 0; k < 3; ++k) {
      const long v = scanner_.integer();
      if (v < 0 || v > vertices_)
        scanner_.fail("plate names vertex " + std::to_string(v) + " of " +
                      std::to_string(vertices_));
      if (v == 0 && zero_line_ == 0) zero_line_ = scanner_.line_number();
      largest_ = std::max(largest_, v);
      polygons_.add_corner(static_cast<int>(v));
    }
    numbers.read_albedo(scanner_);
    expect_table_line_end(scanner_);
    const std::string problem = polygons_.close_polygon(options_);
    if (!problem.empty()) scanner_.fail(problem);
  }

  void count_from_zero() {
    const bool from_zero = zero_line_ > 0 && largest_ == vertices_ - 1;
    if (zero_line_ > 0 && !from_zero)
      scanner_.fail_at(zero_line_, "plate names vertex 0, but the largest is " +
                                       std::to_string(largest_) + " of " +
                                       std::to_string(vertices_) +
                                       ": vertices are counted neither from 1 nor from 0");
    if (from_zero) {
      file_.notes.push_back("plates count vertices from 0");
    } else {
      for (int& v : polygons_.corners) --v;
    }
  }

  TextScanner scanner_;
  const ReadOptions& options_;
  std::int64_t vertices_ = 0;
  std::optional<std::int64_t> plates_;  // nothing: their number follows the vertices
  bool at_first_vertex_ = false;        // the scanner is on its line already
  bool degrees_before_ = false;         // a line "3" stands before each plate
  Polygons polygons_;
  long zero_line_ = 0;  // the first that names vertex 0; 0: none does
  long largest_ = 0;    // vertex named
  MeshFile file_;
};

}  // namespace

bool looks_like_plates(std::string_view text) {
  return shape_table(PlainTable(text).text()) == ShapeTable::Plates;
}

MeshFile read_plates(std::string_view text, const std::string& name, const ReadOptions& options) {
  const PlainTable table(text);
  return PlateReader(table, name, options).read();
}

}  // namespace sphparam
