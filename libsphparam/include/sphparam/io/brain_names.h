#pragma once

#include <string>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// How neuroimaging names files of surfaces: the Human Connectome Project
/// (100307.L.sphere.32k_fs_LR.surf.gii), BIDS and TemplateFlow
/// (sub-01_hemi-L_space-fsLR_den-32k_sphere.surf.gii), FreeSurfer (lh.sphere).
enum class NamePattern { Hcp, Bids, FreeSurfer };

/// What the name of a file says.
struct BrainName {
  std::string subject = {};  // "100307"; empty: nothing is said, and so below
  char hemisphere = 0;       // 'L' or 'R'
  std::string what = {};     // "sphere", "midthickness", "thickness", "aparc"
  std::string space = {};    // "fs_LR", "fsaverage", "native"; as HCP calls it
  std::string density = {};  // "32k"
};

/// Reads a name of any of these patterns; of other names, `what` is the name without its endings.
/// Of FreeSurfer's, the subject is the folder that "surf" or "label" lies in.
BrainName parse_brain_name(const std::string& path);

/// The name that a surface gets, without a folder. FreeSurfer's has no place for the subject and
/// the space; a name without a hemisphere is left without one.
std::string surface_name(const BrainName& name, NamePattern pattern);

/// The name that data gets. FreeSurfer's formats: .annot for labels of one column, curv for one
/// column of a metric, .mgh for several; labels of several are .label.gii there too.
std::string data_name(const BrainName& name, const VertexData& data, NamePattern pattern);

/// Where data lies beside a surface: in its folder, named as it is, with the name of the data for
/// what the surface is: S.L.thickness.native.shape.gii beside S.L.white.native.surf.gii,
/// lh.thickness beside lh.white; other names get it added, "x.thickness.shape.gii" beside
/// x.surf.gii. In the family of formats that the surface's name asks for.
std::string data_path(const std::string& surface, const VertexData& data);

/// "CortexLeft", "CortexRight"; empty where the name does not say.
std::string structure_of_name(const std::string& path);

/// The two words that a surface file has for what it is: "Anatomical" and "GrayWhite" of a name
/// with "white", "Inflated" and nothing of "inflated"; empty where the name does not say.
struct SurfaceWords {
  std::string geometric_type, secondary_structure;
};
SurfaceWords surface_words_of_name(const std::string& path);

}  // namespace sphparam
