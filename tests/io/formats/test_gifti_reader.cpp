#include <zlib.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>

#include "io/formats/gifti/gifti_writer.h"
#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;

namespace {

std::string base64(const std::string& bytes) {
  const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(k <= here ? digits[group >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  compress(reinterpret_cast<Bytef*>(result.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  result.resize(size);
  return result;
}

/// 32-bit words, in either byte order.
std::string words(const std::vector<std::uint32_t>& numbers, bool big = false) {
  std::string bytes;
  for (const std::uint32_t number : numbers)
    for (int i = 0; i < 4; ++i)
      bytes.push_back(static_cast<char>(number >> (8 * (big ? 3 - i : i))));
  return bytes;
}

struct Array {
  std::string intent, type, data;
  std::string dimensions;
  std::string encoding = "ASCII", endian = "LittleEndian", order = "RowMajorOrder";
  std::string inside = {};  // between the tags, before the data

  std::string xml() const {
    return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
           "\" ArrayIndexingOrder=\"" + order + "\" " + dimensions + " Encoding=\"" + encoding +
           "\" Endian=\"" + endian + "\" ExternalFileName=\"\" ExternalFileOffset=\"\">\n" +
           inside + "<Data>" + data + "</Data>\n</DataArray>\n";
  }
};

std::string gifti(const std::vector<Array>& arrays, const std::string& prologue = "") {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + prologue +
                     "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"" +
                     std::to_string(arrays.size()) + "\">\n";
  for (const Array& array : arrays) text += array.xml();
  return text + "</GIFTI>\n";
}

constexpr const char* four_by_three = R"(Dimensionality="2" Dim0="4" Dim1="3")";

Array points(const std::string& data = "1 1 1 -1 -1 1\n-1 1 -1 1 -1 -1") {
  return {"POINTSET", "FLOAT32", data, four_by_three};
}
Array triangles(const std::string& data = "0 2 1 0 1 3 0 3 2 1 2 3") {
  return {"TRIANGLE", "INT32", data, four_by_three};
}
const std::vector<std::uint32_t> corner_indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

std::string tetrahedron_gifti() { return gifti({points(), triangles()}); }

}  // namespace

TEST_CASE("gifti_reader: a surface has its coordinates and triangles") {
  const MeshFile file = read(tetrahedron_gifti());
  CHECK(file.format == "GIFTI");
  CHECK(file.mesh.positions == tetrahedron().positions);
  CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
  CHECK(file.position_type == ScalarType::Float32);
  CHECK(file.notes.empty());
}

TEST_CASE("gifti_reader: every encoding, byte order and index order means the same") {
  const Triangles expected = read(tetrahedron_obj).mesh.triangles;
  for (const bool big : {false, true}) {
    const std::string bytes = words(corner_indices, big);
    for (const bool compressed : {false, true}) {
      Array array = triangles(base64(compressed ? packed(bytes) : bytes));
      array.encoding = compressed ? "GZipBase64Binary" : "Base64Binary";
      array.endian = big ? "BigEndian" : "LittleEndian";
      CHECK(read(gifti({points(), array})).mesh.triangles == expected);
      array.data.insert(5, "\n  ");
      CHECK(read(gifti({array, points()})).mesh.triangles == expected);
    }
  }
  Array by_column = triangles("0 0 0 1 2 1 3 2 1 3 2 3");
  by_column.order = "ColumnMajorOrder";
  CHECK(read(gifti({points(), by_column})).mesh.triangles == expected);
  // Text without a number, and no row to take numbers from.
  Array nothing = triangles("\n");
  nothing.dimensions = R"(Dimensionality="2" Dim0="0" Dim1="3")";
  for (const char* order : {"RowMajorOrder", "ColumnMajorOrder"}) {
    nothing.order = order;
    CHECK(read(gifti({points(), nothing})).mesh.face_count() == 0);
  }
}

TEST_CASE("gifti_reader: one number a vertex is a property, named by its metadata") {
  Array thickness = {"SHAPE", "FLOAT32", "1.5 2 2.5 3", R"(Dimensionality="1" Dim0="4")"};
  thickness.inside =
      "<MetaData><MD><Name><![CDATA[Name]]></Name><Value>cortical "
      "thickness</Value></MD></MetaData>";
  const Array labels = {"LABEL", "INT32", "7 8 9 10", R"(Dimensionality="2" Dim0="4" Dim1="1")"};
  const Array series = {"TIME_SERIES", "FLOAT32", "1 2", R"(Dimensionality="1" Dim0="2")"};
  const Array holes = {"SHAPE", "FLOAT32", "1 nan 2 3", R"(Dimensionality="1" Dim0="4")"};
  const MeshFile file =
      read(gifti({points(), triangles(), thickness, labels, labels, series, holes}));
  CHECK(values_of(file.find_vertex_property("cortical_thickness")) ==
        std::vector<double>{1.5, 2, 2.5, 3});
  CHECK(values_of(file.find_vertex_property("LABEL")) == std::vector<double>{7, 8, 9, 10});
  CHECK(file.find_vertex_property("LABEL")->type == ScalarType::Int32);
  CHECK(file.find_vertex_property("LABEL_2"));
  CHECK(file.vertex_properties.size() == 3);
  CHECK(sphparam::losses_among(file.notes).size() == 2);
}

TEST_CASE("gifti_reader: a label table is kept as comments, and written to a PLY and back") {
  const std::string table =
      "<LabelTable><Label Key=\"0\" Red=\"1\" Green=\"1\" Blue=\"1\" Alpha=\"0\"><![CDATA[???]]>"
      "</Label><Label Key=\"35\" Red=\"0.1\">G front &amp; Orb</Label><Label Index=\"-4\"/>"
      "</LabelTable><DataArray ";
  std::string text = tetrahedron_gifti();
  text.replace(text.find("<DataArray "), 11, table);
  const MeshFile file = read(text);
  CHECK(file.comments == std::vector<std::string>{"gifti label 0 1 1 1 0 ???",
                                                  "gifti label 35 0.1 0 0 1 G front & Orb",
                                                  "gifti label -4 - "});
  CHECK(read(sphparam::serialise_ply(file)).comments == file.comments);
  CHECK(contains(complaint(replaced(text, "Key=\"35\"", "")), "label without a key"));
  CHECK(contains(complaint(replaced(text, "\"35\"", "\"3.5\"")), "whole number"));
  CHECK(contains(complaint(replaced(text, "\"0.1\"", "\"nan\"")), "expected a number"));
}

TEST_CASE("gifti_reader: coordinates of the scanner stay such, with a volume and without") {
  const auto in_space = [](const std::string& from, const std::string& to,
                           const std::string& matrix) {
    Array array = points();
    array.inside = "<CoordinateSystemTransformMatrix><DataSpace>" + from +
                   "</DataSpace><TransformedSpace>" + to + "</TransformedSpace><MatrixData>" +
                   matrix + "</MatrixData></CoordinateSystemTransformMatrix>";
    return read(gifti({array, triangles()}));
  };
  const std::string none = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
                    moves = "1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1";
  const std::string scanner = "NIFTI_XFORM_SCANNER_ANAT", unknown = "NIFTI_XFORM_UNKNOWN";
  for (const MeshFile& file :
       {in_space(scanner, scanner, none), in_space(unknown, scanner, none)}) {
    CHECK(file.comments == std::vector<std::string>{"freesurfer real_ras 1"});
    CHECK(file.notes.empty());
    const MeshFile again = read(sphparam::serialise_gifti(file));
    CHECK(again.comments.back() == "freesurfer real_ras 1");
    CHECK(again.notes.empty());
  }
  CHECK(in_space(unknown, scanner, moves).comments.empty());
  CHECK(in_space(unknown, unknown, none).notes.empty());
}

TEST_CASE("gifti_reader: blanks do not count as data that could unpack to something") {
  const auto said = [](const std::string& data, const std::string& encoding, int rows) {
    Array array = triangles(data);
    array.encoding = encoding;
    array.dimensions = "Dimensionality=\"2\" Dim0=\"" + std::to_string(rows) + "\" Dim1=\"3\"";
    return complaint(gifti({points(), array}), "a.gii");
  };
  const std::string blanks(1 << 20, '\n');
  for (const char* encoding : {"ASCII", "Base64Binary", "GZipBase64Binary"})
    CHECK(contains(said(blanks, encoding, 1000), "cannot hold"));
  const std::string corners = base64(packed(words(corner_indices)));
  CHECK(said(blanks + corners + blanks, "GZipBase64Binary", 4).empty());
  CHECK(contains(said(blanks + corners, "GZipBase64Binary", 1 << 19), "cannot hold"));
}

TEST_CASE("gifti_reader: what the surface is comes as comments, a transform not applied is told") {
  Array array = points();
  array.inside =
      "<MetaData><MD><Name>AnatomicalStructurePrimary</Name><Value>CortexLeft</Value></MD>"
      "</MetaData><CoordinateSystemTransformMatrix><DataSpace>NIFTI_XFORM_TALAIRACH</DataSpace>"
      "<TransformedSpace>X</TransformedSpace><MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
      "</MatrixData></CoordinateSystemTransformMatrix>";
  const MeshFile file = read(gifti({array, triangles()}));
  CHECK(file.comments == std::vector<std::string>{"gifti AnatomicalStructurePrimary CortexLeft"});
  const std::vector<std::string> space = {
      "not carried: that coordinates are in the space 'NIFTI_XFORM_TALAIRACH'"};
  CHECK(file.notes == space);  // the identity
  // What has the name of a part of it elsewhere is none of it.
  const std::string elsewhere = "<MatrixData>5</MatrixData>";
  Array beside = array;
  beside.inside += "<Other>" + elsewhere + "</Other>";
  CHECK(read(gifti({beside, triangles()})).notes == space);
  CHECK(read(replaced(gifti({triangles(), array}), "</GIFTI>",
                      "<CoordinateSystemTransformMatrix>" + elsewhere +
                          "</CoordinateSystemTransformMatrix></GIFTI>"))
            .notes == space);
  Array signed_by = points();
  signed_by.inside = "<MetaData><MD><Name>UserName</Name><Value>me</Value></MD></MetaData>";
  CHECK(read(gifti({signed_by, triangles()})).notes ==
        std::vector<std::string>{"not carried: metadata 'UserName'"});
  for (const char* other : {"1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1", "1 0 0 0 0 1", "", "1 0 0 x"}) {
    array.inside = replaced(array.inside, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", other);
    const MeshFile moved = read(gifti({array, triangles()}));
    REQUIRE(sphparam::losses_among(moved.notes).size() == 1);
    CHECK(contains(moved.notes[0], "TALAIRACH"));
    array.inside = replaced(array.inside, std::string("<MatrixData>") + other,
                            "<MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
  }
}

TEST_CASE("gifti_reader: what breaks the rules is refused at its line") {
  const auto refused = [](const std::string& text, int line, const std::string& expected) {
    const std::string message = complaint(text, "a.gii");
    INFO(text.substr(0, 400) << " -> " << message);
    CHECK(contains(message, expected));
    if (line > 0) CHECK(contains(message, "a.gii:" + std::to_string(line) + ": "));
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    return replaced(tetrahedron_gifti(), from, to);
  };
  refused(changed("</GIFTI>", ""), 11, "malformed XML");
  refused(changed("NumberOfDataArrays=\"2\"", "NumberOfDataArrays=\"3\""), 0, "announces 3");
  refused(changed("NumberOfDataArrays=\"2\"", ""), 2, "missing");
  refused(changed("Version=\"1.0\" N", "Version=\"2.0\" N"), 2, "version");
  refused(changed("Dim0=\"4\" Dim1", "Dim0=\"5\" Dim1"), 5, "fewer numbers");
  refused(changed("Dim0=\"4\"", "Dim0=\"-4\""), 3, "whole number");
  refused(changed("Dim0=\"4\"", ""), 3, "Dimensionality");
  refused(changed("Dim0=\"4\"", "Dim0=\"2147483647\""), 3, "cannot hold");
  refused(changed("Dim1=\"3\"", "Dim1=\"2147483647\""), 3, "cannot hold");
  refused(changed(four_by_three,  // 2⁶⁴ numbers
                  R"(Dimensionality="4" Dim0="65536" Dim1="65536" Dim2="65536" Dim3="65536")"),
          3, "cannot hold");
  refused(changed("Dimensionality=\"2\"", "Dimensionality=\"7\""), 3, "1 to 6");
  refused(changed("ASCII", "ExternalFileBinary"), 3, "another file");
  refused(changed("ExternalFileName=\"\"", "ExternalFileName=\"x\""), 3, "another file");
  refused(changed("ASCII", "Morse"), 3, "Morse");
  refused(changed("RowMajorOrder", "Spiral"), 3, "Spiral");
  refused(changed("NIFTI_TYPE_FLOAT32", "NIFTI_TYPE_COMPLEX64"), 3, "COMPLEX64");
  refused(changed("NIFTI_TYPE_FLOAT32", "NIFTI_TYPE_INT32"), 3, "no real numbers");
  refused(changed("NIFTI_TYPE_INT32", "NIFTI_TYPE_FLOAT32"), 7, "no whole numbers");
  refused(changed("1 1 1", "1 1 nan"), 3, "vertex 0 that is not finite");
  refused(changed("1 1 1", "1 1 0x1"), 4, "0x1");
  refused(changed("1 2 3", "1 2 3 4"), 8, "more numbers");
  refused(changed("1 2 3", "1 2 4"), 7, "vertex 4 of 4 in triangle 3");
  refused(changed("1 2 3", "1 2 -1"), 7, "vertex -1");
  refused(changed("1 2 3", "1 2 2.5"), 8, "2.5");
  refused(changed("1 2 3", "1 2 99999999999"), 8, "99999999999");
  refused(changed("1 2 3", "1 2 2"), 7, "twice in triangle 3");
  CHECK(read(changed("1 2 3", "1 2 2"), "mesh", {.repeated_corners = true}).mesh.face_count() == 4);
  refused(changed("<Data>", "<Data></Data><Data>"), 4, "second <Data>");
  refused(changed("<Data>", "<Other>"), 0, "malformed");
  refused(changed("<Data>0 2 1 0 1 3 0 3 2 1 2 3</Data>", ""), 7, "has no <Data>");
  refused(gifti({points()}), 0, "no array of NIFTI_INTENT_TRIANGLE");
  refused(gifti({triangles(), triangles()}), 0, "no array of NIFTI_INTENT_POINTSET");
  refused(gifti({points(), points(), triangles()}), 7, "second one");
  refused("<GIFTI><GIFTI/></GIFTI>", 1, "version");
  refused("<?xml version=\"1.0\"?><!DOCTYPE GIFTI><GIFT/>", 1, "expected <GIFTI>");
  std::string deep = "<GIFTI Version=\"1\" NumberOfDataArrays=\"0\">";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  refused(deep, 1, "nested deeper");
}

TEST_CASE("gifti_reader: entities are refused, the document type that libgiftiio writes is not") {
  const std::string named =
      "<!DOCTYPE GIFTI SYSTEM \"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n";
  CHECK(complaint(gifti({points(), triangles()}, named)).empty());
  const std::string laughs =
      "<!DOCTYPE GIFTI [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n";
  CHECK(contains(complaint(gifti({points("&b;"), triangles()}, laughs)), "entity"));
  const std::string stranger = "<!DOCTYPE GIFTI [<!ENTITY a SYSTEM \"file:///etc/hostname\">]>\n";
  CHECK(contains(complaint(gifti({points("&a;"), triangles()}, stranger)), "entity"));
}

TEST_CASE("gifti_reader: binary data is neither cut, guessed nor padded") {
  const std::string bytes = words(corner_indices);
  const auto said = [](const std::string& data, const std::string& encoding,
                       const std::string& dimensions = four_by_three) {
    Array array = triangles(data);
    array.encoding = encoding;
    array.dimensions = dimensions;
    return complaint(gifti({points(), array}), "a.gii");
  };
  const std::string plain = base64(bytes), squeezed = base64(packed(bytes));
  CHECK(said(plain, "Base64Binary").empty());
  CHECK(contains(said(plain.substr(4), "Base64Binary"), "cannot hold"));
  CHECK(contains(said(plain + "AAAA", "Base64Binary"), "another number of bytes"));
  CHECK(contains(said(plain.substr(1) + "A", "Base64Binary"), "of 4 in triangle"));
  CHECK(contains(said(plain + "A", "Base64Binary"), "cut short"));
  CHECK(contains(said("*" + plain, "Base64Binary"), "no base64"));
  CHECK(contains(said("=" + plain + "AAA", "Base64Binary"), "no base64"));

  CHECK(said(squeezed, "GZipBase64Binary").empty());
  CHECK(contains(said(base64(packed(bytes).substr(0, 20)), "GZipBase64Binary"), "cut short"));
  std::string corrupt = packed(bytes);
  corrupt.back() = static_cast<char>(corrupt.back() + 1);  // of the checksum
  CHECK(contains(said(base64(corrupt), "GZipBase64Binary"), "corrupt"));
  CHECK(contains(said(base64(packed(bytes + bytes)), "GZipBase64Binary"), "another size"));
  CHECK(contains(said(base64(packed(bytes.substr(4))), "GZipBase64Binary"), "another size"));
  CHECK(contains(
      said(squeezed, "GZipBase64Binary", R"(Dimensionality="2" Dim0="100000000" Dim1="3")"),
      "cannot hold"));
}

TEST_CASE("gifti_reader: the limits hold at their values and not beyond") {
  for (const int step : {-1, 0, 1}) {
    sphparam::ReadOptions fewer_vertices, fewer_faces;
    fewer_vertices.max_vertices = fewer_faces.max_faces = 4 + step;
    CHECK(complaint(tetrahedron_gifti(), "a", fewer_vertices).empty() == (step >= 0));
    CHECK(complaint(tetrahedron_gifti(), "a", fewer_faces).empty() == (step >= 0));
  }
}

TEST_CASE("gifti_reader: damaged files give a mesh or a ReadError, nothing else") {
  MeshFile sphere;
  sphere.mesh = icosphere(0);
  std::mt19937 random(2003);
  long accepted = 0, refused = 0;
  for (const std::string& seed : {tetrahedron_gifti(), sphparam::serialise_gifti(sphere)})
    for (int round = 0; round < 8000; ++round) {
      std::string bytes = seed;
      for (auto edits = random() % 3 + 1; edits > 0; --edits) {
        const char likely[] = "0123456789-. <>\"/=A&";
        const std::size_t at = random() % bytes.size();
        bytes[at] = random() % 3 ? likely[random() % 20] : static_cast<char>(random());
        if (random() % 8 == 0) bytes.erase(at, random() % 8 + 1);
      }
      try {
        const MeshFile file = read(bytes, "a.gii");
        ++accepted;
        REQUIRE(file.mesh.positions.allFinite());
        REQUIRE((file.mesh.triangles.size() == 0 || file.mesh.triangles.minCoeff() >= 0));
        REQUIRE((file.mesh.triangles.size() == 0 ||
                 file.mesh.triangles.maxCoeff() < file.mesh.vertex_count()));
      } catch (const sphparam::ReadError&) {
        ++refused;
      }
    }
  CHECK(accepted > 500);
  CHECK(refused > 500);
}
