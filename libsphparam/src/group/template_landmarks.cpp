#include "sphparam/group/template_landmarks.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "io/files/vertex_number.h"
#include "parsed_number.h"
#include "sphparam/io/file_numbers.h"

namespace sphparam {
namespace {

/// Three numbers, of which vertices have none but whole ones.
bool is_point(const std::vector<std::string_view>& words) {
  const auto is_number = [](std::string_view word) { return parsed<double>(word).has_value(); };
  return words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, is_number) &&
         !std::all_of(words.begin(), words.begin() + 3, is_whole_number);
}

VertexPlace place_in(TextScanner& scanner) {
  if (is_point(words_ahead(scanner))) return {.point = point_in(scanner)};
  return {.number = vertex_number(
              scanner,
              "a vertex of the template, by its number in the file, from 0, and a name if you "
              "like, as in `512 nose`, or a point, as in `0.5 1 2 nose`")};
}

/// Throws: ReadError.
FoundVertex found_at(const VertexPlace& place, const VertexPlaces& places,
                     const TextScanner& scanner) {
  try {
    return places.at(place);
  } catch (const std::invalid_argument& error) {
    scanner.fail(error.what());
  }
}

TemplateLandmark landmark_in(TextScanner& scanner, const VertexPlaces& places,
                             const FileNumbers& numbers, SnappedPoints& snapped) {
  const FoundVertex found = found_at(place_in(scanner), places, scanner);
  snapped.add(found, "line " + std::to_string(scanner.line_number()));
  std::string name;
  while (!scanner.at_line_end()) {
    if (!name.empty()) name += ' ';
    name += scanner.word();
  }
  if (name.empty()) name = std::to_string(numbers.number(found.vertex));
  return {name, found.vertex, found.distance};
}

}  // namespace

TemplateLandmarks parse_template_landmarks(std::string_view text, const std::string& name,
                                           const MeshFile& file) {
  const FileNumbers numbers(file);
  const VertexPlaces places(file);
  const ReadOptions limits;
  TextScanner scanner(text, name, limits);
  scanner.require_text();
  TemplateLandmarks found;
  std::vector<TemplateLandmark>& landmarks = found.landmarks;
  std::map<std::string, long> lines;
  while (scanner.next_filled_line()) {
    landmarks.push_back(landmark_in(scanner, places, numbers, found.snapped));
    const auto [earlier, is_new] = lines.emplace(landmarks.back().name, scanner.line_number());
    if (!is_new) {
      scanner.fail("a second landmark " + quoted(landmarks.back().name) +
                   ", the first is in line " + std::to_string(earlier->second));
    }
  }
  if (landmarks.empty())
    throw ReadError(name, "there is no landmark in it: a line is a vertex and, perhaps, a name");
  return found;
}

TemplateLandmarks read_template_landmarks(const std::string& path, const MeshFile& file) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_template_landmarks(bytes.view(), bytes.name(), file);
}

}  // namespace sphparam
