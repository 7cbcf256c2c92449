#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/chart_report.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

// What several reports tell alike. References in reports are to values that outlive them. The keys
// are documented in docs/commands/index.md and never change their meaning. Numbers that are not
// finite become null.

using Json = nlohmann::ordered_json;
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

struct InputReport {
  const std::string& file;
  const MeshSource& source;
};

Json pairs_json(const NamedTexts& pairs);
Json input_json(const InputReport& input);
Json inspection_json(const MeshInspection& inspection);
Json defect_json(const MeshDefect& defect);
Json repairs_json(const std::vector<RepairAction>& repairs);
/// What choosing a component kept, or may choose from; null where there was one only.
Json parts_json(const KeptParts& parts);
Json stage_json(const StageRecord& stage);
Json certificate_json(const Certificate& certificate);
Json distortion_json(const std::optional<DistortionSummary>& distortion);
Json chart_json(const std::optional<ChartReport>& chart);

/// The report as it is written. Bytes of a file name that are not UTF-8 must not stop it.
std::string text_of(const Json& json);

}  // namespace sphparam::cli
