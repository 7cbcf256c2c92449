#include "sphparam/group/template_landmarks.h"

#include <map>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "io/files/vertex_number.h"

namespace sphparam {
namespace {

TemplateLandmark landmark_in(TextScanner& scanner, const FileNumbers& numbers) {
  const long number = vertex_number(
      scanner,
      "a vertex of the template, by its number in the file, from 0, and a name if you like, as in "
      "`512 nose`; coordinates are not taken");
  const Vertex vertex = numbers.vertex(number);
  if (vertex < 0) scanner.fail(numbers.absence(number));
  std::string name;
  while (!scanner.at_line_end()) {
    if (!name.empty()) name += ' ';
    name += scanner.word();
  }
  return {name.empty() ? std::to_string(number) : name, vertex};
}

}  // namespace

std::vector<TemplateLandmark> parse_template_landmarks(std::string_view text,
                                                       const std::string& name,
                                                       const FileNumbers& numbers) {
  const ReadOptions limits;
  TextScanner scanner(text, name, limits);
  scanner.require_text();
  std::vector<TemplateLandmark> landmarks;
  std::map<std::string, long> lines;
  while (scanner.next_filled_line()) {
    landmarks.push_back(landmark_in(scanner, numbers));
    const auto [earlier, is_new] = lines.emplace(landmarks.back().name, scanner.line_number());
    if (!is_new) {
      scanner.fail("a second landmark " + quoted(landmarks.back().name) +
                   ", the first is in line " + std::to_string(earlier->second));
    }
  }
  if (landmarks.empty())
    throw ReadError(name, "there is no landmark in it: a line is a vertex and, perhaps, a name");
  return landmarks;
}

std::vector<TemplateLandmark> read_template_landmarks(const std::string& path,
                                                      const FileNumbers& numbers) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_template_landmarks(bytes.view(), bytes.name(), numbers);
}

}  // namespace sphparam
