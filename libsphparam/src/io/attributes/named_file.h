#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A file that a text names, below a folder.
struct NamedFile {
  std::filesystem::path path;  // below the folder; there or not
  std::string taken = {};      // "'a.jpg' is 'A.JPG'", where the name on the disk differs in case
  std::string problem = {};    // why it is not there, where a file that is there was meant
};

/// The file that a text of a mesh or of a material library means, below `folder` / `inside`, where
/// it names files from. Backslashes are slashes; names that lead elsewhere (absolute, Windows
/// drives, `..`) are looked for there by their last part; quotes about the whole name are none of
/// it where no file is called so. Of a name that no file has, what the disk has in other case is
/// taken for it if it is one; other files that may be meant (several, or one of another extension)
/// are named, and so is the place of one that leads elsewhere. Files are not opened. Never throws
/// for what is on the disk.
NamedFile file_below(const std::filesystem::path& folder, const std::filesystem::path& inside,
                     const std::string& text);

/// Of a link the folder of the file that it leads to, where that is another one: what the file
/// names is beside the link, or else there.
std::optional<std::filesystem::path> folder_behind(const std::filesystem::path& path);

/// Tells in one note of the names that were taken so; of none nothing.
void note_taken_names(MeshFile& file, const std::vector<std::string>& taken);

}  // namespace sphparam
