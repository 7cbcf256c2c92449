#include "arguments/naming.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "console/exit_codes.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

/// Whose vertices they are: those of the template that --grid like: names, or of a grid of ours.
void take_grid(BrainName& name, const std::string& grid) {
  constexpr std::string_view like = "like:";
  if (grid.starts_with(like)) {
    const BrainName other = parse_brain_name(grid.substr(like.size()));
    name.space = other.space.empty() ? other.subject : other.space;
    name.density = other.density;
    if (name.hemisphere == 0) name.hemisphere = other.hemisphere;
    return;
  }
  name.density.clear();
  name.space = grid;
  std::erase_if(name.space, [](unsigned char c) { return std::isalnum(c) == 0; });
}

}  // namespace

void declare_naming(Declaration& command, Naming& naming, const std::string& option) {
  command
      .choice("--names", naming.pattern,
              {{"hcp", NamePattern::Hcp},
               {"bids", NamePattern::Bids},
               {"freesurfer", NamePattern::FreeSurfer}},
              option + " is a folder, and files in it are named as the HCP, BIDS or FreeSurfer do")
      .text("--subject", naming.subject, "NAME", "With --names: whose surface it is");
}

std::string named_surface(const Naming& naming, const std::string& folder,
                          const std::string& option, const std::string& mesh,
                          const std::string& sphere, const std::string& what,
                          const std::string& grid) {
  std::error_code hidden;
  if (!std::filesystem::is_directory(folder, hidden))
    throw UsageMistake("--names: " + option + " names a folder that is there, not " + folder);
  BrainName name = parse_brain_name(mesh);
  if (!what.empty()) name.what = what;
  if (name.hemisphere == 0) name.hemisphere = parse_brain_name(sphere).hemisphere;
  if (!naming.subject.empty()) name.subject = naming.subject;
  if (!grid.empty()) take_grid(name, grid);
  if (name.hemisphere == 0)
    throw UsageMistake("--names: " + display_name(mesh) +
                       " does not say which hemisphere it is, as lh.white, S.L.white.surf.gii and "
                       "hemi-L_white.surf.gii do");
  const bool has_space = !name.space.empty() || *naming.pattern != NamePattern::Hcp;
  if (!has_space) name.space = "native";
  return (std::filesystem::path(folder) / surface_name(name, *naming.pattern)).string();
}

}  // namespace sphparam::cli
