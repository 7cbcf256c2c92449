#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/correspondence/match.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/progress.h"

namespace sphparam {

struct MatchPageOptions {
  std::vector<LandmarkPair> landmarks = {};  // that the match was given
  bool viewer = true;                        // as `PageOptions::viewer`
  Up up = {};                                // of the first surface; nothing: as its file says
  int size = 1024;  // pixels, the width of textures; pictures have half of it as their height; a
                    // multiple of 4, 64 to 8192
  std::vector<std::pair<std::string, std::string>> facts = {};  // for the foot of the page
  int threads = 0;                                              // 0: all cores
  Progress progress = {};
};

/// One page of HTML that shows a match and needs nothing else: a model that turns one surface into
/// the other; both in the same colours where they correspond, with lines between points; both, and
/// both spheres, with the same lines of longitude and latitude; the distortion between them as
/// heat, histograms and figures, both ways; landmarks, or those that were found. Ensures: the page
/// loads nothing from anywhere; the same bytes for any number of threads. Throws:
/// std::invalid_argument, before any work, for a size outside its domain; as `make_morph`;
/// ImageError; Cancelled. Cost: some 10 s, the most of it for pictures.
std::string make_match_page(const Match& match, const MatchPageOptions& options = {});

}  // namespace sphparam
