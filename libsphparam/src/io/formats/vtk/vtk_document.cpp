#include "io/formats/vtk/vtk_document.h"

#include <utility>

#include "io/formats/xml_events.h"
#include "parsed_number.h"

// VTKFile > PolyData > Piece > { PointData, CellData, Points, Verts, Lines, Strips, Polys }, each
// with DataArrays. AppendedData comes last and may be raw bytes, which are no XML: reading as XML
// ends at its start tag.

namespace sphparam {
namespace {

constexpr std::size_t deepest = 16;

class Builder : public XmlEvents {
 public:
  explicit Builder(const std::string& name) : name_(name) {}

  bool start(std::string_view element, const XmlAttributes& attributes, long line) override {
    line_ = line;
    if (path_.size() >= deepest) fail("elements are nested deeper than VTK has them");
    if (path_.empty()) start_file(element, attributes);
    if (element == "Piece") start_piece(attributes);
    if (inside("Piece") && (element == "PointData" || element == "CellData")) {
      VtkXmlData& data = element == "PointData" ? piece().point_data : piece().cell_data;
      data.normals = attributes.value("Normals");
      data.texcoords = attributes.value("TCoords");
    }
    if (element == "DataArray" || element == "Array") start_array(attributes);
    if (element == "AppendedData") {
      document.appended_is_base64 = attributes.value("encoding") == "base64";
      return true;
    }
    path_.emplace_back(element);
    return false;
  }

  void text(std::string_view text) override {
    if (array_ && inside_array()) array_->text.append(text);
  }

  void end(std::string_view element) override {
    path_.pop_back();
    if (array_ && (element == "DataArray" || element == "Array")) finish_array();
  }

  VtkDocument document;

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_line(name_, line_, message);
  }

  bool inside(std::string_view parent) const { return !path_.empty() && path_.back() == parent; }
  bool inside_array() const { return inside("DataArray") || inside("Array"); }
  VtkXmlPiece& piece() {
    if (document.pieces.empty()) fail("data outside of a <Piece>");
    return document.pieces.back();
  }

  void start_file(std::string_view element, const XmlAttributes& attributes) {
    if (element != "VTKFile") fail("expected <VTKFile>, found " + quoted(element));
    const std::string_view kind = attributes.value("type");
    if (kind == "PPolyData" || kind == "Collection" || kind.starts_with("vtk"))
      fail("holds a " + quoted(kind) +
           ", which names files that hold the data: read these one by one, if they are .vtp, or "
           "save all as one PolyData (ParaView: Merge Blocks, Extract Surface)");
    if (kind != "PolyData")
      fail("holds a " + quoted(kind) +
           ", which is not supported; PolyData is (a filter such as Extract Surface makes one)");
    document.order =
        attributes.value("byte_order") == "BigEndian" ? std::endian::big : std::endian::little;
    const std::string_view header = attributes.value("header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64")
      fail("the unknown header_type " + quoted(header));
    document.wide_headers = header == "UInt64";
    const std::string_view compressor = attributes.value("compressor");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail("is compressed by " + quoted(compressor) +
           ", which is not supported: save it with the compressor ZLib or None");
    document.compressed = !compressor.empty();
  }

  void start_piece(const XmlAttributes& attributes) {
    if (!inside("PolyData")) fail("<Piece> is not directly within <PolyData>");
    VtkXmlPiece& piece = document.pieces.emplace_back();
    piece.points = number(attributes, "NumberOfPoints", 0);
    piece.verts = number(attributes, "NumberOfVerts", 0);
    piece.lines = number(attributes, "NumberOfLines", 0);
    piece.strips = number(attributes, "NumberOfStrips", 0);
    piece.polys = number(attributes, "NumberOfPolys", 0);
  }

  /// From 0 to 2³¹ − 1.
  std::int64_t number(const XmlAttributes& attributes, std::string_view key,
                      std::int64_t otherwise) const {
    const std::string_view text = attributes.value(key);
    if (text.empty()) return otherwise;
    const int value = parsed<int>(text).value_or(-1);
    if (value < 0) fail(std::string(key) + " is " + quoted(text) + ", no whole number in range");
    return value;
  }

  void start_array(const XmlAttributes& attributes) {
    if (array_) fail("an array within an array");
    array_.emplace();
    array_->line = line_;
    array_->name = attributes.value("Name");
    array_->type = attributes.value("type");
    array_->width = number(attributes, "NumberOfComponents", 1);
    constexpr std::int64_t most_components = 256;
    if (array_->width < 1 || array_->width > most_components)
      fail("an array of " + std::to_string(array_->width) + " components");
    const std::string_view format = attributes.value("format");
    if (format == "appended") {
      array_->encoding = VtkEncoding::Appended;
      array_->offset = offset(attributes.value("offset"));
    } else if (format == "binary") {
      array_->encoding = VtkEncoding::Binary;
    } else if (!format.empty() && format != "ascii") {
      fail("the unknown format " + quoted(format));
    }
    for (std::int64_t k = 0; k < array_->width; ++k)
      array_->component_names.emplace_back(attributes.value("ComponentName" + std::to_string(k)));
  }

  std::uint64_t offset(std::string_view text) const {
    const std::optional<std::uint64_t> value = parsed<std::uint64_t>(text);
    if (!value) fail("offset is " + quoted(text) + ", no whole number");
    return *value;
  }

  void finish_array() {
    VtkXmlArray array = *std::exchange(array_, std::nullopt);
    const std::string parent = path_.empty() ? "" : path_.back();
    if (parent == "FieldData") {
      document.field_data.push_back(std::move(array));
    } else if (parent == "PointData") {
      piece().point_data.arrays.push_back(std::move(array));
    } else if (parent == "CellData") {
      piece().cell_data.arrays.push_back(std::move(array));
    } else if (parent == "Points") {
      set(piece().coordinates, std::move(array));
    } else if (parent == "Strips" || parent == "Polys") {
      VtkXmlPiece::Cells& cells = parent == "Polys" ? piece().poly_cells : piece().strip_cells;
      if (array.name == "connectivity")
        set(cells.connectivity, std::move(array));
      else if (array.name == "offsets")
        set(cells.offsets, std::move(array));
    }
  }

  void set(std::optional<VtkXmlArray>& place, VtkXmlArray array) const {
    if (place) fail_in_array(name_, array, "is the second one");
    place = std::move(array);
  }

  const std::string& name_;
  long line_ = 1;
  std::vector<std::string> path_;  // names of the open elements
  std::optional<VtkXmlArray> array_;
};

}  // namespace

VtkDocument parse_vtk_document(std::string_view bytes, const std::string& name) {
  Builder builder(name);
  const std::size_t end = read_xml(bytes, name, builder);
  VtkDocument document = std::move(builder.document);
  const std::string_view rest = bytes.substr(end);
  const std::size_t underscore = rest.find_first_not_of(" \t\r\n");
  if (underscore != std::string_view::npos && rest[underscore] == '_')
    document.appended = rest.substr(underscore + 1);
  if (document.appended_is_base64)
    document.appended = document.appended.substr(0, document.appended.find('<'));
  return document;
}

void fail_in_array(const std::string& name, const VtkXmlArray& array, const std::string& message) {
  throw ReadError::at_line(name, array.line, "array " + quoted(array.name) + " " + message);
}

}  // namespace sphparam
