#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// What exporters name where faces have no material, after faces that have one: a statement that
/// takes the last one back does not exist.
inline constexpr char obj_no_material[] = "(null)";

/// What the libraries (.mtl) of an OBJ file say of its materials.
struct ObjMaterials {
  std::vector<MaterialTexture> base_colours;   // one a name, or none where no library could be read
  std::vector<MaterialChannels> channels;      // likewise
  std::vector<std::array<double, 3>> diffuse;  // Kd, likewise, beside an image too
  std::vector<std::string> others;             // what is said and not carried, in words, each once
  long with_others = 0;                        // materials that say such things
  std::vector<std::string> unknown;            // names that no library has
  std::vector<std::string> problems;           // libraries that could not be read, and why
  std::vector<std::string> taken;  // "'a.jpg' is 'A.JPG'": files of a name in other case
};

/// Reads them in their order from below `folder`: of Kd, d, Tr and map_Kd the base colour, of Ke
/// and map_Ke the emission, of Pr, Pm and their maps roughness and metallic, of norm the normal
/// map. Where there is an image, Kd and a black Ke are not multiplied with it: exporters write a
/// grey there that nobody sees, and no Ke beside map_Ke; a Kd with a hue there is told. Kd and Ke
/// are linear light. Below d 1 alpha blends. Without Pr and Pm surfaces are rough and no metal.
/// Keywords may be in any case. Images are looked for beside the library, as `file_below` does, and
/// not opened. Materials that no library has are white. Never throws for what
/// the libraries hold: the mesh is there without them.
ObjMaterials read_obj_materials(const std::vector<std::string>& names,
                                const std::vector<std::string>& libraries,
                                const std::filesystem::path& folder, const ReadOptions& options);

/// Those of the libraries that are there, read or not.
std::vector<std::string> library_files(const std::vector<std::string>& libraries,
                                       const std::filesystem::path& folder);

/// The images that their materials name, below the folder, there or not.
std::vector<std::string> library_images(const std::vector<std::string>& libraries,
                                        const std::filesystem::path& folder,
                                        const ReadOptions& options);

}  // namespace sphparam
