// The text of a file is searched for names, which is quick beside reading its mesh. It does no harm
// to find more than a reader would look at: at worst an item runs once more.

#include "batch/input_hash.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/content_hash.h"
#include "io/attributes/named_file.h"
#include "io/attributes/texture_pages.h"
#include "io/files/file_bytes.h"
#include "io/files/gzip.h"
#include "io/formats/gltf/gltf_container.h"
#include "io/formats/gltf/gltf_files.h"
#include "io/formats/gltf/gltf_reader.h"
#include "io/formats/obj/obj_materials.h"
#include "io/formats/obj/obj_reader.h"
#include "io/formats/ply/ply_reader.h"
#include "io/formats/scene_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// What a mesh file names beside it.
class NamedFiles {
 public:
  NamedFiles(std::string_view bytes, const std::string& path, fs::path folder)
      : folder_(std::move(folder)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    if (looks_like_gltf(bytes)) {
      find_uris(bytes, path);
    } else if (looks_like_collada(bytes)) {
      for (const char* const mark : {"<init_from", "<ref"})
        find_behind(bytes, mark, [&](std::string_view rest) { add_picture(text_of_xml(rest)); });
    } else if (looks_like_fbx(bytes)) {
      for (const char* const mark : {"Filename", "FileName"})
        find_behind(bytes, mark, [&](std::string_view rest) { add_picture(text_of_fbx(rest)); });
    } else if (looks_like_ply(bytes)) {
      find_pages(bytes.substr(0, bytes.find("\nend_header")));
    } else if (looks_like_obj(bytes)) {
      find_libraries(bytes);
    }
  }

  bool any() const { return any_; }
  const std::set<fs::path>& there() const { return there_; }  // relative to the folder
  const fs::path& folder() const { return folder_; }

 private:
  static constexpr std::size_t longest = 4096;  // names

  void add(const fs::path& path) {
    any_ = true;
    std::error_code hidden;
    if (fs::is_regular_file(folder_ / path, hidden)) there_.insert(path.lexically_normal());
  }

  /// Refused names are passed over: no reader looks at those files.
  void add_uri(std::string_view uri) try {
    if (!uri.starts_with("data:")) add(path_of_uri(uri));
  } catch (const std::runtime_error&) {
  }

  /// Of buffers, images and whatever else has any. Nothing of the JSON is kept.
  void find_uris(std::string_view bytes, const std::string& name) try {
    using Event = Json::parse_event_t;
    std::vector<std::string> unused;
    const std::string padded = with_padded_chunks(bytes, unused);
    const std::string_view json = open_gltf(padded.empty() ? bytes : padded, name, unused).json;
    std::string key;
    const auto note = [&](int, Event event, Json& value) {
      if (event == Event::key) key = value.get<std::string>();
      if (event == Event::value && key == "uri" && value.is_string())
        add_uri(value.get_ref<const std::string&>());
      return event != Event::value;
    };
    [[maybe_unused]] const Json none = Json::parse(json.begin(), json.end(), note, false);
  } catch (const ReadError&) {  // nor will its mesh be read
  }

  template <class Body>
  static void find_behind(std::string_view bytes, std::string_view mark, const Body& body) {
    for (std::size_t at = bytes.find(mark); at != std::string_view::npos;
         at = bytes.find(mark, at + mark.size()))
      body(bytes.substr(at + mark.size()));
  }

  static std::string_view up_to(std::string_view text, std::string_view end) {
    text = text.substr(0, longest);
    return text.substr(0, text.find(end));
  }

  /// Behind the name of its element, which may have attributes.
  static std::string text_of_xml(std::string_view rest) {
    constexpr std::string_view blanks = " \t\r\n";
    constexpr std::pair<std::string_view, char> entities[] = {
        {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
    const bool is_longer_name = !rest.starts_with('>') && rest.find_first_of(blanks) != 0;
    if (is_longer_name) return "";
    rest.remove_prefix(std::min(up_to(rest, ">").size() + 1, rest.size()));
    rest = up_to(rest, "<");
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    std::string text(rest.substr(0, rest.find_last_not_of(blanks) + 1));
    for (const auto& [entity, sign] : entities)
      for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at))
        text.replace(at++, entity.size(), 1, sign);
    return text;
  }

  /// Behind the name of its property: `: "TEXT"`, or in binary files 'S', four bytes of length,
  /// TEXT.
  static std::string_view text_of_fbx(std::string_view rest) {
    if (rest.starts_with(": \"")) return up_to(rest.substr(3), "\"");
    if (!rest.starts_with('S') || rest.size() < 5) return "";
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
    const std::size_t length = byte(1) | std::size_t{byte(2)} << 8;
    return byte(3) == 0 && byte(4) == 0 && length <= longest ? rest.substr(5, length) : "";
  }

  /// As the module of scenes places it, which is as good as any URI then.
  void add_picture(std::string_view text) {
    std::string path(text);
    std::ranges::replace(path, '\\', '/');
    const bool elsewhere =
        path.starts_with('/') || path.starts_with("../") || path.find(':') != std::string::npos;
    if (elsewhere) path.erase(0, path.rfind('/') + 1);
    if (path.empty()) return;
    add(path);
    add_uri(path);
  }

  /// In the comments of the header.
  void find_pages(std::string_view header) {
    find_behind(header, std::string("comment ") + texture_page_comment, [&](std::string_view rest) {
      MeshFile named;
      named.comments = {texture_page_comment + std::string(up_to(rest, "\n"))};
      for (const std::string& page : texture_pages(named)) add(file_below(folder_, {}, page).path);
    });
  }

  void find_libraries(std::string_view bytes) {
    std::vector<std::string> libraries;
    std::set<std::string> seen;
    const char* end = bytes.data();  // of the last statement
    find_behind(bytes, "mtllib", [&](std::string_view rest) {
      if (rest.data() < end) return;
      const std::string_view before = bytes.substr(0, rest.data() - bytes.data() - 6);
      const std::size_t last = before.find_last_not_of(" \t");
      const bool begins =
          last == std::string_view::npos || before[last] == '\n' || before[last] == '\r';
      if (!begins) return;
      std::string statement = take_statement(rest);
      end = rest.data();
      if (seen.insert(statement).second) libraries.push_back(std::move(statement));
    });
    any_ = !libraries.empty();
    for (const std::string& file : library_files(libraries, folder_))
      add(fs::path(file).lexically_relative(folder_));
    for (const std::string& image : library_images(libraries, folder_, {})) add(image);
  }

  /// To the end of its line, which a backslash carries on to the next. Leaves what comes then.
  static std::string take_statement(std::string_view& rest) {
    std::string statement;
    for (;;) {
      const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      statement += rest.substr(0, end);
      statement.erase(statement.find_last_not_of(" \t") + 1);
      rest.remove_prefix(end);
      if (!statement.ends_with('\\') || rest.empty()) break;
      statement.back() = ' ';
      rest.remove_prefix(rest.starts_with("\r\n") ? 2 : 1);
    }
    return statement.substr(std::min(statement.find_first_not_of(" \t"), statement.size()));
  }

  const fs::path folder_;
  bool any_ = false;
  std::set<fs::path> there_;
};

/// What of a file names others, where it is packed too: nothing of formats that name none, which
/// need no unpacking, and of a PLY its header alone.
std::string unpacked(std::string_view bytes, const std::string& path) {
  constexpr std::string_view naming[] = {".gltf", ".glb", ".obj", ".ply", ".dae", ".fbx"};
  if (std::ranges::count(naming, inner_extension_of(path)) == 0) return "";
  constexpr std::size_t longest_header = 1 << 20;
  if (std::string begin = beginning_of_gzip(bytes, longest_header); looks_like_ply(begin))
    return begin;
  try {
    return unzip(bytes, path, ReadOptions{}.max_file_bytes).bytes;
  } catch (const ReadError&) {
    return "";
  }
}

/// Empty: it cannot be read, which is for the step to say that wants it.
std::string hash_of_companion(const fs::path& path) try {
  return hash_of_file(path.string());
} catch (const ReadError&) {
  return "";
}

}  // namespace

InputHash hash_of_input(const std::string& path) {
  const FileBytes bytes(path, std::numeric_limits<std::uint64_t>::max());
  const bool packed = looks_like_gzip(bytes.view());
  const std::string text = packed ? unpacked(bytes.view(), path) : "";
  const std::string_view naming = packed ? text : bytes.view();
  const NamedFiles named(naming, path, fs::path(path).parent_path());
  std::string hash = content_hash(bytes.view()), others;
  const auto add = [&](const NamedFiles& files, const char* mark) {
    for (const fs::path& file : files.there())
      others += mark + file.string() + '\0' + hash_of_companion(files.folder() / file);
  };
  add(named, "\n");
  if (const auto target = named.any() ? folder_behind(path) : std::nullopt)
    add(NamedFiles(naming, path, *target), "\n/");  // no file that is named begins so
  if (others.empty()) return {hash, !named.any()};
  return {content_hash(hash + others), false};
}

}  // namespace sphparam
