#include "sphparam/io/mesh_writer.h"

#include "io/formats/mesh_formats.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {
namespace {

/// Null where no format is written under this name.
const MeshFormat* written_format(const std::string& path) {
  const std::string extension = is_stream(path) ? "" : extension_of(path);
  const MeshFormat* format = format_of_extension(extension.empty() ? ".ply" : extension);
  return format && format->write ? format : nullptr;
}

std::string written_extensions() {
  std::string all;
  for (const MeshFormat& format : mesh_formats())
    if (format.write) all += (all.empty() ? "" : ", ") + std::string(format.extensions.front());
  return all;
}

}  // namespace

bool is_written(const std::string& path) { return written_format(path) != nullptr; }

bool keeps_map(const std::string& path) {
  const MeshFormat* const format = written_format(path);
  return format && format->keeps_map;
}

std::string serialise_mesh(const std::string& path, const MeshFile& file,
                           const WriteOptions& options) {
  const MeshFormat* const format = written_format(path);
  if (!format) throw WriteError(path, "meshes are written as " + written_extensions());
  if (format->keeps_map || options.is_sphere) return format->write(file, options);
  return format->write(without_map(file), options);
}

void write_mesh(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  write_file(path, serialise_mesh(path, file, options));
}

}  // namespace sphparam
