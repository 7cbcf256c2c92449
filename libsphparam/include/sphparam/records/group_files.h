#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/safe_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/progress.h"
#include "sphparam/records/group_record.h"

namespace sphparam {

struct GroupFileOptions {
  Up up = {};      // of the shapes; nothing: as the template's file says
  int size = 320;  // pixels of a picture, 64 to 4096; 0: a page without any
  int threads = 0;
  Progress progress = {};
};

/// Adds what a group is written as, to a folder that is there; returns the names, as in
/// `GroupRecord::outputs`, of all but group.json, which `to_json` makes.
///
/// index.html; mean.sph.ply with `deviation`, `normal_deviation` and `weight`, and mean.glb; for
/// each mode modeK.glb, which turns the mean into its two ends, two standard deviations away, and
/// these as modeK_minus.glb and modeK_plus.glb; of each shape map_NAME.sph.ply, its mesh with its
/// map in correspondence, and shape_NAME.sph.ply, on the mean, with `normal_displacement` from it;
/// shapes.tsv, distances.tsv, vertices.tsv, and, where there are some, landmarks.tsv. Every map is
/// proved again as it is read back. Throws: WriteError; NotCertifiedError; ImageError; Cancelled.
std::vector<std::string> add_group(PendingFiles& files, const std::string& folder,
                                   const GroupRecord& record, const GroupFileOptions& options = {});

/// The page alone. Requires nothing of a folder; its figures are in it.
std::string group_page(const GroupRecord& record, const GroupFileOptions& options = {});

}  // namespace sphparam
