#include "io/formats/stl_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "io/files/non_finite_advice.h"
#include "io/files/text_scanner.h"
#include "io/polygons/distinct_rows.h"
#include "lower_case.h"
#include "number_text.h"

// An STL file is a soup: every facet has three corners of its own. Corners are numbered by their
// coordinates as they come, so the soup is never stored.
// ASCII: solid [name] { facet normal x y z / outer loop / 3 × vertex x y z / endloop / endfacet }
// endsolid [name], any number of solids. Binary: 80 bytes of anything, a count, 50 bytes a facet.

namespace sphparam {
namespace {

constexpr std::size_t text_header_bytes = 80, header_bytes = 84, facet_bytes = 50;

std::uint32_t little_endian(std::string_view bytes, std::size_t at, int width) {
  std::uint32_t value = 0;
  for (int i = width - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

std::uint64_t binary_size(std::uint32_t facets) {
  return header_bytes + facet_bytes * std::uint64_t{facets};
}

/// How a binary file says the colours of its facets: a bit, and five for each channel.
struct FacetColours {
  bool red_is_lowest;                 // of the channels (Magics); else blue (VisCAM, SolidView)
  bool own_has_bit;                   // where the highest bit is set; else where it is clear
  std::array<std::uint8_t, 3> other;  // the colour of those without one of their own

  bool has_own(std::uint32_t attribute) const { return (attribute >> 15 == 1) == own_has_bit; }

  /// 0: red, 1: green, 2: blue; from 0 to 255.
  double channel(std::uint32_t attribute, std::size_t i) const {
    constexpr std::uint32_t most = 31;
    if (!has_own(attribute)) return other[i];
    return std::round(255.0 * (attribute >> 5 * (red_is_lowest ? i : 2 - i) & most) / most);
  }
};

/// Magics names the colour of the whole in the header, and its facets' own have the bit clear.
/// Without that name who uses the two bytes for colours sets the bit, and leaves others 0.
std::optional<FacetColours> facet_colours(std::string_view header,
                                          const std::vector<double>& attributes) {
  constexpr std::string_view of_whole = "COLOR=";
  constexpr std::size_t channels = 4;
  constexpr double bit = 1 << 15;
  const std::size_t at = header.find(of_whole);
  if (at != std::string_view::npos && header.size() - at >= of_whole.size() + channels) {
    FacetColours colours{true, false, {}};
    std::copy_n(header.begin() + static_cast<std::ptrdiff_t>(at + of_whole.size()), 3,
                colours.other.begin());
    return colours;
  }
  const bool are_colours =
      std::ranges::all_of(attributes, [](double value) { return value == 0 || value >= bit; });
  return are_colours ? std::optional(FacetColours{false, true, {255, 255, 255}}) : std::nullopt;
}

void add_colours(MeshFile& file, const FacetColours& colours,
                 const std::vector<double>& attributes) {
  constexpr std::array names = {"red", "green", "blue"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    Property channel{names[i], ScalarType::Uint8, {}};
    for (const double attribute : attributes)
      channel.values.push_back(colours.channel(static_cast<std::uint32_t>(attribute), i));
    file.set_face_property(std::move(channel));
  }
  const auto without = std::ranges::count(attributes, 0.0);
  if (colours.own_has_bit && without > 0)
    file.notes.push_back(counted(without, "triangle has", "triangles have") +
                         " no colour, and became white");
}

/// Corners become vertices, three corners a triangle.
class Welder {
 public:
  explicit Welder(std::size_t expected_facets) : vertices_(expected_facets / 2) {
    corners_.reserve(3 * expected_facets);
  }

  // Adding +0 makes −0 and +0 the same bits.
  void add(double x, double y, double z) {
    corners_.push_back(vertices_.insert({x + 0.0, y + 0.0, z + 0.0}));
  }

  std::int64_t facets() const { return static_cast<std::int64_t>(corners_.size() / 3); }

  /// What is over a limit; empty when nothing is.
  std::string over_limit(const ReadOptions& options) const {
    const auto message = [](const char* what, std::int64_t limit) {
      return std::string("more ") + what + " than the limit of " + std::to_string(limit);
    };
    if (facets() > std::min(options.max_faces, most_facets))
      return message("triangles", std::min(options.max_faces, most_facets));
    if (static_cast<std::int64_t>(vertices_.rows().size()) > options.max_vertices)
      return message("vertices", options.max_vertices);
    return {};
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh;
    const auto& rows = vertices_.rows();
    mesh.positions.resize(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t v = 0; v < rows.size(); ++v)
      mesh.positions.row(static_cast<Eigen::Index>(v)) << rows[v][0], rows[v][1], rows[v][2];
    mesh.triangles = Eigen::Map<const Triangles>(corners_.data(), facets(), 3);
    return mesh;
  }

 private:
  static constexpr std::int64_t most_facets = std::numeric_limits<int>::max() / 3;
  DistinctRows<double, 3> vertices_;
  std::vector<int> corners_;
};

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : scanner_(text, name, options), options_(options), welder_(text.size() / usual_facet_bytes) {
    scanner_.require_text();
  }

  MeshFile read() {
    file_.format = "STL ASCII";
    scanner_.next_filled_line();
    expect("solid");
    do {
      read_solid();
    } while (next_solid());
    file_.mesh = welder_.mesh();
    if (solids_ > 1)
      file_.set_face_property({"solid", ScalarType::Int32, {solid_of_.begin(), solid_of_.end()}});
    return std::move(file_);
  }

 private:
  static constexpr std::size_t usual_facet_bytes = 250;

  /// The next word in lower case, from a following line if need be; empty at the end of the text.
  std::string next_word() {
    if (scanner_.at_line_end() && !scanner_.next_filled_line()) return {};
    return in_lower_case(scanner_.word());
  }

  void require(const std::string& found, const char* keyword) const {
    if (found == keyword) return;
    scanner_.fail(std::string("expected '") + keyword + "', found " +
                  (found.empty() ? "the end of the file" : quoted(found)));
  }
  void expect(const char* keyword) { require(next_word(), keyword); }

  void read_solid() {
    const std::string name = one_line(scanner_.rest());
    if (!name.empty()) file_.comments.push_back("solid " + name);
    ++solids_;
    for (;;) {
      const std::string word = next_word();
      if (word == "endsolid") break;
      require(word, "facet");
      read_facet();
    }
    scanner_.rest();  // the name again
  }

  void read_facet() {
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) scanner_.any_real();  // of facets without area NaN
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      const double x = scanner_.coordinate(), y = scanner_.coordinate(), z = scanner_.coordinate();
      welder_.add(x, y, z);
    }
    const std::string word = next_word();
    if (word == "vertex") scanner_.fail("facet has more than 3 corners");
    require(word, "endloop");
    expect("endfacet");
    solid_of_.push_back(solids_ - 1);
    const std::string problem = welder_.over_limit(options_);
    if (!problem.empty()) scanner_.fail(problem);
  }

  bool next_solid() {
    if (!scanner_.at_line_end() || scanner_.next_filled_line()) {
      if (next_word() == "solid") return true;
      file_.notes.push_back("data after the last solid ignored, from line " +
                            std::to_string(scanner_.line_number()));
    }
    return false;
  }

  TextScanner scanner_;
  const ReadOptions& options_;
  Welder welder_;
  int solids_ = 0;
  std::vector<int> solid_of_;  // of each facet
  MeshFile file_;
};

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : bytes_(bytes), name_(name), options_(options) {}

  MeshFile read() {
    const std::uint32_t facets = count();
    Welder welder(facets);
    Property attribute{"attribute", ScalarType::Uint16, std::vector<double>(facets)};
    for (std::uint32_t f = 0; f < facets; ++f) {
      const std::size_t at = header_bytes + facet_bytes * std::size_t{f};
      for (std::size_t corner = 0; corner < 3; ++corner) add_corner(welder, at + 12 * (corner + 1));
      attribute.values[f] = little_endian(bytes_, at + 48, 2);
      const std::string problem = welder.over_limit(options_);
      if (!problem.empty()) throw ReadError::at_byte(name_, at, problem);
    }
    MeshFile file;
    file.format = "STL binary";
    file.position_type = ScalarType::Float32;
    file.mesh = welder.mesh();
    add_header(file);
    const bool used = std::any_of(attribute.values.begin(), attribute.values.end(),
                                  [](double value) { return value != 0; });
    if (used) add_attributes(file, std::move(attribute));
    if (const std::uint64_t more = bytes_.size() - binary_size(facets); more > 0)
      file.notes.push_back("data after the last triangle ignored: " + std::to_string(more) +
                           (more == 1 ? " byte" : " bytes"));
    return file;
  }

 private:
  /// As they are, and as colours where they are such.
  void add_attributes(MeshFile& file, Property attributes) const {
    if (const auto colours = facet_colours(bytes_.substr(0, text_header_bytes), attributes.values))
      add_colours(file, *colours, attributes.values);
    file.set_face_property(std::move(attributes));
  }

  std::uint32_t count() const {
    if (bytes_.size() < header_bytes)
      throw ReadError(name_, "is neither ASCII STL ('solid …') nor long enough to be a binary one");
    const std::uint32_t facets = little_endian(bytes_, text_header_bytes, 4);
    if (bytes_.size() != binary_size(facets) && !is_padded(facets))
      throw ReadError::at_byte(name_, text_header_bytes,
                               "binary STL of " + std::to_string(facets) + " triangles has " +
                                   std::to_string(binary_size(facets)) + " bytes, this file has " +
                                   std::to_string(bytes_.size()) + advice(facets));
    return facets;
  }

  /// What to do about a length that is wrong.
  std::string advice(std::uint32_t facets) const {
    const std::uint64_t whole = (bytes_.size() - header_bytes) / facet_bytes;
    if (bytes_.size() < binary_size(facets))
      return ": it ends after " + counted(static_cast<std::int64_t>(whole), "whole triangle") +
             ", so copy, download or export it again";
    return ": its count leaves out what comes after, so export it again";
  }

  /// What comes after the triangles holds none, of which the count would be wrong.
  bool is_padded(std::uint32_t facets) const {
    if (facets == 0 || bytes_.size() < binary_size(facets)) return false;
    const std::string_view more = bytes_.substr(binary_size(facets));
    return more.size() < facet_bytes || more.find_first_not_of('\0') == std::string_view::npos;
  }

  void add_corner(Welder& welder, std::size_t at) const {
    float xyz[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      xyz[axis] = std::bit_cast<float>(little_endian(bytes_, at + 4 * axis, 4));
      if (!std::isfinite(xyz[axis]) && !options_.non_finite)
        throw ReadError::at_byte(name_, at + 4 * axis,
                                 "coordinate is not a finite number" + non_finite_advice());
    }
    welder.add(xyz[0], xyz[1], xyz[2]);
  }

  // Whatever of the header can be shown.
  void add_header(MeshFile& file) const {
    std::string header(bytes_.substr(0, text_header_bytes));
    header.resize(std::min(header.find('\0'), header.size()));
    while (header.ends_with(' ')) header.pop_back();
    const bool printable =
        std::all_of(header.begin(), header.end(), [](char c) { return c >= ' ' && c <= '~'; });
    if (!header.empty() && printable) file.comments.push_back(std::move(header));
  }

  std::string_view bytes_;
  const std::string& name_;
  const ReadOptions& options_;
};

}  // namespace

bool looks_like_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_bytes &&
         bytes.size() == binary_size(little_endian(bytes, text_header_bytes, 4));
}

bool looks_like_ascii_stl(std::string_view bytes) {
  constexpr std::string_view solid = "solid";
  const std::size_t start = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  bytes.remove_prefix(start);
  if (bytes.size() < solid.size()) return false;
  const bool word =
      bytes.size() == solid.size() || std::isspace(static_cast<unsigned char>(bytes[solid.size()]));
  return word && in_lower_case(bytes.substr(0, solid.size())) == solid;
}

bool looks_like_stl(std::string_view bytes) {
  return looks_like_binary_stl(bytes) || looks_like_ascii_stl(bytes);
}

MeshFile read_stl(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  const bool ascii = looks_like_ascii_stl(bytes) && !looks_like_binary_stl(bytes);
  // Some programs fill the last block. A NUL before that is in every binary file: its length is
  // what is wrong, not the NUL.
  const std::string_view text = bytes.substr(0, bytes.find_last_not_of('\0') + 1);
  if (!ascii || text.find('\0') != std::string_view::npos)
    return BinaryReader(bytes, name, options).read();
  MeshFile file = AsciiReader(text, name, options).read();
  if (text.size() < bytes.size()) file.notes.push_back("zero bytes after the text ignored");
  return file;
}

}  // namespace sphparam
