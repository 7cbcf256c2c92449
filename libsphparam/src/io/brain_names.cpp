#include "sphparam/io/brain_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <vector>

#include "sphparam/io/paths.h"

// A name is taken apart by what marks its pattern: hemi-L, lh. or .L. in it.

namespace sphparam {
namespace {

constexpr std::array<std::string_view, 8> kinds = {".surf", ".shape",   ".func",   ".label",
                                                   ".sph",  ".dscalar", ".dlabel", ".dtseries"};
constexpr std::array<std::string_view, 14> endings = {".gii",  ".annot", ".label", ".mgh", ".mgz",
                                                      ".curv", ".ply",   ".obj",   ".off", ".vtk",
                                                      ".vtp",  ".mz3",   ".glb",   ".stl"};

template <class Words>
bool take_ending(std::string& name, const Words& words) {
  for (const std::string_view word : words) {
    if (!name.ends_with(word)) continue;
    const std::string rest = name.substr(0, name.size() - word.size());
    if (rest.empty() || rest == "lh" || rest == "rh") continue;  // lh.curv is a whole name
    name = rest;
    return true;
  }
  return false;
}

std::string without_endings(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  take_ending(name, std::array<std::string_view, 1>{".gz"});
  if (take_ending(name, endings)) take_ending(name, kinds);
  return name;
}

std::vector<std::string> pieces(const std::string& text, char between) {
  std::vector<std::string> all(1);
  for (const char c : text) {
    if (c == between)
      all.emplace_back();
    else
      all.back() += c;
  }
  return all;
}

/// BIDS has no underscores within a value.
std::string hcp_space(const std::string& space) { return space == "fsLR" ? "fs_LR" : space; }

struct BrainSession {
  std::string subject, session;
};

std::string alphanumeric(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isalnum(c) == 0; });
  return text;
}

bool is_bids(const std::string& stem) {
  return stem.starts_with("hemi-") || stem.find("_hemi-") != std::string::npos;
}

bool is_freesurfer(const std::string& stem) {
  return stem.size() > 3 && (stem.starts_with("lh.") || stem.starts_with("rh."));
}

BrainName parse_bids(const std::string& stem) {
  BrainName name;
  std::string description, session;
  for (const std::string& piece : pieces(stem, '_')) {
    const std::size_t dash = piece.find('-');
    const std::string key = piece.substr(0, dash);
    const std::string value = dash == std::string::npos ? "" : piece.substr(dash + 1);
    if (dash == std::string::npos) name.what = piece;
    if (key == "sub") name.subject = value;
    if (key == "ses") session = value;
    if (key == "hemi" && !value.empty()) name.hemisphere = value.front();
    if (key == "space" || (key == "tpl" && name.space.empty())) name.space = hcp_space(value);
    if (key == "den") name.density = value;
    if (key == "desc") description = value;
  }
  if (!session.empty())
    name.subject = (name.subject.empty() ? "" : "sub-" + name.subject + "_") + "ses-" + session;
  const bool says_little = name.what == "dseg" || name.what == "probseg" || name.what.empty();
  if (says_little && !description.empty()) name.what = description;
  return name;
}

BrainName parse_freesurfer(const std::string& stem, const std::string& path) {
  BrainName name{.hemisphere = stem[0] == 'l' ? 'L' : 'R', .what = stem.substr(3)};
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.filename() == "surf" || folder.filename() == "label")
    name.subject = folder.parent_path().filename().string();
  return name;
}

/// "32k_fs_LR", "native", "164k_fsaverage": density and space.
void take_space(BrainName& name, const std::string& text) {
  const std::size_t line = text.find('_');
  const bool has_density = line != std::string::npos && text[line - (line > 0)] == 'k' &&
                           std::isdigit(static_cast<unsigned char>(text[0])) != 0;
  name.density = has_density ? text.substr(0, line) : "";
  name.space = has_density ? text.substr(line + 1) : text;
}

BrainName parse_hcp(const std::string& stem, std::size_t at) {
  BrainName name{.subject = at == 0 ? "" : stem.substr(0, at - 1), .hemisphere = stem[at]};
  const std::string rest = stem.substr(at + 2);
  const std::size_t last = rest.rfind('.');
  name.what = rest.substr(0, last);
  if (last != std::string::npos) take_space(name, rest.substr(last + 1));
  return name;
}

/// Where the L or R of the HCP's names stands.
std::size_t side_of_hcp(const std::string& stem) {
  for (const char* side : {"L.", "R."}) {
    if (stem.starts_with(side)) return 0;
    const std::size_t at = stem.find(std::string(".") + side);
    if (at != std::string::npos) return at + 1;
  }
  return std::string::npos;
}

std::string hcp_stem(const BrainName& name) {
  std::string stem = name.subject.empty() ? "" : name.subject + ".";
  if (name.hemisphere != 0) stem += std::string(1, name.hemisphere) + ".";
  stem += name.what;
  if (!name.density.empty() && !name.space.empty())
    return stem + "." + name.density + "_" + name.space;
  return stem + (name.space.empty() ? "" : "." + name.space);
}

/// Folders of FreeSurfer subjects may be named so: "sub-07", "sub-07_ses-1"; "ses-1" is of nobody.
BrainSession session_of(std::string subject) {
  constexpr std::string_view sub = "sub-", ses = "_ses-", alone = "ses-";
  if (subject.starts_with(alone)) return {"", subject.substr(alone.size())};
  if (!subject.starts_with(sub)) return {std::move(subject), ""};
  subject.erase(0, sub.size());
  const std::size_t at = subject.find(ses);
  if (at == std::string::npos) return {std::move(subject), ""};
  return {subject.substr(0, at), subject.substr(at + ses.size())};
}

std::string bids_stem(const BrainName& name, const std::string& suffix) {
  const auto entity = [](const char* key, const std::string& value) {
    const std::string text = alphanumeric(value);
    return text.empty() ? "" : std::string(key) + "-" + text + "_";
  };
  const auto [subject, session] = session_of(name.subject);
  return entity("sub", subject) + entity("ses", session) +
         entity("hemi", std::string(name.hemisphere != 0, name.hemisphere)) +
         entity("space", name.space) + entity("den", name.density) + suffix;
}

std::string freesurfer_stem(const BrainName& name) {
  const char* const side = name.hemisphere == 'L' ? "lh." : name.hemisphere == 'R' ? "rh." : "";
  return side + name.what;
}

std::string kind_of(const VertexData& data) {
  switch (data.kind) {
    case DataKind::Labels:
      return ".label.gii";
    case DataKind::TimeSeries:
      return ".func.gii";
    default:
      return ".shape.gii";
  }
}

std::string freesurfer_data_name(const BrainName& name, const VertexData& data) {
  const std::string stem = freesurfer_stem(name);
  if (data.kind == DataKind::Labels)
    return stem + (data.columns.size() == 1 ? ".annot" : ".label.gii");
  return stem + (data.columns.size() == 1 ? "" : ".mgh");
}

/// Whether it is one of these words, or one with something added: "white_MSMAll".
bool says(const std::string& what, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) {
    if (!what.starts_with(word)) return false;
    return what.size() == word.size() ||
           !std::isalnum(static_cast<unsigned char>(what[word.size()]));
  });
}

}  // namespace

BrainName parse_brain_name(const std::string& path) {
  const std::string stem = without_endings(path);
  if (is_bids(stem)) return parse_bids(stem);
  if (is_freesurfer(stem)) return parse_freesurfer(stem, path);
  const std::size_t side = side_of_hcp(stem);
  if (side != std::string::npos) return parse_hcp(stem, side);
  return {.what = stem};
}

std::string surface_name(const BrainName& name, NamePattern pattern) {
  switch (pattern) {
    case NamePattern::Hcp:
      return hcp_stem(name) + ".surf.gii";
    case NamePattern::Bids:
      return bids_stem(name, alphanumeric(name.what)) + ".surf.gii";
    default:
      return freesurfer_stem(name);
  }
}

std::string data_name(const BrainName& name, const VertexData& data, NamePattern pattern) {
  if (pattern == NamePattern::FreeSurfer) return freesurfer_data_name(name, data);
  if (pattern == NamePattern::Hcp) return hcp_stem(name) + kind_of(data);
  const std::string what = alphanumeric(name.what);
  const std::string suffix = data.kind == DataKind::Labels ? "desc-" + what + "_dseg" : what;
  return bids_stem(name, suffix) + kind_of(data);
}

std::string data_path(const std::string& surface, const VertexData& data) {
  BrainName name = parse_brain_name(surface);
  const std::string stem = without_endings(surface);
  const bool is_gifti = inner_extension_of(surface) == ".gii";
  name.what = data.name;
  std::string file;
  if (is_freesurfer(stem)) {
    file = is_gifti ? freesurfer_stem(name) + kind_of(data) : freesurfer_data_name(name, data);
  } else if (name.hemisphere != 0) {
    file = data_name(name, data, is_bids(stem) ? NamePattern::Bids : NamePattern::Hcp);
  } else if (is_gifti) {
    file = stem + "." + data.name + kind_of(data);
  } else {
    file = freesurfer_data_name({.what = stem + "." + data.name}, data);
    if (!is_written_data(file)) file += ".curv";
  }
  return std::filesystem::path(surface).replace_filename(file).string();
}

std::string structure_of_name(const std::string& path) {
  switch (parse_brain_name(path).hemisphere) {
    case 'L':
      return "CortexLeft";
    case 'R':
      return "CortexRight";
    default:
      return "";
  }
}

SurfaceWords surface_words_of_name(const std::string& path) {
  const std::string what = parse_brain_name(path).what;
  if (says(what, {"sphere"})) return {"Spherical", ""};
  if (says(what, {"very_inflated", "veryinflated"})) return {"VeryInflated", ""};
  if (says(what, {"inflated"})) return {"Inflated", ""};
  if (says(what, {"midthickness", "graymid"})) return {"Anatomical", "MidThickness"};
  if (says(what, {"pial"})) return {"Anatomical", "Pial"};
  if (says(what, {"white", "smoothwm", "orig", "wm"})) return {"Anatomical", "GrayWhite"};
  return {};
}

}  // namespace sphparam
