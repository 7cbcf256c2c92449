// Places → shapes: what kind of place it is, is told by its name and by what lies in it.

#include "sphparam/batch/inputs.h"

#include <glob.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "batch/shape_id.h"
#include "batch/tables.h"
#include "io/files/file_bytes.h"
#include "io/formats/shapes/shape_tables.h"
#include "number_text.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t told_at_most = 5;

/// Where a header of one column has what other programs put between columns.
std::string advice_on_separators(const std::vector<std::string>& header) {
  const bool others = header.size() == 1 && header[0].find_first_of(";\t,") != std::string::npos;
  return others ? ": columns are separated by commas, or by tabs in a .tsv" : "";
}

std::string whole_path(const fs::path& path) {
  return fs::absolute(path).lexically_normal().string();
}

/// Also false for what cannot be asked: names that are too long, links that go round, folders that
/// are closed to us.
bool is_file(const fs::path& path) {
  std::error_code hidden;
  return fs::is_regular_file(path, hidden);
}
bool is_folder(const fs::path& path) {
  std::error_code hidden;
  return fs::is_directory(path, hidden);
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

/// "sub-01_hemi-L_white" of "sub-01_hemi-L_white.surf.gii", "lh.white" of itself.
std::string name_of_shape(const std::string& path) {
  std::string name = is_mesh_name(path) ? stem_of(path) : fs::path(path).filename().string();
  if (name.ends_with(".surf")) name.resize(name.size() - 5);
  return name;
}

/// One shape, which has no id yet where nobody gave one.
struct Found {
  std::string path, id;
  std::vector<std::string> values;
  std::string list = {};  // that names it; empty: none does
};

class Finder {
 public:
  explicit Finder(const BatchInputOptions& options) : options_(options) {}

  void look_at(const std::string& place) {
    const std::string extension = extension_of(place);
    if (is_folder(place)) return folder(place);
    std::error_code hidden;
    if (!is_stream(place) && !fs::exists(place, hidden)) return pattern(place);
    if (extension == ".csv" || extension == ".tsv") return table(place);
    if (!is_stream(place) && is_mesh_name(place)) return add(place);
    list(place);
  }

  const std::vector<std::string>& columns() const { return columns_; }
  /// What was left out, a line a reason.
  std::vector<std::string> notes() const {
    std::vector<std::string> notes = notes_;
    if (!unreadable_.empty())
      notes.push_back(left_out(unreadable_, "file or folder", "files or folders") +
                      " as what cannot be read");
    if (!of_batches_.empty())
      notes.push_back(left_out(of_batches_, "folder", "folders") +
                      " as what a batch made; named itself, it is looked into");
    return notes;
  }
  std::vector<Found>& found() { return found_; }

 private:
  void add(const fs::path& path, std::string id = "", std::vector<std::string> values = {}) {
    values.resize(columns_.size());
    found_.push_back({whole_path(path), std::move(id), std::move(values)});
  }

  void pattern(const std::string& place) {
    if (place.find_first_of("*?[") == std::string::npos)
      throw BatchInputError(place + ": no such file or folder");
    glob_t matches{};
    const int result = ::glob(place.c_str(), GLOB_BRACE | GLOB_TILDE, nullptr, &matches);
    for (std::size_t i = 0; i < matches.gl_pathc; ++i)
      if (is_file(matches.gl_pathv[i])) add(matches.gl_pathv[i]);
    ::globfree(&matches);
    if (result == GLOB_NOMATCH) throw BatchInputError(place + ": no file matches this pattern");
  }

  /// As it stands beside the list, or else in the current folder.
  static fs::path named_in(const std::string& list, const std::string& name) {
    const fs::path beside = (is_stream(list) ? fs::path() : fs::path(list).parent_path()) / name;
    std::error_code hidden;  // a line that is too long for a name is none
    return fs::exists(beside, hidden) ? beside : fs::path(name);
  }

  /// Where it begins: at a '#' that nothing or a blank stands before; others belong to names.
  static std::size_t remark_in(std::string_view line) {
    std::size_t at = line.find('#');
    while (at != std::string_view::npos && at > 0 && line[at - 1] != ' ' && line[at - 1] != '\t')
      at = line.find('#', at + 1);
    return at;
  }

  /// Shape models of bodies are texts as well, and often called .txt.
  void list(const std::string& place) {
    const FileBytes bytes(place, std::numeric_limits<std::uint64_t>::max());
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    std::string_view text = bytes.view();
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    if (!is_stream(place) && shape_table(text) != ShapeTable::None) return add(place);
    for (std::string line : lines_of(text)) {
      line.resize(std::min(remark_in(line), line.size()));
      while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.pop_back();
      if (line.find('\0') != std::string::npos)
        throw BatchInputError(display_name(place) +
                              ": neither a mesh that can be read nor a list of meshes");
      if (line.empty()) continue;
      add(named_in(place, line));
      found_.back().list = display_name(place);
    }
  }

  void table(const std::string& place) {
    const FileBytes bytes(place, std::numeric_limits<std::uint64_t>::max());
    const TextTable table =
        read_table(bytes.view(), extension_of(place) == ".tsv" ? '\t' : ',', display_name(place));
    const auto path = std::ranges::find(table.header, "path");
    if (path == table.header.end())
      throw BatchInputError(display_name(place) + ": no column `path` among " +
                            joined(table.header) + advice_on_separators(table.header));
    for (const std::string& name : table.header) {
      const bool known = name == "path" || name == "id" || std::ranges::count(columns_, name) > 0;
      if (!known) columns_.push_back(name);
    }
    const std::size_t path_column = path - table.header.begin();
    for (const auto& row : table.rows) add_row(place, table.header, row, path_column);
  }

  void add_row(const std::string& place, const std::vector<std::string>& header,
               const std::vector<std::string>& row, std::size_t path_column) {
    std::vector<std::string> values(columns_.size());
    std::string id;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (header[i] == "id") id = id_of_row(place, row[i]);
      const auto column = std::ranges::find(columns_, header[i]);
      if (column != columns_.end()) values[column - columns_.begin()] = row[i];
    }
    add(named_in(place, row[path_column]), std::move(id), std::move(values));
  }

  /// Empty: the name of the file gives it. Another than the table's would be found in no other
  /// table.
  static std::string id_of_row(const std::string& place, const std::string& id) {
    if (id.empty() || is_shape_id(id)) return id;
    throw BatchInputError(display_name(place) + ": the id '" + id +
                          "' names a folder: letters, digits, '.', '_' and '-' are for it, no '.' "
                          "or '-' at first, and 100 bytes at most");
  }

  void folder(const fs::path& place) {
    const std::size_t before = found_.size();
    const bool is_data_set = is_file(place / "dataset_description.json");
    if (is_data_set) {
      bids(place);
    } else if (!freesurfer(place)) {
      meshes_below(place);
    }
    if (found_.size() == before)
      throw BatchInputError(
          place.string() + ": no mesh in this folder" +
          (is_data_set ? " is called *_" + options_.surface + ".surf.gii; see --surface" : "") +
          words_of_texts(place) + (notes().empty() ? "" : "; " + joined(notes(), "; ")));
  }

  /// Shape models may be among them, and notes.
  std::string words_of_texts(const fs::path& place) {
    const auto texts = std::ranges::count_if(
        sorted(place), [](const fs::path& file) { return file.extension() == ".txt"; });
    if (texts == 0) return "";
    return "; " + counted(texts, "file is", "files are") +
           " called *.txt: shape models of bodies among them are named by a pattern, as '" +
           (place / "*.txt").string() + "'";
  }

  static std::string left_out(const std::vector<std::string>& names, const std::string& one,
                              const std::string& many) {
    return counted(std::ssize(names), one, many) + (names.size() == 1 ? " is" : " are") +
           " left out (" + listed(names) + ")";
  }

  static std::string listed(std::vector<std::string> names) {
    const bool has_more = names.size() > told_at_most;
    names.resize(std::min(names.size(), told_at_most));
    return joined(names) + (has_more ? ", …" : "");
  }

  /// Subjects in the order of their names, left before right. Are there any?
  bool freesurfer(const fs::path& place) {
    Subjects subjects;
    for (const fs::path& folder : sorted(place))
      if (is_folder(folder) && !is_of_batch(folder / "results")) add_subject(folder, subjects);
    if (subjects.count > 0 && subjects.without.size() == subjects.count)
      throw BatchInputError(place.string() + ": none of " +
                            counted(static_cast<long>(subjects.count), "subject") +
                            " has surf/lh." + options_.surface + " or surf/rh." + options_.surface +
                            "; see --surface");
    if (subjects.count > 0) tell_missing(subjects);
    return subjects.count > 0;
  }

  struct Subjects {
    std::size_t count = 0;  // that have a surface of any kind
    std::vector<std::string> without, without_left, without_right;  // the surface that is wanted
    std::vector<std::string> others;                                // folders with none at all
  };

  void add_subject(const fs::path& folder, Subjects& subjects) {
    const std::string name = folder.filename().string();
    if (!has_hemispheres(folder)) return subjects.others.push_back(name);
    ++subjects.count;
    const bool left = add_hemisphere(folder, "lh"), right = add_hemisphere(folder, "rh");
    if (!left && !right) return subjects.without.push_back(name);
    if (!left) subjects.without_left.push_back(name);
    if (!right) subjects.without_right.push_back(name);
  }

  void tell_missing(const Subjects& subjects) {
    const std::string of_all = " of " + std::to_string(subjects.count);
    if (!subjects.without.empty())
      notes_.push_back(left_out(subjects.without, "subject", "subjects") + of_all +
                       ", without the surface " + options_.surface);
    for (const auto& [side, names] :
         {std::pair("lh.", &subjects.without_left), std::pair("rh.", &subjects.without_right)})
      if (!names->empty())
        notes_.push_back(counted(std::ssize(*names), "subject") + of_all + " without " + side +
                         options_.surface + ", with the other hemisphere alone (" + listed(*names) +
                         ")");
    if (!subjects.others.empty())
      notes_.push_back(left_out(subjects.others, "folder", "folders") +
                       " as what has no surface in surf/");
  }

  /// Is it there?
  bool add_hemisphere(const fs::path& subject, const std::string& side) {
    const std::string name = side + "." + options_.surface;
    for (const std::string ending : {".surf.gii", ".gii", ""}) {
      const fs::path file = subject / "surf" / (name + ending);
      if (!is_file(file)) continue;
      add(file, shape_id_of(subject.filename().string() + "_" + side + "_" + options_.surface));
      return true;
    }
    return false;
  }

  /// Of whatever surface.
  static bool has_hemispheres(const fs::path& subject) {
    std::error_code hidden;
    for (fs::directory_iterator at(subject / "surf", hidden), end; at != end;
         at.increment(hidden)) {
      const std::string name = at->path().filename().string();
      if (name.starts_with("lh.") || name.starts_with("rh.")) return true;
    }
    return false;
  }

  void bids(const fs::path& place) {
    const std::string ending = "_" + options_.surface + ".surf.gii";
    for (const fs::path& file : files_below(place)) {
      const std::string name = file.filename().string();
      if (!name.starts_with("sub-")) continue;
      if (name.ends_with(ending) || name.ends_with(ending + ".gz")) add_readable(file);
    }
  }

  void meshes_below(const fs::path& place) {
    for (const fs::path& file : files_below(place))
      if (is_mesh_name(file.string())) add_readable(file);
  }

  /// One that lies in a folder with others is no reason to refuse them.
  void add_readable(const fs::path& file) {
    if (is_file(file) && ::access(file.c_str(), R_OK) == 0) return add(file);
    unreadable_.push_back(file.string());
  }

  static std::vector<fs::path> sorted(const fs::path& place) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator at(place, error), end; !error && at != end; at.increment(error))
      if (!is_hidden(at->path())) entries.push_back(at->path());
    if (error) throw ReadError(place.string(), error.message());
    std::ranges::sort(entries);
    return entries;
  }

  std::vector<fs::path> files_below(const fs::path& place) {
    std::set<fs::path> seen;
    std::vector<fs::path> files;
    add_files_below(place, seen, files);
    return files;
  }

  /// What a batch made is its result, not what the next one begins with.
  static bool is_of_batch(const fs::path& folder) {
    const fs::path batch = folder.parent_path();
    return (folder.filename() == "results" || folder.filename() == "staging") &&
           is_folder(batch / "results") && is_folder(batch / "staging") &&
           is_folder(batch / "failed");
  }

  /// `seen`: folders as they are called without links, which may lead back to where they lie.
  void add_files_below(const fs::path& place, std::set<fs::path>& seen,
                       std::vector<fs::path>& files) {
    std::error_code error;
    const fs::path folder = fs::canonical(place, error);
    if (error) throw ReadError(place.string(), error.message());
    if (!seen.insert(folder).second) return;
    for (const fs::path& entry : sorted(place)) {
      if (!is_folder(entry)) {
        files.push_back(entry);
      } else if (is_of_batch(entry)) {
        if (entry.filename() == "results") of_batches_.push_back(entry.string());
      } else if (::access(entry.c_str(), R_OK | X_OK) != 0) {
        unreadable_.push_back(entry.string());
      } else {
        add_files_below(entry, seen, files);
      }
    }
  }

  const BatchInputOptions& options_;
  std::vector<std::string> columns_;
  std::vector<Found> found_;
  std::vector<std::string> notes_, unreadable_, of_batches_;
};

/// The name of a file behind those of so many of the folders that it lies in.
std::string name_with_folders(const std::string& path, int folders) {
  std::string name = name_of_shape(path);
  fs::path folder = fs::path(path).parent_path();
  for (; folders > 0 && folder.has_relative_path(); --folders, folder = folder.parent_path())
    name = folder.filename().string() + "_" + name;
  return name;
}

/// Where two names would be one id, a name that is none itself gets its hash.
std::string id_apart(const std::string& name, const std::map<std::string, int>& names_of_id) {
  const std::string id = shape_id_of(name);
  return names_of_id.at(id) > 1 && id != name ? shape_id_with_hash(name) : id;
}

/// Names of files that have one: with the names of folders before them, as many as it takes to tell
/// the folders apart.
std::vector<std::string> names_apart(const std::vector<Found*>& files) {
  std::vector<std::string> names(files.size(), name_of_shape(files.front()->path));
  std::set<fs::path> places;
  for (const Found* const file : files) places.insert(fs::path(file->path).parent_path());
  for (int folders = 1; places.size() > 1 && folders < 32; ++folders) {
    std::vector<std::string> longer;
    for (const Found* const file : files) longer.push_back(name_with_folders(file->path, folders));
    if (std::set<std::string>(longer.begin(), longer.end()).size() == places.size()) return longer;
  }
  return names;
}

void name_apart(std::vector<Found>& found) {
  std::map<std::string, std::vector<Found*>> by_name;
  for (Found& one : found)
    if (one.id.empty()) by_name[name_of_shape(one.path)].push_back(&one);
  std::vector<std::pair<Found*, std::string>> named;
  for (const auto& [name, files] : by_name) {
    const std::vector<std::string> names = names_apart(files);
    for (std::size_t i = 0; i < files.size(); ++i) named.emplace_back(files[i], names[i]);
  }
  std::map<std::string, int> names_of_id;
  for (const auto& [file, name] : named) ++names_of_id[shape_id_of(name)];
  for (const auto& [file, name] : named) file->id = id_apart(name, names_of_id);
}

void require_distinct(const std::vector<Found>& found) {
  std::map<std::string, const Found*> by_id;
  for (const Found& one : found) {
    const auto [other, is_new] = by_id.emplace(one.id, &one);
    if (is_new) continue;
    throw BatchInputError(
        "two shapes have the id " + one.id + ": " + other->second->path + " and " + one.path +
        (other->second->path == one.path ? "; a shape belongs into a batch once"
                                         : "; ids of a table, in a column `id`, tell them apart"));
  }
}

void require_there(const std::vector<Found>& found) {
  std::vector<std::string> missing;
  std::string list;
  for (const Found& one : found) {
    if (is_file(one.path)) continue;
    missing.push_back(one.path);
    if (list.empty()) list = one.list;
  }
  if (missing.empty()) return;
  const std::size_t count = missing.size();
  missing.resize(std::min(count, told_at_most));
  throw BatchInputError(counted(std::ssize(found), "shape", "shapes") + ", of which " +
                        std::to_string(count) + (count == 1 ? " is" : " are") +
                        " not there: " + joined(missing) + (count > told_at_most ? ", …" : "") +
                        (list.empty() ? "" : "; " + list + " was read as a list of paths"));
}

}  // namespace

BatchInputs find_batch_inputs(const std::vector<std::string>& places,
                              const BatchInputOptions& options) {
  Finder finder(options);
  for (const std::string& place : places) finder.look_at(place);
  std::vector<Found>& found = finder.found();
  if (found.empty()) throw BatchInputError("no shape in " + joined(places));
  require_there(found);
  name_apart(found);
  require_distinct(found);
  BatchInputs inputs{finder.columns(), {}, finder.notes()};
  for (Found& one : found) {
    one.values.resize(inputs.columns.size());
    inputs.shapes.push_back({std::move(one.id), std::move(one.path), std::move(one.values)});
  }
  return inputs;
}

}  // namespace sphparam
