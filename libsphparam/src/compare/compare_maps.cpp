#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "compare/comparison.h"
#include "option_domain.h"
#include "sphere/required_rays.h"
#include "sphparam/io/fillers.h"
#include "sphparam/report/compare.h"

namespace sphparam {

namespace {

AnyMethod require_method(const std::string& name) {
  if (const std::optional<AnyMethod> method = method_named(name)) return *method;
  throw std::invalid_argument("no method " + name);
}

/// Files are called by the names of the maps: two of one name would be one file.
void require_names(const std::vector<std::string>& methods, const std::vector<NamedMap>& others) {
  std::set<std::string> names;
  const auto take = [&](const std::string& name) {
    if (!names.insert(name).second)
      throw std::invalid_argument("two maps to compare are called " + name);
  };
  for (const std::string& method : methods) take(method);
  for (const NamedMap& other : others) {
    if (!can_name_files(other.name))
      throw std::invalid_argument("a map to compare is called \"" + other.name +
                                  "\": its name must be of letters, digits, dots, - and _, and "
                                  "begin with no dot and no -");
    take(other.name);
  }
}

}  // namespace

bool can_name_files(std::string_view name) {
  constexpr std::string_view letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  return !name.empty() && name.front() != '.' && name.front() != '-' &&
         name.find_first_not_of(letters) == std::string_view::npos;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const MethodInfo& info : all_methods()) names.emplace_back(info.name);
  return names;
}

std::vector<Entry> make_entries(const MeshFile& file, const std::vector<std::string>& methods,
                                const std::vector<NamedMap>& others, const CompareOptions& options,
                                const std::function<void(const Entry&)>& tell) {
  std::vector<AnyMethod> wanted;
  for (const std::string& method : methods) wanted.push_back(require_method(method));
  std::vector<Entry> entries;
  const auto add = [&](Entry entry) {
    measure_surface(entry, file, options.threads);
    if (tell) tell(entry);
    entries.push_back(std::move(entry));
  };
  for (const AnyMethod method : wanted) {
    add(entry_of_method(
        method, file.mesh,
        {.fillers = fillers_of(file), .threads = options.threads, .progress = options.progress}));
  }
  for (const NamedMap& other : others)
    add(entry_of_map(other.name, other.source, file.mesh, other.map, options.threads));
  return entries;
}

ComparisonOptions comparison_options(const MeshFile& file, const CompareOptions& options) {
  PictureOptions look = seen_upright(upright_axes(file, options.up));
  look.size = options.size;
  look.threads = options.threads;
  return {.pictures = options.pictures,
          .look = look,
          .textures = options.textures ? *options.textures : MeshTextures{}};
}

FolderFiles compare_maps(const std::string& name, const MeshFile& file,
                         const std::vector<std::string>& methods,
                         const std::vector<NamedMap>& others, const CompareOptions& options) {
  if (methods.empty() && others.empty()) throw std::invalid_argument("there is nothing to compare");
  require_between("size", options.size, 16, 4096);
  require_names(methods, others);
  for (const NamedMap& other : others)
    require_rays("compare_maps", other.map, file.mesh.vertex_count());
  return comparison_files(name, file, make_entries(file, methods, others, options),
                          comparison_options(file, options));
}

}  // namespace sphparam
