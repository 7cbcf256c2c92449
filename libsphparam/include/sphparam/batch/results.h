#pragma once

#include <string>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// One row an item, in the plan's order: id, path, outcome, code, step, reason, attempt, repairs,
/// how many warnings, then the columns of the table that it was planned from ("table.NAME" where a
/// column is called so already), then the figures of the reports of its steps under SUBCOMMAND.KEY,
/// as
/// `--json` names them (SUBCOMMAND2 of the second such step), then what it took. Of lists there are
/// up to 16 real numbers, under KEY.0, KEY.1 …, and what has a name or is an image of a map, under
/// KEY.NAME. RFC 4180 but for the separator, UTF-8. Throws: ReadError. Cost: reads all records.
std::string batch_table(const std::string& folder, const BatchPlan& plan, int threads = 0,
                        char separator = ',');

struct BatchPageOptions {
  /// Where the page will lie: links to pictures and files are relative to this folder.
  std::string page_folder;
  std::string title;
  int threads = 0;
};

/// One page of HTML of a whole batch: counts, failures by reason, distributions of distortion with
/// their outliers by name, every shape with its picture, verdict and figures, outliers first; to be
/// sorted, filtered and leafed through. Pictures are drawn into the batch's folder, where they are
/// not there yet, and loaded when they are looked at. An outlier is beyond the upper quartile by
/// more than 1.5 times the distance of the quartiles (Tukey's fence), of logarithms. Ensures:
/// nothing is loaded from anywhere else. Throws: ReadError; WriteError. Cost: reads all records,
/// and each map once; about 300 bytes of page an item.
std::string batch_page(const std::string& folder, const BatchPlan& plan,
                       const BatchPageOptions& options);

}  // namespace sphparam
