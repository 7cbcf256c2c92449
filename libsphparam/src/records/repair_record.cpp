#include "sphparam/records/repair_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "number_text.h"
#include "records/json_parts.h"
#include "sphparam/io/shape_change.h"
#include "sphparam/names.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

Json number_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

/// Null where nothing was put in.
Json shape_json(const std::optional<ShapeChange>& change) {
  if (!change) return nullptr;
  return {{"volume", number_or_null(change->volume)},
          {"volume_before", number_or_null(change->volume_before)},
          {"bounding_box", {vector_json(change->lower), vector_json(change->upper)}},
          {"bounding_box_before",
           {vector_json(change->lower_before), vector_json(change->upper_before)}}};
}

}  // namespace

std::string to_json(const RepairRecord& record) {
  const MeshSource& source = record.source;
  return text_of({{"sphparam", version},
                  {"command", "repair"},
                  {"input", input_json(source)},
                  {"wanted", names_of(record.wanted)},
                  {"welded", source.welded},
                  {"repairs", repairs_json(source.repairs)},
                  {"handles", handles_json(source.handles)},
                  {"added", source.added_share},
                  {"shape", shape_json(shape_change(source))},
                  {"components", parts_json(source.parts)},
                  {"inspection", inspection_json(source.inspection)},
                  {"losses", record.losses},
                  {"outputs", pairs_json(record.outputs)},
                  {"notes", source.notes},
                  {"seconds", record.seconds}});
}

std::string outcome_line(const MeshInspection& mended) {
  const auto all_flat = [&](const MeshDefect& defect) {
    return defect.kind == DefectKind::ZeroAreaFace && defect.count == mended.faces;
  };
  if (mended.is_sphere())
    return std::ranges::any_of(mended.defects, all_flat)
               ? "a closed genus-0 mesh without area: it has no shape that could be mapped"
               : "a closed genus-0 mesh: it can be mapped";
  std::vector<std::string> reasons;
  for (const MeshDefect& defect : mended.defects)
    if (defect.fatal) reasons.push_back(defect.message);
  return "still no closed genus-0 mesh: " + joined(reasons, "; ");
}

}  // namespace sphparam
