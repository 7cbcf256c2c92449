#include "io/formats/mz3_reader.h"

#include <cstdint>

#include "io/files/byte_reader.h"
#include "io/formats/indexed_triangles.h"
#include "io/formats/mz3_attributes.h"
#include "io/formats/non_finite_numbers.h"
#include "sphparam/io/losses.h"

// MAGIC, attributes, numbers of faces and vertices, bytes to skip; then the faces, the vertices,
// the colours, the layers. How many layers there are follows from the length of the file. All
// little-endian. "MZ" opens programs of Windows too, so the whole header has to make sense.

namespace sphparam {
namespace {

using Has = Mz3Attributes;

struct Mz3Header {
  std::uint16_t magic = 0, attributes = 0;
  std::uint32_t faces = 0, vertices = 0, skipped = 0;

  explicit Mz3Header(ByteReader& reader) {
    magic = reader.number<std::uint16_t>("its header");
    attributes = reader.number<std::uint16_t>("its header");
    faces = reader.number<std::uint32_t>("its header");
    vertices = reader.number<std::uint32_t>("its header");
    skipped = reader.number<std::uint32_t>("its header");
  }

  bool has(std::uint16_t attribute) const { return (attributes & attribute) != 0; }

  /// Without layers.
  std::uint64_t bytes() const {
    constexpr std::uint64_t row_bytes = 12, colour_bytes = 4;
    return std::uint64_t{skipped} + (has(Has::faces) ? row_bytes * faces : 0) +
           (has(Has::vertices) ? row_bytes * vertices : 0) +
           (has(Has::colours) ? colour_bytes * vertices : 0);
  }

  std::uint64_t layer_bytes() const {
    if (!has(Has::floats) && !has(Has::doubles)) return 0;
    return std::uint64_t{vertices} * (has(Has::doubles) ? sizeof(double) : sizeof(float));
  }
};

class Mz3Reader {
 public:
  Mz3Reader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : reader_(bytes, name, std::endian::little), name_(name), options_(options) {}

  MeshFile read() {
    file_.format = "MZ3";
    if (!reader_.rest().starts_with(mz3_magic)) reader_.fail("expected the magic word 'MZ'");
    const Mz3Header header(reader_);
    require_mesh(header);
    reader_.require(header.bytes(), "what its header announces");
    if (header.skipped > 0)
      add_loss(file_.notes, std::to_string(header.skipped) + " bytes of private data");
    reader_.take(header.skipped, "");
    // Positions come after the triangles, which name them.
    file_.mesh.triangles = read_triangles32(reader_, header.faces, header.vertices, options_);
    file_.mesh.positions = read_points32(reader_, header.vertices, options_);
    file_.position_type = ScalarType::Float32;
    if (header.has(Has::colours)) read_colours();
    read_layers(header);
    return std::move(file_);
  }

 private:
  void require_mesh(const Mz3Header& header) {
    if (header.attributes == 0 || header.attributes > Has::all)
      reader_.fail("attributes " + std::to_string(header.attributes) + " are none that MZ3 has");
    if (!header.has(Has::faces) || !header.has(Has::vertices))
      throw ReadError(name_, "this MZ3 holds values or points and no mesh, which is not supported");
    if (header.has(Has::floats) && header.has(Has::doubles))
      reader_.fail("its layers are said to be of 32 bits and of 64");
    check_counts(reader_, header.vertices, header.faces, options_);
  }

  void read_colours() {
    const char* const names[] = {"red", "green", "blue", "alpha"};
    const auto count = static_cast<std::size_t>(file_.mesh.vertex_count());
    for (const char* name : names)
      file_.vertex_properties.push_back({name, ScalarType::Uint8, std::vector<double>(count)});
    for (std::size_t v = 0; v < count; ++v)
      for (Property& channel : file_.vertex_properties)
        channel.values[v] = reader_.number<std::uint8_t>("the colours");
  }

  void read_layers(const Mz3Header& header) {
    constexpr std::uint64_t most_layers = 256;
    const std::uint64_t size = header.layer_bytes();
    if (size == 0) {
      if (reader_.remaining() > 0) file_.notes.push_back("data after the end of the mesh ignored");
      return;
    }
    const std::uint64_t layers = reader_.remaining() / size;
    if (layers == 0 || reader_.remaining() % size != 0)
      reader_.fail("what is left are no whole layers of one number a vertex");
    if (layers > most_layers)
      reader_.fail(std::to_string(layers) + " layers are over the limit of " +
                   std::to_string(most_layers));
    for (std::uint64_t i = 0; i < layers; ++i) read_layer(header, i);
    if (header.has(Has::lookup))
      add_loss(file_.notes, "that the layers are labels with a table of colours");
  }

  void read_layer(const Mz3Header& header, std::uint64_t i) {
    const bool is_occlusion = i == 0 && header.has(Has::occlusion);
    const std::string number = i == 0 ? "" : "_" + std::to_string(i + 1);
    Property layer{is_occlusion ? "ao" : "scalar" + number,
                   header.has(Has::doubles) ? ScalarType::Float64 : ScalarType::Float32,
                   {}};
    for (std::uint32_t v = 0; v < header.vertices; ++v) {
      layer.values.push_back(layer.type == ScalarType::Float64
                                 ? reader_.number<double>("the layers")
                                 : static_cast<double>(reader_.number<float>("the layers")));
    }
    if (const std::string why = non_finite_words(layer.values); !why.empty())
      add_loss(file_.notes, "layer " + std::to_string(i + 1) + ": " + why);
    else
      file_.vertex_properties.push_back(std::move(layer));
  }

  ByteReader reader_;
  const std::string& name_;
  const ReadOptions& options_;
  MeshFile file_;
};

}  // namespace

bool looks_like_mz3(std::string_view bytes) {
  if (!bytes.starts_with(mz3_magic) || bytes.size() < mz3_header_bytes) return false;
  const std::string nameless;
  ByteReader reader(bytes, nameless, std::endian::little);
  const Mz3Header header(reader);
  return header.attributes > 0 && header.attributes <= Has::all &&
         header.bytes() <= reader.remaining();
}

MeshFile read_mz3(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  return Mz3Reader(bytes, name, options).read();
}

}  // namespace sphparam
