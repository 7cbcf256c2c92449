#pragma once

#include <string_view>

namespace sphparam {

// What a FreeSurfer surface says besides its mesh, as comments, so that other formats keep it.
inline constexpr std::string_view freesurfer_created = "freesurfer created ";
inline constexpr std::string_view freesurfer_real_ras = "freesurfer real_ras ";
inline constexpr std::string_view freesurfer_geometry = "freesurfer geometry ";

/// Whether it says where in which volume the surface lies.
inline bool is_of_volume(std::string_view comment) {
  return comment.starts_with(freesurfer_geometry) || comment.starts_with(freesurfer_real_ras);
}

/// Tags of the footer, and how many lines the volume geometry has.
inline constexpr int freesurfer_ras_tag = 2, freesurfer_geometry_tag = 20;
inline constexpr int freesurfer_geometry_lines = 8;

}  // namespace sphparam
