#include "gltf/usd/usd_head.h"

#include "gltf/usd/usd_check.h"
#include "number_text.h"
#include "sphparam/version.h"

namespace sphparam {

std::string usd_creator() { return std::string("string creator = \"sphparam ") + version + "\""; }

void put_head(LayerText& text, const Asset& asset) {
  text.line("#usda 1.0");
  text.open("(");
  text.open("customLayerData = {");
  text.line(usd_creator());
  if (!asset.copyright.empty()) text.line("string copyright = %", {usd_string(asset.copyright)});
  if (!asset.source_extras.empty())
    text.line("string extras = %", {usd_string(asset.source_extras)});
  text.open("dictionary sphparam = {");
  for (const auto& [key, value] : asset.extras)
    text.line("string % = %", {usd_name(key), usd_string(value)});
  text.close();
  text.close();
  text.line("defaultPrim = \"%\"", {usd_name(asset.name)});
  text.line("metersPerUnit = 1");
  text.line("upAxis = \"Y\"");
  text.close(")");
}

void put_origin(LayerText& text, const Eigen::RowVector3d& origin) {
  if (origin.isZero(0)) return;
  const std::string tuple = joined({shortest(origin[0]), shortest(origin[1]), shortest(origin[2])});
  text.line("double3 xformOp:translate = (%)", {tuple});
  text.line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
}

FloatRows upward(FloatRows uv) {
  uv.col(1) = 1 - uv.col(1).array();
  return uv;
}

}  // namespace sphparam
