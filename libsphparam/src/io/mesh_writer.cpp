#include "sphparam/io/mesh_writer.h"

#include "io/files/gzip.h"
#include "io/formats/mesh_formats.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {
namespace {

/// Null where no format is written under this name.
const MeshFormat* written_format(const std::string& path) {
  const std::string extension = is_stream(path) ? "" : inner_extension_of(path);
  const MeshFormat* format = format_of_extension(extension.empty() ? ".ply" : extension);
  return format && format->write ? format : nullptr;
}

}  // namespace

std::string written_extensions(const std::string& conjunction) {
  std::string all;
  for (const MeshFormat& format : mesh_formats())
    if (format.write) all += (all.empty() ? "" : ", ") + std::string(format.extensions.front());
  return all.replace(all.rfind(", "), 2, " " + conjunction + " ");
}

bool is_written(const std::string& path) { return written_format(path) != nullptr; }

bool keeps_map(const std::string& path) {
  const MeshFormat* const format = written_format(path);
  return format && format->keeps_map;
}

bool has_float_spheres(const std::string& path) {
  const MeshFormat* const format = written_format(path);
  return format && format->float_spheres;
}

bool has_data_beside(const std::string& path) {
  const MeshFormat* const format = written_format(path);
  return format && format->data_beside;
}

std::string serialise_mesh(const std::string& path, const MeshFile& file,
                           const WriteOptions& options) {
  const MeshFormat* const format = written_format(path);
  if (!format)
    throw WriteError(
        path, "meshes are written as " + written_extensions("or") + ", with .gz after it for gzip");
  std::string bytes = format->keeps_map || options.is_sphere
                          ? format->write(file, options, path)
                          : format->write(without_map(file), options, path);
  if (is_packed_name(path)) return zip(bytes);
  return bytes;
}

void write_mesh(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  write_file(path, serialise_mesh(path, file, options));
}

}  // namespace sphparam
