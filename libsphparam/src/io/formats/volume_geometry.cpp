#include "io/formats/volume_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "io/formats/freesurfer_comments.h"
#include "parsed_number.h"

namespace sphparam {
namespace {

constexpr std::string_view name_key = "VolGeomFname";

/// A line of the footer, as FreeSurfer sets it, and what its three numbers are called in GIFTI.
struct Line {
  std::string_view footer;
  std::array<std::string_view, 3> gifti;
};
constexpr std::array<Line, 6> lines = {
    {{"volume = ", {"VolGeomWidth", "VolGeomHeight", "VolGeomDepth"}},
     {"voxelsize = ", {"VolGeomXsize", "VolGeomYsize", "VolGeomZsize"}},
     {"xras   = ", {"VolGeomX_R", "VolGeomX_A", "VolGeomX_S"}},
     {"yras   = ", {"VolGeomY_R", "VolGeomY_A", "VolGeomY_S"}},
     {"zras   = ", {"VolGeomZ_R", "VolGeomZ_A", "VolGeomZ_S"}},
     {"cras   = ", {"VolGeomC_R", "VolGeomC_A", "VolGeomC_S"}}}};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  const std::size_t last = text.find_last_not_of(" \t");
  return last == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

std::string_view key_of(std::string_view line) {
  return trimmed(line.substr(0, std::min(line.find('='), line.size())));
}

/// What stands after the sign in the line of this key.
std::optional<std::string> footer_value(const std::vector<std::string>& comments,
                                        std::string_view key) {
  for (std::string_view comment : comments) {
    if (!comment.starts_with(freesurfer_geometry)) continue;
    comment.remove_prefix(freesurfer_geometry.size());
    const std::size_t sign = comment.find('=');
    if (sign != std::string_view::npos && key_of(comment) == key)
      return std::string(trimmed(comment.substr(sign + 1)));
  }
  return std::nullopt;
}

bool is_number(std::string_view word) {
  const std::optional<double> value = parsed<double>(word.substr(word.starts_with('+')));
  return value && std::isfinite(*value);
}

/// Three numbers, as they are written; none where the text has something else.
std::vector<std::string> numbers_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  const bool are_three = words.size() == 3 && std::ranges::all_of(words, is_number);
  return are_three ? words : std::vector<std::string>{};
}

std::string value_of(const Metadata& metadata, std::string_view key) {
  for (const auto& [name, value] : metadata)
    if (name == key) return one_line(value);
  return {};
}

}  // namespace

Metadata gifti_geometry(const std::vector<std::string>& comments) {
  if (!footer_value(comments, "valid").value_or("").starts_with("1")) return {};
  Metadata metadata;
  for (const Line& line : lines) {
    const auto numbers = numbers_in(footer_value(comments, key_of(line.footer)).value_or(""));
    if (numbers.empty()) return {};
    for (std::size_t k = 0; k < 3; ++k) metadata.emplace_back(line.gifti[k], numbers[k]);
  }
  metadata.emplace_back(name_key, footer_value(comments, "filename").value_or("unknown"));
  return metadata;
}

std::vector<std::string> freesurfer_geometry_of(const Metadata& metadata) {
  const std::string prefix(freesurfer_geometry);
  const std::string name = value_of(metadata, name_key);
  std::vector<std::string> comments = {prefix + "valid = 1  # volume info valid",
                                       prefix + "filename = " + (name.empty() ? "unknown" : name)};
  for (const Line& line : lines) {
    std::string numbers;
    for (const std::string_view key : line.gifti)
      numbers += (numbers.empty() ? "" : " ") + std::string(trimmed(value_of(metadata, key)));
    if (numbers_in(numbers).empty()) return {};
    comments.push_back(prefix + std::string(line.footer) + numbers);
  }
  return comments;
}

bool is_gifti_geometry(const std::string& key) {
  return key == name_key || std::ranges::any_of(lines, [&](const Line& line) {
           return std::ranges::find(line.gifti, key) != line.gifti.end();
         });
}

}  // namespace sphparam
