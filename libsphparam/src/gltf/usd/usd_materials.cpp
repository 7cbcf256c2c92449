// A material is a surface whose inputs are numbers or outputs of readers beside it: one for the
// texture coordinates, one an image. Occlusion, roughness and metallic of one image share a reader.

#include "gltf/usd/usd_materials.h"

#include <algorithm>
#include <utility>

#include "free_name.h"
#include "io/attributes/finish_terms.h"
#include "number_text.h"

namespace sphparam {

namespace {

struct Reader {
  std::string_view name;
  int image = -1;
  std::string_view colour_space = "raw", scale = {}, bias = {};
};

/// What an input is: an output of a reader, "base_colour.outputs:rgb", or a value.
struct Input {
  std::string_view type_and_name;
  std::string output = {}, value = {};
};

constexpr std::string_view base_colour = "base_colour.outputs:rgb",
                           vertex_colour = "vertex_colour.outputs:result", black = "(0, 0, 0)";

bool has_colours(const Asset& asset) { return !asset.levels.front().colours.empty(); }

/// The readers of a material and the inputs of its surface.
class Network {
 public:
  Network(const Material& material, bool coloured) : material_(material), coloured_(coloured) {
    if (material.base_colour >= 0 && !coloured)
      readers_.push_back({"base_colour", material.base_colour, "sRGB"});
    material.unlit ? show_unlit() : show_lit();
    if (material.alpha_mode == AlphaMode::Opaque || readers_.empty() || coloured) return;
    connect("float inputs:opacity", "base_colour.outputs:a");
    if (material.alpha_mode == AlphaMode::Mask)
      set("float inputs:opacityThreshold", shortest(material.alpha_cutoff));
  }

  const std::vector<Reader>& readers() const { return readers_; }
  const std::vector<Input>& inputs() const { return inputs_; }

 private:
  void connect(std::string_view input, std::string_view output) {
    inputs_.push_back({input, std::string(output)});
  }
  void set(std::string_view input, std::string value) {
    inputs_.push_back({input, {}, std::move(value)});
  }

  void show_colour(std::string_view input) {
    if (coloured_) {
      connect(input, vertex_colour);
    } else if (material_.base_colour >= 0) {
      connect(input, base_colour);
    } else {
      set(input, "(1, 1, 1)");
    }
  }

  /// As light that it gives, and none that it reflects.
  void show_unlit() {
    show_colour("color3f inputs:emissiveColor");
    set("color3f inputs:diffuseColor", std::string(black));
    set("int inputs:useSpecularWorkflow", "1");
    set("color3f inputs:specularColor", std::string(black));
    set("float inputs:roughness", "1");
  }

  void show_lit() {
    show_colour("color3f inputs:diffuseColor");
    show_finish();
    show_normals();
    show_orm();
    if (material_.emissive < 0) return;
    strength_ = tuple(material_.emissive_strength, 1);
    readers_.push_back({"emissive", material_.emissive, "sRGB",
                        material_.emissive_strength == 1 ? std::string_view() : strength_});
    connect("color3f inputs:emissiveColor", "emissive.outputs:rgb");
  }

  void show_finish() {
    const MaterialFinish& finish = material_.finish;
    const MaterialFinish none;
    if (finish.clearcoat != none.clearcoat) {
      set("float inputs:clearcoat", shortest(finish.clearcoat));
      set("float inputs:clearcoatRoughness", shortest(finish.clearcoat_roughness));
    }
    if (finish.ior != none.ior) set("float inputs:ior", shortest(finish.ior));
  }

  void show_normals() {
    if (material_.normal < 0) return;
    readers_.push_back({"normal", material_.normal, "raw", "(2, 2, 2, 1)", "(-1, -1, -1, 0)"});
    connect("normal3f inputs:normal", "normal.outputs:rgb");
  }

  void show_orm() {
    const int orm = material_.metallic_roughness;
    if (orm >= 0) {
      readers_.push_back({"orm", orm});
      connect("float inputs:roughness", "orm.outputs:g");
      connect("float inputs:metallic", "orm.outputs:b");
    } else {
      set("float inputs:roughness", shortest(material_.roughness));
      set("float inputs:metallic", shortest(material_.metallic));
    }
    if (material_.occlusion < 0) return;
    const bool is_shared = material_.occlusion == orm;
    if (!is_shared) readers_.push_back({"occlusion", material_.occlusion});
    connect("float inputs:occlusion", is_shared ? "orm.outputs:r" : "occlusion.outputs:r");
  }

  static std::string tuple(double factor, double alpha) {
    const std::string number = shortest(factor);
    return "(" + joined({number, number, number, shortest(alpha)}) + ")";
  }

  const Material& material_;
  bool coloured_;
  std::string strength_;
  std::vector<Reader> readers_;
  std::vector<Input> inputs_;
};

void open_shader(LayerText& text, std::string_view name, std::string_view id) {
  text.line("");
  text.line("def Shader \"%\"", {name});
  text.open("{");
  text.line("uniform token info:id = \"%\"", {id});
}

/// Of a primvar.
void write_reader(LayerText& text, std::string_view name, std::string_view type,
                  std::string_view primvar) {
  open_shader(text, name, type == "float2" ? "UsdPrimvarReader_float2" : "UsdPrimvarReader_float3");
  text.line("string inputs:varname = \"%\"", {primvar});
  text.line("% outputs:result", {type});
  text.close();
}

/// Of an image. A path in which an @ stands is between three of them.
void write_reader(LayerText& text, const Reader& reader, std::string_view file,
                  std::string_view material) {
  open_shader(text, reader.name, "UsdUVTexture");
  const std::string_view mark = file.find('@') == std::string_view::npos ? "@" : "@@@";
  text.line("asset inputs:file = %%%", {mark, file, mark});
  text.line("float2 inputs:st.connect = <%/st.outputs:result>", {material});
  text.line("token inputs:sourceColorSpace = \"%\"", {reader.colour_space});
  text.line("token inputs:wrapS = \"repeat\"");
  text.line("token inputs:wrapT = \"clamp\"");
  if (!reader.scale.empty()) text.line("float4 inputs:scale = %", {reader.scale});
  if (!reader.bias.empty()) text.line("float4 inputs:bias = %", {reader.bias});
  for (const char* channel : {"r", "g", "b", "a"}) text.line("float outputs:%", {channel});
  text.line("float3 outputs:rgb");
  text.close();
}

void write_surface(LayerText& text, const std::vector<Input>& inputs, std::string_view material) {
  open_shader(text, "surface", "UsdPreviewSurface");
  for (const Input& input : inputs) {
    if (input.output.empty()) {
      text.line("% = %", {input.type_and_name, input.value});
    } else {
      text.line("%.connect = <%/%>", {input.type_and_name, material, input.output});
    }
  }
  text.line("token outputs:surface");
  text.close();
}

}  // namespace

UsdMaterials::UsdMaterials(const Asset& asset, std::string scope, std::vector<std::string> files)
    : asset_(asset), scope_(std::move(scope)), files_(std::move(files)) {
  for (const Material& material : asset.materials)
    names_.push_back(free_name(usd_name(material.name), [this](const std::string& name) {
      return std::ranges::count(names_, name) > 0;
    }));
}

void UsdMaterials::write(LayerText& text) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const Network network(asset_.materials[i], has_colours(asset_));
    const std::string path = path_of(i);
    if (i > 0) text.line("");
    text.line("def Material \"%\"", {names_[i]});
    text.open("{");
    text.line("token outputs:surface.connect = <%/surface.outputs:surface>", {path});
    write_surface(text, network.inputs(), path);
    if (!network.readers().empty()) write_reader(text, "st", "float2", "st");
    if (has_colours(asset_)) write_reader(text, "vertex_colour", "float3", "displayColor");
    for (const Reader& reader : network.readers())
      write_reader(text, reader, files_[static_cast<std::size_t>(reader.image)], path);
    text.close();
  }
}

std::vector<int> images_of_usd(const Asset& asset) {
  std::vector<int> images;
  for (const Material& material : asset.materials) {
    const Network network(material, has_colours(asset));
    for (const Reader& reader : network.readers())
      if (std::ranges::count(images, reader.image) == 0) images.push_back(reader.image);
  }
  return images;
}

std::vector<std::string> finish_beyond_usd(const Material& material) {
  MaterialFinish left = material.finish;
  const MaterialFinish none;
  left.clearcoat = none.clearcoat;
  left.ior = none.ior;
  return extensions_of(left);
}

}  // namespace sphparam
