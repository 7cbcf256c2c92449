#pragma once

#include <string>
#include <string_view>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// A plan as the bytes of its manifest; without its name, which is their hash.
///
/// Lines of fields between tabs. Those that begin with '#' tell what the format is, `chunk`,
/// and each `step` with its words; the next names the columns, the others are items.
std::string manifest_text(const BatchPlan& plan);

/// Throws: ReadError. `file`: for messages.
BatchPlan parse_manifest(std::string_view text, const std::string& file);

/// The path of a plan's manifest.
std::string manifest_path(const std::string& folder, const std::string& name);

}  // namespace sphparam
