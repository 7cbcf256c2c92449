#include "arguments/naming.h"

#include <cctype>
#include <filesystem>

#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

constexpr std::string_view like = "like:";

std::string alphanumeric(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isalnum(c) == 0; });
  return text;
}

/// The space of another mesh's vertices. "native" is each one's own, so where nothing else is said
/// they are called after whose they are, or after their file.
std::string space_of(const BrainName& other, const std::string& subject) {
  const bool is_own = !other.subject.empty() && other.subject == subject;
  if (is_own || !(other.space.empty() || other.space == "native")) return other.space;
  return alphanumeric(other.subject.empty() ? other.what : other.subject);
}

/// Whose vertices they are: those of the template that --grid like: names, or of a grid of ours.
void take_grid(BrainName& name, const std::string& grid) {
  if (grid.starts_with(like)) {
    const BrainName other = parse_brain_name(grid.substr(like.size()));
    name.space = space_of(other, name.subject);
    name.density = other.density;
    if (name.hemisphere == 0) name.hemisphere = other.hemisphere;
    return;
  }
  name.density.clear();
  name.space = alphanumeric(grid);
}

/// Whether the new mesh has the vertices of the old one.
bool keeps_vertices(const std::string& grid, const std::string& mesh, const std::string& sphere) {
  if (!grid.starts_with(like)) return grid.empty();
  const std::string other = grid.substr(like.size());
  return is_same_place(other, mesh) || (!sphere.empty() && is_same_place(other, sphere));
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
  if (!keeps_vertices(grid, mesh, sphere)) take_grid(name, grid);
  if (name.hemisphere == 0)
    throw UsageMistake("--names: " + display_name(mesh) +
                       " does not say which hemisphere it is, as lh.white, S.L.white.surf.gii and "
                       "hemi-L_white.surf.gii do");
  const bool has_space = !name.space.empty() || *naming.pattern != NamePattern::Hcp;
  if (!has_space) name.space = "native";
  return (std::filesystem::path(folder) / surface_name(name, *naming.pattern)).string();
}

}  // namespace sphparam::cli
