#include "bake/georeference/sidecar.h"

#include <numbers>

#include "number_text.h"

// Longitude grows along the columns from −180° in the west, latitude falls along the rows. Where it
// counts to the west, the same columns have longitudes that fall from 180°.

namespace sphparam {
namespace {

std::string escaped_xml(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:  // XML has no other control characters
        result += static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

/// WKT doubles the quotes in names.
std::string quoted(const std::string& name) {
  std::string result = "\"";
  for (const char c : name) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string geographic_wkt(const std::string& name, const std::string& datum, double radius,
                           bool west, long iau_code) {
  const std::string degree = "ANGLEUNIT[\"degree\",0.0174532925199433]";
  std::string wkt = "GEOGCRS[" + quoted(name) + ",DATUM[" + quoted(datum) + ",ELLIPSOID[" +
                    quoted(datum) + "," + shortest(radius) + ",0,LENGTHUNIT[\"metre\",1]]]," +
                    "PRIMEM[\"Reference Meridian\",0," + degree + "],CS[ellipsoidal,2]," +
                    "AXIS[\"planetocentric latitude (U)\",north,ORDER[1]," + degree + "]," +
                    "AXIS[\"planetocentric longitude (V)\"," + (west ? "west" : "east") +
                    ",ORDER[2]," + degree + "]";
  if (iau_code > 0) wkt += ",ID[\"IAU\"," + std::to_string(iau_code) + ",2015]";
  return wkt + "]";
}

/// As the data has them: longitude first.
const char* axis_mapping(const std::string& wkt) {
  const size_t first = wkt.find("AXIS[");
  const size_t end = first == std::string::npos ? first : wkt.find(']', first);
  if (end == std::string::npos) return "2,1";
  const std::string axis = wkt.substr(first, end - first);
  const auto points = [&axis](const char* to) { return axis.find(to) != std::string::npos; };
  const bool longitude_first =
      points(",east") || points(",west") || points(",EAST") || points(",WEST");
  return longitude_first ? "1,2" : "2,1";
}

std::string element(const char* name, const std::string& text) {
  return std::string("    <") + name + ">" + escaped_xml(text) + "</" + name + ">\n";
}

/// Value = offset + scale · sample.
std::string scaling(const SurfaceField& field, int band, SampleType type) {
  if (!is_integer(type) || field.kind == FieldKind::Colour || field.scale) return "";
  const bool direction = field.kind == FieldKind::Direction;
  const auto [low, high] =
      direction ? std::pair(-1.0, 1.0) : field.range.value_or(std::pair(0.0, 1.0));
  const double full = type == SampleType::Uint8 ? 255 : 65535;
  return element("Offset", shortest(low + field.origin_of(band))) +
         element("Scale", shortest((high - low) / full));
}

/// Images have one channel, three or four: the third of two coordinates is 0.
bool is_nothing(const SurfaceField& field, int band) {
  return field.kind == FieldKind::Place && band == 2;
}

std::string band_name(const SurfaceField& field, int band) {
  if (field.proper_channels() == 1) return field.name;
  static const char* const places[] = {"longitude", "latitude", "nothing"};
  if (field.kind == FieldKind::Place && field.proper_channels() == 3) return places[band];
  const bool colour = field.kind == FieldKind::Colour;
  return field.name + " " + (colour ? "RGBA"[band] : "xyzw"[band]);
}

std::string band_of(const PlannedImage& image, int band) {
  const SurfaceField& field = image.field;
  std::string xml = "  <PAMRasterBand band=\"" + std::to_string(band + 1) + "\">\n";
  if (band >= field.proper_channels()) {
    xml += element("Description", "surface") + element("ColorInterp", "Alpha");
  } else {
    xml += element("Description", band_name(field, band));
    if (!field.unit.empty() && !is_nothing(field, band)) xml += element("UnitType", field.unit);
    xml += scaling(field, band, image.file.sample_type);
    if (image.file.no_data) xml += element("NoDataValue", "nan");
  }
  return xml + "  </PAMRasterBand>\n";
}

}  // namespace

CoordinateSystem coordinate_system(const Body& body, const std::optional<BodyPlaces>& places,
                                   const std::string& source) {
  const bool west = body.positive_west;
  const std::string whose = body.name.empty() ? source : body.name;
  const double radius = body.semi_axes.mean();
  const bool exact = places && places->off == 0;
  if (exact && !body.wkt.empty()) return {body.name, body.wkt};
  std::string name = "sphparam map of " + whose, datum = name;
  if (exact) {
    datum = whose + (body.iau_code > 0 ? " (2015)" : "") + " - Sphere";
    name = datum + " / Ocentric" + (west ? ", positive west" : "");
  } else if (places) {
    constexpr double degrees = 180 / std::numbers::pi,
                     up = 1.005;  // so that three digits are no less
    name = whose + ", planetocentric within " + short_number(up * places->off * degrees) +
           " degrees (" + places->how + ")";
    datum = name;
  }
  const long code = exact && !west ? body.iau_code : 0;
  return {name, geographic_wkt(name, datum, radius, west, code)};
}

std::string sidecar_of(const PlannedImage& image, const BakeSettings& settings,
                       const CoordinateSystem& system) {
  const SurfaceField& field = image.field;
  const bool west = settings.fields.body->positive_west;
  const double texel = 360.0 / image.file.width;
  std::string xml = "<PAMDataset>\n";
  xml += "  <SRS dataAxisToSRSAxisMapping=\"" + std::string(axis_mapping(system.wkt)) + "\">" +
         escaped_xml(system.wkt) + "</SRS>\n";
  xml += "  <GeoTransform>" + std::string(west ? "180" : "-180") + ", " +
         shortest(west ? -texel : texel) + ", 0, 90, 0, " + shortest(-texel) + "</GeoTransform>\n";
  xml += "  <Metadata>\n    <MDI key=\"AREA_OR_POINT\">Area</MDI>\n  </Metadata>\n";
  for (int band = 0; band < field.channels; ++band) xml += band_of(image, band);
  return xml + "</PAMDataset>\n";
}

}  // namespace sphparam
