#include "io/formats/obj/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "io/attributes/named_file.h"
#include "io/files/text_scanner.h"
#include "io/formats/gltf/gltf_files.h"
#include "lower_case.h"
#include "number_text.h"
#include "parsed_number.h"

// Libraries are text from strangers, and written by hand more often than the rest: a line that
// makes no sense is passed over, and what a name means is decided as other readers do.

namespace sphparam {
namespace {

namespace fs = std::filesystem;

struct Material {
  MaterialTexture colour = {};
  std::array<double, 3> diffuse = {1, 1, 1};
  MaterialChannels channels = {.metallic = {.factor = {0, 1, 1, 1}}};
  std::set<std::string> others = {};
};

/// A finite one.
std::optional<double> number(std::string_view word) {
  const std::optional<double> value = parsed<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Words that follow an option of an image; scales, offsets and turbulence have one to three
/// numbers.
int words_after(std::string_view option) {
  if (option == "-o" || option == "-s" || option == "-t") return 3;
  return option == "-mm" ? 2 : 1;
}

/// Files that were taken though their names differ in case, in words.
using TakenNames = std::set<std::string>;

class Library {
 public:
  Library(std::string_view text, const std::string& name, const fs::path& folder,
          const fs::path& images, const ReadOptions& options,
          std::map<std::string, Material>& known, TakenNames& taken)
      : scanner_(text, name, options),
        folder_(folder),
        images_(images),
        known_(known),
        taken_(taken) {
    scanner_.require_text();
  }

  void read() {
    while (scanner_.next_line())
      if (!scanner_.at_line_end()) read_line(in_lower_case(scanner_.word()));
  }

 private:
  void read_line(const std::string& keyword) {
    if (keyword == "newmtl") {
      material_ = &known_[one_line(scanner_.rest())];
      *material_ = {};
    } else if (material_ != nullptr) {
      read_statement(keyword);
    }
  }

  void read_statement(const std::string& keyword) {
    MaterialChannels& channels = material_->channels;
    if (keyword == "kd") return set_colour(material_->diffuse, 1);
    if (keyword == "ke") return set_emission();
    if (keyword == "d" || keyword == "tr") return set_alpha(keyword == "tr");
    if (keyword == "pr") return set_number(channels.roughness.factor[0]);
    if (keyword == "pm") return set_number(channels.metallic.factor[0]);
    if (keyword == "map_kd") return set_image(material_->colour);
    if (keyword == "map_ke") return set_image(channels.emission);
    if (keyword == "map_pr") return set_image(channels.roughness);
    if (keyword == "map_pm") return set_image(channels.metallic);
    if (keyword == "norm" || keyword == "map_kn") return set_normals();
    if (keyword == "bump" || keyword == "map_bump") return set_bump();
    if (keyword == "map_d") return set_image(channels.opacity);
    if (keyword == "pc") return set_number(channels.finish.clearcoat);
    if (keyword == "pcr") return set_number(channels.finish.clearcoat_roughness);
    if (keyword == "ps") return set_sheen();
    static constexpr std::pair<std::string_view, const char*> said_beside[] = {
        {"ks", "highlights"},
        {"map_ks", "highlights"},
        {"map_ns", "highlights"},
        {"disp", "displacement"},
        {"map_disp", "displacement"},
        {"map_ps", "textures of sheen"},
        {"map_pc", "textures of clear coat"},
        {"map_pcr", "textures of clear coat"},
        {"aniso", "anisotropy"},
        {"map_ka", "ambient textures"}};
    for (const auto& [word, what] : said_beside)
      if (keyword == word && !is_black()) material_->others.insert(what);
  }

  /// Numbers that are all zero say nothing.
  bool is_black() {
    const std::string rest(scanner_.peek_rest());
    return rest.find_first_not_of(" \t\r0.") == std::string::npos;
  }

  template <std::size_t Size>
  void set_colour(std::array<double, Size>& colour, double most) {
    std::array<double, 3> numbers{};
    for (double& channel : numbers) {
      const std::optional<double> written = number(scanner_.word());
      if (!written) return;  // spectral, xyz
      channel = std::clamp(*written, 0.0, most);
    }
    std::ranges::copy(numbers, colour.begin());
  }

  /// A lamp may be brighter than white.
  void set_emission() {
    constexpr double brightest = 1e6;
    set_colour(material_->channels.emission.factor, brightest);
  }

  void set_number(double& value) {
    if (const std::optional<double> written = number(scanner_.word()))
      value = std::clamp(*written, 0.0, 1.0);
  }

  void set_alpha(bool transparency) {
    const std::optional<double> written = number(scanner_.word());
    if (!written) return;  // -halo
    // Nobody writes down what nobody would see: MeshLab's Tr is an opacity, and mostly 1.
    if (transparency && *written >= 1) return;
    const double alpha = std::clamp(*written, 0.0, 1.0);
    material_->colour.factor[3] = transparency ? 1 - alpha : alpha;
    const bool opaque = material_->colour.factor[3] == 1;
    material_->channels.alpha_mode = opaque ? AlphaMode::Opaque : AlphaMode::Blend;
  }

  /// A normal map that is called so wins over one of bumps, whichever stands first.
  void set_normals() {
    MaterialTexture& normal = material_->channels.normal;
    normal = {};
    set_image(normal);
  }

  /// Heights; many write normal maps there.
  void set_bump() {
    MaterialTexture bump{.bump = 1};
    set_image(bump);
    MaterialTexture& normal = material_->channels.normal;
    if (bump.image.empty() || bump.bump == 0) return;
    if (normal.image.empty() || normal.bump != 0) normal = bump;
  }

  void set_sheen() {
    double grey = 0;
    set_number(grey);
    material_->channels.finish.sheen.fill(grey);
  }

  void set_image(MaterialTexture& colour) {
    while (scanner_.peek_word().starts_with("-")) read_option(colour);
    const std::string written = one_line(scanner_.rest());
    if (written.empty()) return;
    const NamedFile file = file_below(folder_, images_, written);
    colour.image = file.path.string();
    colour.path = (images_ / file.path).string();
    colour.folder = folder_.string();
    if (!file.problem.empty()) colour.problem = file.problem;
    if (!file.taken.empty()) taken_.insert(file.taken);
  }

  /// -s is how often the image is there along s and t, -o is added.
  void read_option(MaterialTexture& colour) {
    const std::string option(scanner_.word());
    for (int i = 0; i < words_after(option); ++i) {
      const std::string word(scanner_.peek_word());
      const std::optional<double> written = number(word);
      if (words_after(option) == 3 && !written) break;
      scanner_.word();
      const auto axis = static_cast<std::size_t>(i);
      const bool moves = (option == "-o" || option == "-s") && i < 2;
      if (moves && std::abs(*written) > farthest)
        colour.problem = "its texture coordinates are moved beyond what can be looked up";
      else if (moves)
        colour.placement[axis][option == "-s" ? axis : 2] = *written;
      if (option == "-bm" && written && colour.bump != 0) colour.bump = *written;
      if (option == "-clamp" && word == "on") colour.wrap_s = colour.wrap_t = Wrapping::Clamp;
    }
  }

  static constexpr double farthest = 1e6;

  TextScanner scanner_;
  const fs::path &folder_, &images_;
  std::map<std::string, Material>& known_;
  TakenNames& taken_;
  Material* material_ = nullptr;
};

/// A statement may name several libraries; and a name may have blanks in it.
std::vector<std::string> names_in(const std::string& statement) {
  std::vector<std::string> names = {statement};
  std::size_t at = 0;
  while (statement.find(' ') != std::string::npos && at < statement.size()) {
    const std::size_t end = std::min(statement.find(' ', at), statement.size());
    if (end > at) names.push_back(statement.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

void read_library(const std::string& statement, const fs::path& folder, const ReadOptions& options,
                  std::map<std::string, Material>& known, std::vector<std::string>& problems,
                  TakenNames& taken) {
  const std::vector<std::string> names = names_in(statement);
  for (const std::string& name : names) {
    try {
      const NamedFile file = file_below(folder, {}, name);
      const auto bytes =
          read_below(folder, file.path, static_cast<std::uint64_t>(options.max_file_bytes));
      if (!file.taken.empty()) taken.insert(file.taken);
      Library({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, folder,
              file.path.parent_path(), options, known, taken)
          .read();
      if (name == statement) return;
    } catch (const std::runtime_error& error) {
      const bool may_be_several = name == statement && names.size() > 1;
      if (!may_be_several) problems.push_back(sphparam::quoted(name) + " (" + error.what() + ")");
    }
  }
}

/// Its Kd says more than the grey that exporters write beside an image.
bool tints_texture(const Material& material) {
  const auto& [red, green, blue] = material.diffuse;
  return !material.colour.image.empty() && (red != green || green != blue);
}

MaterialTexture finished(const Material& material) {
  MaterialTexture colour = material.colour;
  if (colour.image.empty()) std::ranges::copy(material.diffuse, colour.factor.begin());
  return colour;
}

/// Numbers that stand beside an image multiply it; what nobody wrote is 1 then.
MaterialChannels finished_channels(const Material& material) {
  MaterialChannels channels = material.channels;
  const auto is_black = [](const MaterialTexture& texture) {
    return std::all_of(texture.factor.begin(), texture.factor.begin() + 3,
                       [](double x) { return x == 0; });
  };
  if (!channels.emission.image.empty() && is_black(channels.emission))
    channels.emission.factor = {1, 1, 1, 1};
  // Where an image of alpha is the colours' own, their alpha is meant; else its brightness.
  if (!channels.opacity.image.empty()) {
    if (channels.alpha_mode == AlphaMode::Opaque) channels.alpha_mode = AlphaMode::Blend;
    if (channels.opacity.image == material.colour.image) channels.opacity = {};
  }
  if (channels.normal.bump != 0) channels.normal.factor = {1, 1, 1, 1};
  if (!channels.metallic.image.empty() && channels.metallic.factor[0] == 0)
    channels.metallic.factor[0] = 1;
  return channels;
}

}  // namespace

std::vector<std::string> library_files(const std::vector<std::string>& libraries,
                                       const fs::path& folder) {
  std::vector<std::string> files;
  for (const std::string& statement : libraries) {
    for (const std::string& name : names_in(statement)) {
      std::error_code hidden;
      const fs::path path = folder / file_below(folder, {}, name).path;
      if (fs::is_regular_file(path, hidden)) files.push_back(path.string());
    }
  }
  return files;
}

std::vector<std::string> library_images(const std::vector<std::string>& libraries,
                                        const fs::path& folder, const ReadOptions& options) {
  std::map<std::string, Material> known;
  std::vector<std::string> images, unused;
  TakenNames taken;
  for (const std::string& statement : libraries)
    read_library(statement, folder, options, known, unused, taken);
  const auto add = [&](const MaterialTexture& texture) {
    if (!texture.path.empty()) images.push_back(texture.path);
  };
  for (const auto& [name, material] : known) {
    add(material.colour);
    for (const MaterialTexture* const texture : material.channels.textures()) add(*texture);
  }
  return images;
}

ObjMaterials read_obj_materials(const std::vector<std::string>& names,
                                const std::vector<std::string>& libraries, const fs::path& folder,
                                const ReadOptions& options) {
  ObjMaterials result;
  TakenNames taken;
  std::map<std::string, Material> known;
  for (const std::string& statement : libraries)
    read_library(statement, folder, options, known, result.problems, taken);
  result.taken.assign(taken.begin(), taken.end());
  const auto is_known = [&](const std::string& name) { return known.contains(name); };
  if (std::ranges::none_of(names, is_known)) return result;
  std::set<std::string> others;
  for (const std::string& name : names) {
    if (!is_known(name)) result.unknown.push_back(name);
    Material& material = known[name];
    if (tints_texture(material)) material.others.insert("tints of textures (Kd beside map_Kd)");
    result.base_colours.push_back(finished(material));
    result.channels.push_back(finished_channels(material));
    result.diffuse.push_back(material.diffuse);
    result.with_others += !material.others.empty();
    others.insert(material.others.begin(), material.others.end());
  }
  result.others.assign(others.begin(), others.end());
  return result;
}

}  // namespace sphparam
