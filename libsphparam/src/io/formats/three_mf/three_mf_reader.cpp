#include "io/formats/three_mf/three_mf_reader.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "io/files/zip_archive.h"
#include "io/formats/three_mf/slicer_volumes.h"
#include "io/formats/three_mf/three_mf_model.h"
#include "io/formats/three_mf/three_mf_surface.h"
#include "io/formats/xml_events.h"
#include "number_text.h"
#include "sphparam/io/losses.h"

// A ZIP archive of XML parts (Open Packaging). The root relationships name the model whose build
// says which objects there are, and where; an object is a mesh, or components: others, at places.

namespace sphparam {
namespace {

constexpr std::string_view relationships = "_rels/.rels";
constexpr std::string_view usual_model = "3D/3dmodel.model";
constexpr std::string_view volumes_of_prusa = "Metadata/Slic3r_PE_model.config";
constexpr int deepest = 64;           // of components within components
constexpr int most_placed = 100'000;  // of objects and components

/// Finds the target of the relationship to the model.
class RelationshipReader final : public XmlEvents {
 public:
  bool start(std::string_view, const XmlAttributes& attributes, long) override {
    if (!attributes.value("Type").ends_with("/3dmodel")) return false;
    target = attributes.value("Target");
    return true;
  }
  void text(std::string_view) override {}
  void end(std::string_view) override {}

  std::string target{usual_model};
};

/// First the one, then the other.
ThreeMfPlace then(const ThreeMfPlace& inner, const ThreeMfPlace& outer) {
  ThreeMfPlace both = inner * outer.topRows<3>();
  both.row(3) += outer.row(3);
  return both;
}

class ThreeMfReader {
 public:
  ThreeMfReader(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : archive_(bytes, name), name_(name), options_(options) {}

  MeshFile read() {
    const std::string root = root_path();
    const ThreeMfModel& model = part(root);
    if (model.build.empty()) throw ReadError(name_, "its build holds no item: nothing is placed");
    for (const ThreeMfPart& item : model.build) {
      names_.push_back(object_of(item, root).name);
      place_part(item, root, ThreeMfPlace::Identity(), 0);
      ++item_;
    }
    file_.format = "3MF";
    surface_.attach_to(file_);
    say_of_model(model);
    say_what_is_left();
    return std::move(file_);
  }

 private:
  std::string root_path() {
    RelationshipReader reader;
    if (archive_.has(relationships))
      read_xml(unpacked(relationships), name_ + "/" + std::string(relationships), reader);
    return reader.target;
  }

  const ThreeMfModel& part(const std::string& path) {
    const auto found = parts_.find(path);
    if (found != parts_.end()) return found->second;
    if (!archive_.has(path)) throw ReadError(name_, "holds no model part " + quoted(path));
    const std::string name =
        name_ + "/" + path.substr(std::min(path.find_first_not_of('/'), path.size()));
    ThreeMfModel model = parse_three_mf_model(unpacked(path), name, options_);
    if (archive_.has(volumes_of_prusa))
      volumes_ += take_out_volumes_of_slicer(model, unpacked(volumes_of_prusa), name_);
    return parts_.emplace(path, std::move(model)).first->second;
  }

  std::string unpacked(std::string_view path) {
    std::string xml = archive_.unpacked(path, bytes_left_);
    bytes_left_ -= xml.size();
    return xml;
  }

  const std::string& path_of(const ThreeMfPart& wanted, const std::string& from) const {
    return wanted.path.empty() ? from : wanted.path;
  }

  const ThreeMfObject& object_of(const ThreeMfPart& wanted, const std::string& from) {
    const auto& objects = part(path_of(wanted, from)).objects;
    const auto found = objects.find(wanted.object);
    if (found != objects.end()) return found->second;
    throw ReadError(name_,
                    "object " + std::to_string(wanted.object) + " is placed, and is not there");
  }

  void place_part(const ThreeMfPart& wanted, const std::string& from, const ThreeMfPlace& outer,
                  int depth) {
    if (depth > deepest || ++placed_ > most_placed)
      throw ReadError(name_, "components lie within one another too deep, or there are more than " +
                                 std::to_string(most_placed));
    const ThreeMfObject& object = object_of(wanted, from);
    if (object.type != "model" && object.type != "surface") {
      ++left_[object.type];
      return;
    }
    const std::string& path = path_of(wanted, from);
    const ThreeMfPlace place = then(wanted.place, outer);
    if (!object.triangles.empty()) surface_.append(object, part(path).groups, place, item_);
    for (const ThreeMfPart& component : object.components)
      place_part(component, path, place, depth + 1);
  }

  void say_of_model(const ThreeMfModel& model) {
    for (const auto& [key, value] : model.metadata)
      if (!value.empty()) file_.comments.push_back(key + " " + one_line(value));
    file_.comments.push_back("unit " + one_line(model.unit));
    if (model.unit != "millimeter")
      file_.notes.push_back("its unit is the " + one_line(model.unit) +
                            ", not the millimetre: lengths stay as they are");
    for (std::size_t i = 0; item_ > 1 && i < names_.size(); ++i)
      if (!names_[i].empty())
        file_.comments.push_back("object " + std::to_string(i) + " " + names_[i]);
  }

  void say_what_is_left() {
    const auto say = [&](std::int64_t count, const char* thing, const std::string& which) {
      if (count > 0) add_loss(file_.notes, counted(count, thing) + " " + which);
    };
    for (const auto& [type, count] : left_) say(count, "object", "of type " + quoted(type));
    say(volumes_, "volume", "of PrusaSlicer (modifiers, negative volumes, places for supports)");
    std::map<std::string, std::int64_t> elements;
    std::int64_t painted = 0;
    for (const auto& [path, model] : parts_) {
      painted += model.painted_in_slicer;
      for (const auto& [element, count] : model.other_elements) elements[element] += count;
    }
    for (const auto& [element, count] : elements) say(count, "element", quoted(element));
    if (painted > 0)
      add_loss(file_.notes, "what a slicer painted on " + counted(painted, "triangle"));
  }

  ZipArchive archive_;
  const std::string& name_;
  const ReadOptions& options_;
  std::uint64_t bytes_left_ = options_.max_file_bytes;  // that parts may unpack to
  std::map<std::string, ThreeMfModel> parts_;
  int placed_ = 0;
  std::int64_t volumes_ = 0;  // of a slicer, that are no part of the model
  int item_ = 0;              // of the build
  ThreeMfSurface surface_{name_, options_};
  std::vector<std::string> names_;            // of items
  std::map<std::string, std::int64_t> left_;  // objects that are no part of the model, by type
  MeshFile file_;
};

}  // namespace

bool looks_like_three_mf(std::string_view bytes) {
  return looks_like_zip(bytes) && bytes.rfind(".model") != std::string_view::npos;
}

MeshFile read_three_mf(std::string_view bytes, const std::string& name,
                       const ReadOptions& options) {
  return ThreeMfReader(bytes, name, options).read();
}

}  // namespace sphparam
