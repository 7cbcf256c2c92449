#include "sphparam/correspondence/landmark_file.h"

#include <stdexcept>
#include <unordered_map>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "io/files/vertex_number.h"
#include "sphparam/io/file_numbers.h"

namespace sphparam {
namespace {

constexpr char line_is[] =
    "a vertex of the first mesh and one of the second, by their numbers in the files, from 0, as "
    "in `512 90`, or a point of each, in six numbers";
constexpr std::size_t numbers_of_points = 6;

/// The vertices of one side, and the lines they are in.
class Side {
 public:
  Side(std::string which, const MeshFile& file)
      : which_(std::move(which)), numbers_(file), places_(file) {}

  /// Throws: std::invalid_argument that says why it is none.
  Vertex vertex(const VertexPlace& place, long line, SnappedPoints& snapped) {
    const FoundVertex found = found_at(place);
    const auto [earlier, is_new] = lines_.emplace(found.vertex, line);
    if (!is_new)
      throw std::invalid_argument("vertex " + std::to_string(numbers_.number(found.vertex)) +
                                  " of the " + which_ + " mesh is in two pairs, first in line " +
                                  std::to_string(earlier->second));
    snapped.add(found, "line " + std::to_string(line) + ", " + which_ + " mesh");
    return found.vertex;
  }

 private:
  FoundVertex found_at(const VertexPlace& place) const try {
    return places_.at(place);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(which_ + " mesh: " + error.what());
  }

  std::string which_;
  FileNumbers numbers_;
  VertexPlaces places_;
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
    const bool are_points = words_ahead(scanner).size() == numbers_of_points;
    const auto place = [&]() -> VertexPlace {
      if (are_points) return {.point = point_in(scanner)};
      return {.number = vertex_number(scanner, line_is)};
    };
    VertexPlace first = place(), second = place();
    if (!scanner.at_line_end())
      scanner.fail(
          "expected a vertex of the first mesh and one of the second, or a point of each, in six "
          "numbers, then nothing");
    lines_.push_back({std::move(first), std::move(second), scanner.line_number()});
  }
  if (lines_.empty()) {
    throw ReadError(name,
                    "there is no pair in it: a line is a vertex of the first mesh and one of the "
                    "second");
  }
}

LandmarkFile::Found LandmarkFile::pairs(const MeshFile& from, const MeshFile& to) const {
  Side first("first", from), second("second", to);
  Found found;
  for (const Line& line : lines_) {
    try {
      const Vertex one = first.vertex(line.first, line.number, found.snapped),
                   other = second.vertex(line.second, line.number, found.snapped);
      found.pairs.push_back({one, other});
    } catch (const std::invalid_argument& error) {
      throw ReadError::at_line(name_, line.number, error.what());
    }
  }
  return found;
}

}  // namespace sphparam
