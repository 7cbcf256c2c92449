#include "sphparam/correspondence/landmark_file.h"

#include <unordered_map>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"

namespace sphparam {
namespace {

/// The vertices of one side, and the lines they are in.
class Side {
 public:
  Side(std::string which, const FileNumbers& numbers)
      : which_(std::move(which)), numbers_(numbers) {}

  Vertex next(TextScanner& scanner) {
    const long number = scanner.integer();
    const Vertex vertex = numbers_.vertex(number);
    if (vertex < 0) scanner.fail(which_ + " mesh: " + numbers_.absence(number));
    const auto [earlier, is_new] = lines_.emplace(vertex, scanner.line_number());
    if (!is_new) {
      scanner.fail("vertex " + std::to_string(number) + " of the " + which_ +
                   " mesh is in two pairs, first in line " + std::to_string(earlier->second));
    }
    return vertex;
  }

 private:
  std::string which_;
  const FileNumbers& numbers_;
  std::unordered_map<Vertex, long> lines_;
};

}  // namespace

std::vector<LandmarkPair> parse_landmarks(std::string_view text, const std::string& name,
                                          const FileNumbers& from, const FileNumbers& to) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const ReadOptions limits;
  TextScanner scanner(text, name, limits);
  scanner.require_text();
  Side first("first", from), second("second", to);
  std::vector<LandmarkPair> pairs;
  while (scanner.next_filled_line()) {
    const Vertex a = first.next(scanner), b = second.next(scanner);
    if (!scanner.at_line_end())
      scanner.fail("expected a vertex of the first mesh and one of the second, then nothing");
    pairs.push_back({a, b});
  }
  if (pairs.empty()) {
    throw ReadError(name,
                    "there is no pair in it: a line is a vertex of the first mesh and one of the "
                    "second");
  }
  return pairs;
}

std::vector<LandmarkPair> read_landmarks(const std::string& path, const FileNumbers& from,
                                         const FileNumbers& to) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_landmarks(bytes.view(), bytes.name(), from, to);
}

}  // namespace sphparam
