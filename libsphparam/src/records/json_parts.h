#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/chart/chart_report.h"
#include "sphparam/gltf/texture_format.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/mesh/self_crossings.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/faces_in_space.h"

namespace sphparam {

// What several records tell alike. The keys are documented in docs/commands/index.md and never
// change their meaning. Numbers that are not finite become null.

using Json = nlohmann::ordered_json;

Json pairs_json(const std::vector<std::pair<std::string, std::string>>& pairs);
Json vector_json(const Vector3& vector);
/// What the file of a mesh holds.
Json input_json(const MeshSource& source);
Json inspection_json(const MeshInspection& inspection);
Json defect_json(const MeshDefect& defect);
Json crossings_json(const SelfCrossings& crossings);
/// Null where nobody looked.
Json in_space_json(const std::optional<FacesInSpace>& found);
Json repairs_json(const std::vector<RepairAction>& repairs);
/// The loops that handles were cut along, in order.
Json handles_json(const std::vector<HandleLoop>& loops);
/// What choosing a component kept, or may choose from; null where there was one only.
Json parts_json(const KeptParts& parts);
Json stages_json(const std::vector<StageRecord>& stages);
Json certificate_json(const Certificate& certificate);
Json distortion_json(const std::optional<DistortionSummary>& distortion);
/// What became of the images of a glTF file.
Json textures_json(const std::vector<TextureFigures>& textures);
Json chart_json(const std::optional<ChartReport>& chart);

/// The record as it is written. Bytes of a file name that are not UTF-8 must not stop it.
std::string text_of(const Json& json, int indent = 2);

}  // namespace sphparam
