#pragma once

#include <vector>

#include "remesh/limit_subject.h"

namespace sphparam::tests {

/// Bases by both schemes: without any regular patch and with many, of triangles, quads and both.
inline const std::vector<LimitSubject> base_subjects = {
    {"ico:0", Scheme::Loop},          {"ico:3", Scheme::Loop},
    {"octa:9", Scheme::Loop},         {"cube:2", Scheme::CatmullClark},
    {"cube:7", Scheme::CatmullClark}, {"uv:12x7", Scheme::CatmullClark}};

}  // namespace sphparam::tests
