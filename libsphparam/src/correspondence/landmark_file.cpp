#include "sphparam/correspondence/landmark_file.h"

#include <stdexcept>
#include <unordered_map>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "io/files/vertex_number.h"

namespace sphparam {
namespace {

constexpr char line_is[] =
    "a vertex of the first mesh and one of the second, by their numbers in the files, from 0, as "
    "in `512 90`; coordinates are not taken";

/// The vertices of one side, and the lines they are in.
class Side {
 public:
  Side(std::string which, const FileNumbers& numbers)
      : which_(std::move(which)), numbers_(numbers) {}

  /// Throws: std::invalid_argument that says why it is none.
  Vertex vertex(long number, long line) {
    const Vertex vertex = numbers_.vertex(number);
    if (vertex < 0) throw std::invalid_argument(which_ + " mesh: " + numbers_.absence(number));
    const auto [earlier, is_new] = lines_.emplace(vertex, line);
    if (is_new) return vertex;
    throw std::invalid_argument("vertex " + std::to_string(number) + " of the " + which_ +
                                " mesh is in two pairs, first in line " +
                                std::to_string(earlier->second));
  }

 private:
  std::string which_;
  const FileNumbers& numbers_;
  std::unordered_map<Vertex, long> lines_;
};

}  // namespace

LandmarkFile::LandmarkFile(const std::string& path) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  parse(bytes.view(), bytes.name());
}

LandmarkFile::LandmarkFile(std::string_view text, const std::string& name) { parse(text, name); }

void LandmarkFile::parse(std::string_view text, const std::string& name) {
  name_ = name;
  const ReadOptions limits;
  TextScanner scanner(text, name, limits);
  scanner.require_text();
  while (scanner.next_filled_line()) {
    const long first = vertex_number(scanner, line_is), second = vertex_number(scanner, line_is);
    if (!scanner.at_line_end())
      scanner.fail("expected a vertex of the first mesh and one of the second, then nothing");
    lines_.push_back({first, second, scanner.line_number()});
  }
  if (lines_.empty()) {
    throw ReadError(name,
                    "there is no pair in it: a line is a vertex of the first mesh and one of the "
                    "second");
  }
}

std::vector<LandmarkPair> LandmarkFile::pairs(const FileNumbers& from,
                                              const FileNumbers& to) const {
  Side first("first", from), second("second", to);
  std::vector<LandmarkPair> pairs;
  for (const Line& line : lines_) {
    try {
      pairs.push_back(
          {first.vertex(line.first, line.number), second.vertex(line.second, line.number)});
    } catch (const std::invalid_argument& error) {
      throw ReadError::at_line(name_, line.number, error.what());
    }
  }
  return pairs;
}

}  // namespace sphparam
