#pragma once

#include <vector>

#include "compare/comparison.h"
#include "paper_trial.h"
#include "report/page.h"
#include "sphparam/render/picture.h"

/// The paper's figures again, with our maps beside its own.
namespace sphparam::samples {

/// Figures 2, 5, 6 with 10, 7 with 11, 8, and 1, 3, 9, each of the model that the paper shows where
/// it is among the trials, else of another one. Pictures, of so many pixels a side, and charts are
/// added to `files`.
/// Requires: trials that kept their maps; at least one. Throws: ImageError.
void add_figures(sphparam::Page& page, sphparam::FolderFiles& files,
                 const std::vector<Trial>& trials, int picture_size = PictureOptions{}.size);

}  // namespace sphparam::samples
