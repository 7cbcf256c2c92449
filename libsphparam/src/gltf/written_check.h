#pragma once

#include <string>
#include <string_view>

#include "gltf/export_chart.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/mesh/fillers.h"

namespace sphparam {

/// Reads a .glb back by the reader of strangers' files and compares its first level with the asset:
/// the same triangles, positions and (u, v), number by number; quantised ones within half a step,
/// compressed triangles but for which corner is first. So what was certified of the asset holds for
/// the file.
/// Throws: std::runtime_error that names what differs; ReadError.
void check_written(std::string_view glb, const std::string& name, const Asset& asset,
                   const GltfOptions& options);

/// Reads an .obj or .ply of `textured_mesh` back and certifies the chart with the texture
/// coordinates that stand there. `fillers` of the chart are not in the file. `name`: its extension
/// decides where the content does not. Throws: std::runtime_error where triangles or coordinates
/// are missing or differ; ReadError.
ChartCertificate certify_written(std::string_view bytes, const std::string& name,
                                 const ExportChart& chart, const FillerMarks& fillers = {},
                                 int threads = 0);

}  // namespace sphparam
