#pragma once

#include <vector>

#include "report/page.h"
#include "showcase/page_entry.h"

namespace sphparam {

/// Tables about maps of one mesh, a column a map and a row a figure.
PageTable distortion_table(const std::vector<PageEntry>& entries);
PageTable certificate_table(const std::vector<PageEntry>& entries);
/// What the (u, v) charts needed; no rows where no map has one.
PageTable chart_table(const std::vector<PageEntry>& entries);
/// What the files say of how their maps came about; no rows where they say nothing.
PageTable provenance_table(const std::vector<PageEntry>& entries);

}  // namespace sphparam
