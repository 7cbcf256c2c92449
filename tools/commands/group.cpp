// `sphparam group`: shapes in correspondence: their mean, how they vary, how far they are apart.

#include "sphparam/group/group.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "arguments/energy_words.h"
#include "commands/command.h"
#include "commands/sources.h"
#include "console/console.h"
#include "console/new_folder.h"
#include "console/places.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "reports/snapped_wording.h"
#include "reports/told_losses.h"
#include "sphparam/batch/inputs.h"
#include "sphparam/group/template_landmarks.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/records/group_files.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Bring shapes into correspondence: their mean, modes, distances, and a page.\n"
    "\n"
    "Examples:\n"
    "  sphparam group maps/*.sph.ply -o group/\n"
    "  sphparam group people/*.off --template people/rest.off -o people_group/\n"
    "  sphparam group hippocampi/*.sph.ply --start ellipsoid --hold --scale -o h/\n"
    "  sphparam group maps/*.sph.ply --landmarks template.txt -o group/\n"
    "\n"
    "Each shape's map is moved until the way from it to the template, and then to the mean of "
    "all,\n"
    "distorts least. All are resampled on one grid, moved and turned onto their mean "
    "(Procrustes),\n"
    "and their principal modes found. Every map is proved one-to-one.\n";

struct GroupArguments : CommonArguments {
  Words inputs;
  std::string folder, reference, landmarks;
  std::string grid = "ico:5";
  Up up;
  RepairArguments repair;  // of all
  int size = GroupFileOptions{}.size;
  GroupOptions options;
};

std::string in_folder(const GroupArguments& arguments, const std::string& name) {
  return (std::filesystem::path(arguments.folder) / name).string();
}

void read_grid(GroupArguments& arguments) try {
  arguments.options.grid.reset();
  if (arguments.grid == "template") return;
  arguments.options.grid = parse_grid(arguments.grid);
  if (has_quads(*arguments.options.grid))
    throw UsageMistake("--grid: " + arguments.grid +
                       " has quads; a group is of triangles: ico:5, ico:f=20, octa:65");
} catch (const std::invalid_argument& error) {
  throw UsageMistake(std::string("--grid: template, or ") + error.what());
}

void require_sensible(GroupArguments& arguments) {
  read_grid(arguments);
  if (arguments.size > 0 && arguments.size < 64)
    throw UsageMistake("--size: 0, or 64 to 4096 pixels");
  std::vector<std::string> read = arguments.inputs;
  read.insert(read.end(), {arguments.reference, arguments.landmarks});
  require_one_stream(read, "the shapes, --template and --landmarks");
}

/// The folder that is there, or whose parent is.
void require_folder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path =
      fs::path(folder).filename().empty() ? fs::path(folder).parent_path() : fs::path(folder);
  if (is_stream(folder)) throw UsageMistake("-o: a group is many files, in a folder");
  if (fs::is_directory(path, error)) return require_writable((path / "group.json").string());
  if (fs::exists(path, error)) throw WriteError(folder, "is no folder");
  require_writable(path.string());
}

/// No shape may be replaced by what is made of it.
void require_other_files(const GroupArguments& arguments) {
  Outputs outputs;
  std::vector<std::string> files{"index.html", "group.json", "mean.sph.ply"};
  for (const std::string& name : names_of_shapes(arguments.inputs))
    for (const char* kind : {"map_", "shape_"}) files.push_back(kind + name + ".sph.ply");
  for (const std::string& file : files) outputs.emplace_back("-o", in_folder(arguments, file));
  check_places(outputs, arguments.folder);
}

struct ReadShape {
  MappedMesh mapped;
  MendedShape mended;
};

/// Where maps stay as they lie, one that is made now lies anyhow: what is at one place of it and of
/// another has nothing to do with each other.
void require_map(const MeshSource& source, const GroupArguments& arguments) {
  const bool is_alone = arguments.inputs.size() == 1 && arguments.reference.empty();
  if (arguments.options.start != GroupStart::Maps || is_alone || read_sphere(source.file)) return;
  const std::string mesh = shell_file(source.path);
  throw UsageMistake("--start maps: " + display_name(source.path) +
                     " has no map, and one that is made now lies in no correspondence: `sphparam "
                     "remesh " +
                     mesh +
                     " --sphere REGISTERED --grid like:REGISTERED -o NAME.sph.ply` gives it that "
                     "of a registered sphere, --start ends or rotation find a way");
}

/// Which file a refusal is about, which tells what is wrong with a mesh.
ReadShape read_shape(const std::string& path, const GroupArguments& arguments,
                     Session& session) try {
  session.hold_signals();
  MeshSource source = read_mended(path, arguments.repair, session);
  require_map(source, arguments);
  if (!arguments.landmarks.empty()) tell_other_numbers(source, session.console);
  tell_replaced(source, session.console);
  MendedShape mended = what_was_mended(source);
  return {map_source(std::move(source), "", session, arguments.repair), std::move(mended)};
} catch (const MeshRefusal&) {
  print_error(display_name(path) + " cannot be mapped:");
  throw;
}

/// The template: a file of its own, or one of the shapes.
const std::string& reference_of(const GroupArguments& arguments) {
  return arguments.reference.empty() ? arguments.inputs.front() : arguments.reference;
}

bool is_shape(const std::string& path, const GroupArguments& arguments) {
  return std::ranges::any_of(arguments.inputs,
                             [&](const std::string& shape) { return is_same_place(shape, path); });
}

std::vector<ReadShape> read_shapes(const GroupArguments& arguments, const ReadShape& reference,
                                   Session& session) {
  std::vector<ReadShape> shapes;
  for (const std::string& path : arguments.inputs)
    shapes.push_back(is_same_place(path, reference_of(arguments))
                         ? reference
                         : read_shape(path, arguments, session));
  return shapes;
}

/// A left and a right hemisphere are mirror images of each other, which no map is brought to.
void tell_hemispheres(const GroupArguments& arguments, const MappedMesh& reference,
                      const std::vector<MappedMesh>& shapes, Session& session) {
  if (arguments.options.mirror) return;
  std::map<std::string, std::set<std::string>> sides;
  const auto add = [&](const std::string& path, const MappedMesh& mapped) {
    sides[structure_of(mapped.file(), path)].insert(path);
  };
  add(reference_of(arguments), reference);
  for (std::size_t i = 0; i < shapes.size(); ++i) add(arguments.inputs[i], shapes[i]);
  const auto &left = sides["CortexLeft"], &right = sides["CortexRight"];
  if (left.empty() || right.empty()) return;
  session.warn({counted(std::ssize(left), "surface") + " of CortexLeft (" + *left.begin() +
                (left.size() > 1 ? ", …" : "") + ") and " + std::to_string(right.size()) +
                " of CortexRight (" + *right.begin() + (right.size() > 1 ? ", …" : "") +
                ") in one group: they are mirror images, which it takes for shapes that differ; "
                "--mirror takes those of one side as their mirror images"});
}

std::vector<bool> mapped_now(const std::vector<MappedMesh>& shapes) {
  std::vector<bool> result;
  for (const MappedMesh& shape : shapes) result.push_back(shape.mapped_here());
  return result;
}

/// Whether a group is written in files of such names.
bool is_of_group(const std::string& name) {
  const auto is = [&](const char* begin, const char* end) {
    return name.starts_with(begin) && name.ends_with(end);
  };
  return is("map_", ".sph.ply") || is("shape_", ".sph.ply") || is("mode", ".glb") ||
         name == "landmarks.tsv";
}

/// Files in the folder that look as if they were of this group, and are not.
void tell_stale(const GroupArguments& arguments, const Words& written, Session& session) {
  namespace fs = std::filesystem;
  constexpr size_t most_names = 8;
  std::error_code error;
  const auto place = [&](const fs::path& path) { return fs::weakly_canonical(path, error); };
  std::set<fs::path> known{place(arguments.reference)};  // what is read is no remainder
  for (const std::string& path : arguments.inputs) known.insert(place(path));
  for (const std::string& name : written) known.insert(place(in_folder(arguments, name)));
  Words stale;
  for (const auto& entry : fs::directory_iterator(arguments.folder, error)) {
    const std::string name = entry.path().filename().string();
    if (is_of_group(name) && !known.contains(place(entry.path()))) stale.push_back(name);
  }
  if (stale.empty()) return;
  std::ranges::sort(stale);
  const std::string are = stale.size() == 1 ? " is" : " are";
  if (stale.size() > most_names) {
    const auto others = static_cast<long>(stale.size() - most_names);
    stale.resize(most_names);
    stale.push_back(counted(others, "other"));
  }
  session.console.warning(arguments.folder + ": " + joined(stale) + are +
                          " of an earlier run, and not of this group");
}

/// Patterns that no shell expanded, and lists and tables, as batch reads them; meshes as they are.
Words meshes_in(const Words& places) try {
  Words meshes;
  for (const std::string& place : places) {
    const std::string kind = extension_of(place);
    const bool is_list = kind == ".txt" || kind == ".csv" || kind == ".tsv";
    const bool is_pattern = place.find_first_of("*?[") != std::string::npos;
    std::error_code error;
    if (is_list || (is_pattern && !std::filesystem::exists(place, error))) {
      for (const BatchInput& shape : find_batch_inputs({place}).shapes)
        meshes.push_back(shape.path);
    } else {
      meshes.push_back(place);
    }
  }
  return meshes;
} catch (const BatchInputError& error) {
  throw UsageMistake(error.what());
}

/// Refuses before any work what cannot become a group.
void require_group(GroupArguments& arguments) {
  arguments.inputs = meshes_in(arguments.inputs);
  require_sensible(arguments);
  require_folder(arguments.folder);
  require_other_files(arguments);
  require_there(arguments.inputs);
  require_there({arguments.reference, arguments.landmarks});
}

/// The shapes in their order, with what was mended of each.
struct ReadGroup {
  ReadShape reference;
  std::vector<TemplateLandmark> landmarks = {};
  std::vector<MappedMesh> shapes = {};
  std::vector<MendedShape> mended = {};
};

ReadGroup read_group(const GroupArguments& arguments, Session& session) {
  ReadGroup read{.reference = read_shape(reference_of(arguments), arguments, session)};
  const MappedMesh& reference = read.reference.mapped;
  if (!arguments.landmarks.empty()) {  // before all others: a slip should not cost hours
    TemplateLandmarks found = read_template_landmarks(arguments.landmarks, reference.file());
    tell_snapped(arguments.landmarks, found.snapped, session);
    read.landmarks = std::move(found.landmarks);
  }
  for (ReadShape& shape : read_shapes(arguments, read.reference, session)) {
    read.shapes.push_back(std::move(shape.mapped));
    read.mended.push_back(std::move(shape.mended));
  }
  tell_hemispheres(arguments, reference, read.shapes, session);
  return read;
}

GroupRecord record_of(const GroupArguments& arguments, const ReadGroup& read, const Group& group,
                      const GroupOptions& options) {
  GroupRecord record{.group = group,
                     .options = options,
                     .files = arguments.inputs,
                     .names = names_of_shapes(arguments.inputs),
                     .mapped_now = mapped_now(read.shapes),
                     .reference = reference_of(arguments),
                     .landmarks = read.landmarks,
                     .mended = read.mended,
                     .reference_mended = {}};
  if (!is_shape(record.reference, arguments)) record.reference_mended = read.reference.mended;
  return record;
}

/// Makes the folder; what goes into it waits in the session.
void add_files(const GroupArguments& arguments, GroupRecord& record, NewFolder& folder,
               Session& session) {
  folder.make();
  record.outputs = add_group(session.files, arguments.folder, record,
                             {.up = arguments.up,
                              .size = arguments.size,
                              .threads = session.threads(),
                              .progress = session.progress()});
  session.files.add(in_folder(arguments, "group.json"), to_json(record));
}

int run_group(GroupArguments& arguments) {
  require_group(arguments);
  NewFolder folder(arguments.folder);
  Session session(arguments);
  const ReadGroup read = read_group(arguments, session);
  GroupOptions options = arguments.options;
  options.threads = session.threads();
  options.progress = session.progress();
  const Group group = make_group(read.shapes, read.reference.mapped, options);
  GroupRecord record = record_of(arguments, read, group, options);
  session.warn(group_warnings(record));
  record.seconds = session.stopwatch.seconds();
  add_files(arguments, record, folder, session);
  session.publish();
  session.console.say(to_text(record));
  for (const std::string& line : mode_lines(record)) session.console.say("  " + line);
  tell_stale(arguments, record.outputs, session);
  session.console.say("→ " + in_folder(arguments, "index.html"));
  return Ok;
}

void declare_options(Declaration& command, GroupArguments& arguments) {
  command
      .texts("SHAPES", arguments.inputs, " ",
             "A .sph.ply each, or any meshes: mapped first; or a quoted pattern, or a list (.txt, "
             ".csv, .tsv), as batch takes them")
      .required()
      .output(arguments.folder, "FOLDER", "Where all files go; it is made where it is not there")
      .text("--template", arguments.reference, "FILE",
            "What all shapes are brought to first; it may be one of them (default: the first)")
      .choice(
          "--start", arguments.options.start,
          {{"ends", GroupStart::Ends},
           {"rotation", GroupStart::Rotation},
           {"ellipsoid", GroupStart::Ellipsoid},
           {"maps", GroupStart::Maps}},
          "Where the way to the template begins: ends paired, else as rotation; maps turned until "
          "they look alike; first-order ellipsoids turned alike; maps as they lie (default: "
          "ends)")
      .flag("--alike", arguments.options.alike,
            "The shapes lie alike in space: ends and rotations are also judged by where places are")
      .flag("--mirror", arguments.options.mirror,
            "Shapes may be mirror images, as right hands among left ones: each is taken as its own "
            "mirror image where that fits the template clearly better, which is told")
      .flag("--hold", arguments.options.hold,
            "Maps are only turned, or stay: no distortion is minimised")
      .number("--rounds", arguments.options.rounds, "N", {0, 20},
              "So often all are brought to their mean after the template")
      .text("--grid", arguments.grid, "GRID",
            "Of triangles, on which shapes are resampled; template: its own triangles")
      .flag("--scale", arguments.options.scale, "Bring all shapes to one size")
      .number("--modes", arguments.options.modes, "N", {0, 100}, "At most so many are kept")
      .text(
          "--landmarks", arguments.landmarks, "FILE",
          "Vertices of the template, or points, one a line and a name after it, to be found on all "
          "shapes")
      .choice("--energy", arguments.options.energy.kind, energy_words,
              "What is minimised, as of match (default: symmetric-dirichlet)")
      .up(arguments.up)
      .number("--size", arguments.size, "N", {0, 4096},
              "Pixels of a picture, 64 to 4096; 0: no pictures");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_group(CLI::App& program) {
  return make_command(program, "group", summary, declare_options, run_group);
}

}  // namespace sphparam::cli
