#include "io/formats/shapes/icq_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/files/text_scanner.h"
#include "io/formats/shapes/plain_table.h"
#include "io/formats/shapes/shape_tables.h"
#include "io/polygons/distinct_rows.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/polygons.h"

// Six grids on the faces of a cube: 1 on top, 2 to 5 around, 6 below. Which points of two faces are
// the same, the format says in twelve equations, V(I,0,2) = V(I,Q,1) and so on; they say no more
// than where each grid lies on the cube [0, q]³, so that is what stands here.
// Source: R. Gaskell, SHAPE.TXT of the stereophotoclinometry software; PDS Small Bodies Node.

namespace sphparam {
namespace {

using CubePoint = std::array<double, 3>;

/// Where column i and row j of a face lie on the cube.
CubePoint on_cube(int face, double i, double j, double q) {
  switch (face) {
    case 0:
      return {q - i, j, q};
    case 1:
      return {q - i, q, q - j};
    case 2:
      return {q, i, q - j};
    case 3:
      return {i, 0, q - j};
    case 4:
      return {0, q - i, q - j};
    default:
      return {q - i, q - j, 0};
  }
}

class IcqReader {
 public:
  IcqReader(const PlainTable& table, const std::string& name, const ReadOptions& options)
      : scanner_(table.text(), name, options, table.first_line()), options_(options) {
    table.note_label(file_);
  }

  MeshFile read() {
    file_.format = "ICQ";
    read_size();
    read_points();
    place_points();
    if (scanner_.next_filled_line()) file_.notes.push_back("data after the last vector ignored");
    add_vertices();
    add_quads();
    if (is_inside_out()) turn_quads();
    adopt_triangulation(file_, triangulate(file_.mesh.positions, polygons_));
    add_notes();
    return std::move(file_);
  }

 private:
  void read_size() {
    scanner_.require_text();
    if (!next_table_header(scanner_, file_.comments))
      scanner_.fail("the file holds no q, the number of quads of an edge");
    constexpr long largest_q = 1 << 14;  // 6 (q + 1)² fits an int
    const long q = scanner_.integer();
    if (q < 1 || q > largest_q)
      scanner_.fail("q, the number of quads of an edge, is " + std::to_string(q) +
                    ": it is from 1 to " + std::to_string(largest_q));
    expect_table_line_end(scanner_);
    q_ = static_cast<int>(q);
    side_ = q_ + 1;
    count_ = std::int64_t{6} * side_ * side_;
    if (count_ > options_.max_vertices)
      scanner_.fail(std::to_string(count_) + " vectors are over the limit of " +
                    std::to_string(options_.max_vertices));
    constexpr std::int64_t row_bytes = 3 * 2;
    if (static_cast<std::uint64_t>(row_bytes * count_) > scanner_.remaining_bytes() + 1)
      scanner_.fail("q = " + std::to_string(q) + " makes " + std::to_string(count_) +
                    " vectors, which do not fit the " + std::to_string(scanner_.remaining_bytes()) +
                    " bytes that follow");
  }

  void read_points() {
    points_.resize(count_, 3);
    bool has_albedo = false;
    for (std::int64_t point = 0; point < count_; ++point) {
      next_table_row(scanner_, "vector", point, count_);
      if (point == 0) has_albedo = words_left(scanner_) == 4;
      points_.row(point) = table_vector(scanner_, options_.non_finite);
      if (has_albedo) albedo_.push_back(table_number(scanner_));
      expect_table_line_end(scanner_);
      lines_.push_back(scanner_.line_number());
    }
  }

  /// By rows and columns, or by columns and rows where fewer points are left apart then.
  void place_points() {
    add_points(false);
    const long apart = apart_;
    if (apart == 0) return;
    add_points(true);
    if (apart_ >= apart) add_points(false);
  }

  void add_points(bool by_columns) {
    places_ = DistinctRows<double, 3>(0);
    vertex_of_.clear();
    first_point_.clear();
    apart_ = first_apart_line_ = other_albedos_ = 0;
    largest_gap_ = 0;
    for (std::int64_t point = 0; point < count_; ++point) add_point(point, by_columns);
  }

  /// The vertex of a point: that of its place on the cube, or, where another point was there
  /// before it and is elsewhere, one of its own, beside the cube.
  void add_point(std::int64_t point, bool by_columns) {
    const int face = static_cast<int>(point / (side_ * side_));
    const int in_face = static_cast<int>(point % (side_ * side_));
    int i = in_face % side_, j = in_face / side_;
    if (by_columns) std::swap(i, j);
    CubePoint place = on_cube(face, i, j, q_);
    int vertex = add_place(place, point);
    const bool repeats = first_point_[vertex] != point;
    if (repeats && points_.row(point) != points_.row(first_point_[vertex])) {
      if (apart_++ == 0) first_apart_line_ = lines_[point];
      const double gap = (points_.row(point) - points_.row(first_point_[vertex])).norm();
      largest_gap_ = std::max(largest_gap_, gap);
      place[0] += 2.0 * side_ * (face + 1);
      vertex = add_place(place, point);
    } else if (!albedo_.empty()) {
      other_albedos_ += albedo_[point] != albedo_[first_point_[vertex]];
    }
    vertex_of_.push_back(vertex);
  }

  int add_place(const CubePoint& place, std::int64_t point) {
    const int vertex = places_.insert(place);
    if (vertex == static_cast<int>(first_point_.size()))
      first_point_.push_back(static_cast<int>(point));
    return vertex;
  }

  void add_vertices() {
    const auto count = static_cast<Eigen::Index>(first_point_.size());
    file_.mesh.positions.resize(count, 3);
    Property albedo{"albedo", ScalarType::Float64, {}};
    for (Eigen::Index v = 0; v < count; ++v) {
      file_.mesh.positions.row(v) = points_.row(first_point_[v]);
      if (!albedo_.empty()) albedo.values.push_back(albedo_[first_point_[v]]);
    }
    if (!albedo_.empty()) file_.set_vertex_property(std::move(albedo));
    file_.set_vertex_property(
        {"source_vertex", ScalarType::Int32, {first_point_.begin(), first_point_.end()}});
    keep_vertices_of_file(file_, points_.rows());
  }

  void add_quads() {
    for (int face = 0; face < 6; ++face) {
      for (int j = 0; j < q_; ++j) {
        for (int i = 0; i < q_; ++i) {
          const int corner = (face * side_ + j) * side_ + i;
          for (const int at : {corner, corner + side_, corner + side_ + 1, corner + 1})
            polygons_.add_corner(vertex_of_[at]);
          const std::string problem = polygons_.close_polygon(options_);
          if (!problem.empty()) scanner_.fail(problem);
        }
      }
    }
  }

  /// By the volume, of quads cut along one of their diagonals.
  bool is_inside_out() const {
    double volume = 0;
    for (std::size_t quad = 0; quad < polygons_.corners.size(); quad += 4) {
      const auto corner = [&](std::size_t k) -> Vector3 {
        return file_.mesh.position(polygons_.corners[quad + k]);
      };
      volume += corner(2).dot(corner(3).cross(corner(0)) - corner(1).cross(corner(0)));
    }
    return volume < 0;
  }

  /// Whose rows are the columns of others.
  void turn_quads() {
    for (std::size_t quad = 0; quad < polygons_.corners.size(); quad += 4)
      std::swap(polygons_.corners[quad + 1], polygons_.corners[quad + 3]);
    file_.notes.emplace_back(
        "rows and columns run the other way than those of other ICQ: faces were turned, to look "
        "outwards");
  }

  void add_notes() {
    if (apart_ > 0)
      file_.notes.push_back(counted(apart_, "point") + " of the edges of faces left apart: up to " +
                            short_number(largest_gap_) +
                            " from the point of another face that they repeat, the first in line " +
                            std::to_string(first_apart_line_) +
                            "; `--repair --weld LENGTH` welds what is near");
    if (other_albedos_ > 0)
      add_loss(file_.notes, counted(other_albedos_, "albedo") +
                                " of the edges of faces, which another face has otherwise");
  }

  TextScanner scanner_;
  const ReadOptions& options_;
  int q_ = 0, side_ = 0;
  std::int64_t count_ = 0;
  Points points_;  // of the file
  std::vector<double> albedo_;
  std::vector<long> lines_;  // of each point
  DistinctRows<double, 3> places_{0};
  std::vector<int> vertex_of_;    // of each point
  std::vector<int> first_point_;  // of each vertex
  long apart_ = 0, first_apart_line_ = 0, other_albedos_ = 0;
  double largest_gap_ = 0;  // of those apart
  Polygons polygons_;
  MeshFile file_;
};

}  // namespace

bool looks_like_icq(std::string_view text) {
  return shape_table(PlainTable(text).text()) == ShapeTable::Icq;
}

MeshFile read_icq(std::string_view text, const std::string& name, const ReadOptions& options) {
  const PlainTable table(text);
  return IcqReader(table, name, options).read();
}

}  // namespace sphparam
