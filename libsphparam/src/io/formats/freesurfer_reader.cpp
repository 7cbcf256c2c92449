#include "io/formats/freesurfer_reader.h"

#include <cstdint>

#include "io/files/byte_reader.h"
#include "io/formats/freesurfer_comments.h"
#include "io/formats/indexed_triangles.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/losses.h"

// The layout is that of FreeSurfer's own reader: two line ends close the line at the top, the
// footer is a list of tags. Tag 2 has a number, whether coordinates are those of the scanner; tag
// 20 has the geometry of the volume, eight lines "KEY = VALUE". Files whose footer starts with tag
// 20 exist. Tags after that carry the commands that made the file.

namespace sphparam {
namespace {

constexpr std::string_view triangles_magic = "\xff\xff\xfe";
constexpr std::string_view other_magics[] = {"\xff\xff\xff", "\xff\xff\xfd"};
constexpr std::size_t longest_line = 10000;

class FreeSurferReader {
 public:
  FreeSurferReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : reader_(bytes, name, std::endian::big), name_(name), options_(options) {}

  MeshFile read() {
    file_.format = "FreeSurfer surface";
    require_surface();
    read_created();
    const auto vertices = reader_.number<std::int32_t>("the numbers of vertices and triangles");
    const auto faces = reader_.number<std::int32_t>("the numbers of vertices and triangles");
    check_counts(reader_, vertices, faces, options_);
    constexpr std::uint64_t row_bytes = 12;
    reader_.require(
        row_bytes * (static_cast<std::uint64_t>(vertices) + static_cast<std::uint64_t>(faces)),
        "the coordinates and triangles");
    file_.mesh.positions = read_points32(reader_, vertices, options_);
    file_.position_type = ScalarType::Float32;
    file_.mesh.triangles = read_triangles32(reader_, faces, vertices, options_);
    read_footer();
    note_side();
    return std::move(file_);
  }

 private:
  void require_surface() {
    if (reader_.rest().starts_with("# HyperSurface"))
      throw ReadError(name_,
                      "this is a surface of Amira or Avizo (HyperSurface), which is not supported; "
                      "both save it as PLY, OBJ or STL");
    const std::string_view magic = reader_.take(triangles_magic.size(), "its magic number");
    if (magic == triangles_magic) return;
    for (const std::string_view other : other_magics)
      if (magic == other)
        throw ReadError(name_,
                        "this is a FreeSurfer file of values or a quadrangle surface, which is not "
                        "supported; triangle surfaces are (mris_convert makes one)");
    throw ReadError(name_, "is no FreeSurfer surface: it does not start with FF FF FE");
  }

  void read_created() {
    const std::string_view line = reader_.line("the line that says who made it");
    if (reader_.rest().starts_with('\n')) reader_.take(1, "");
    constexpr std::string_view created = "created ";
    const std::string_view said = line.starts_with(created) ? line.substr(created.size()) : line;
    if (!said.empty() && said.size() <= longest_line)
      file_.comments.push_back(one_line(std::string(freesurfer_created) + std::string(said)));
  }

  void read_footer() {
    if (next_tag_is(freesurfer_ras_tag) && reader_.remaining() >= 2 * sizeof(std::int32_t)) {
      reader_.number<std::int32_t>("");
      file_.comments.push_back(std::string(freesurfer_real_ras) +
                               std::to_string(reader_.number<std::int32_t>("the footer")));
    }
    if (next_tag_is(freesurfer_geometry_tag)) read_geometry();
    if (reader_.remaining() > 0)
      add_loss(file_.notes, std::to_string(reader_.remaining()) +
                                " bytes after the volume geometry (how the file was made)");
  }

  /// Which hemisphere it is the name alone says, and other formats have other names.
  void note_side() {
    if (const std::string side = structure_of_name(name_); !side.empty())
      file_.comments.push_back("gifti AnatomicalStructurePrimary " + side);
  }

  bool next_tag_is(std::int32_t tag) const {
    ByteReader ahead = reader_;
    return ahead.remaining() >= sizeof tag && ahead.number<std::int32_t>("") == tag;
  }

  // All eight lines, or what is there is told as not carried.
  void read_geometry() {
    ByteReader ahead = reader_;
    ahead.number<std::int32_t>("");
    std::vector<std::string> comments;
    for (int i = 0; i < freesurfer_geometry_lines; ++i) {
      const std::size_t end = ahead.rest().find('\n');
      if (end == std::string_view::npos || end > longest_line) return;
      const std::string_view line = ahead.line("the footer");
      if (line.find('=') == std::string_view::npos) return;
      comments.push_back(one_line(std::string(freesurfer_geometry) + std::string(line)));
    }
    reader_ = ahead;
    file_.comments.insert(file_.comments.end(), comments.begin(), comments.end());
  }

  ByteReader reader_;
  const std::string& name_;
  const ReadOptions& options_;
  MeshFile file_;
};

}  // namespace

bool looks_like_freesurfer(std::string_view bytes) {
  // A count follows the other two, whose first byte is small; bytes that are all ones are no file.
  constexpr unsigned char first_of_count = 0x80;
  const bool counts = bytes.size() > triangles_magic.size() &&
                      static_cast<unsigned char>(bytes[triangles_magic.size()]) < first_of_count;
  return bytes.starts_with(triangles_magic) ||
         (counts && (bytes.starts_with(other_magics[0]) || bytes.starts_with(other_magics[1])));
}

MeshFile read_freesurfer(std::string_view bytes, const std::string& name,
                         const ReadOptions& options) {
  return FreeSurferReader(bytes, name, options).read();
}

}  // namespace sphparam
