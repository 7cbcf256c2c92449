#include "arguments/declaration.h"

#include <CLI/CLI.hpp>
#include <cstdint>

#include "arguments/limits.h"
#include "console/places.h"

namespace sphparam::cli {
namespace {

std::string no_such_direction(const std::string& text) {
  return "expected x, -x, y, -y, z, -z, auto or a direction as in 0,-0.6,0.8, not " + text;
}

/// Why what is up and what is in front do not go together; empty: they do.
std::string clash_of(const Up& up) try {
  upright_axes({}, up);
  return "";
} catch (const FrontError& error) {
  return error.what();
}

/// Of the value of an option: an empty one, of a variable that is not set, say, would be as if the
/// option were not there.
std::string complaint_of_nothing(const std::string& text) {
  return text.empty() ? "its value is empty: give one, or leave the option out" : "";
}

}  // namespace

Declaration::Declaration(CLI::App& program, const std::string& name, const std::string& summary)
    : app_(program.add_subcommand(name, summary)) {}

Declaration& Declaration::keep(CLI::Option* option, const std::string& word, bool tells_preset) {
  last_ = option->group(group_);
  if (!word.empty()) last_->type_name(word);
  if (tells_preset) last_->capture_default_str();
  return *this;
}

Declaration& Declaration::input(const std::string& name, std::string& path,
                                const std::string& about) {
  return text(name, path, " ", about).required();
}

Declaration& Declaration::output(std::string& path, const std::string& word,
                                 const std::string& about) {
  return text("-o,--output", path, word, about).written().required();
}

Declaration& Declaration::text(const std::string& name, std::string& value, const std::string& word,
                               const std::string& about) {
  const bool tells_preset = !value.empty();
  CLI::Option* option = app_->add_option(name, value, about);
  if (name.starts_with("--")) option->check(CLI::Validator(complaint_of_nothing, ""));
  return keep(option, word, tells_preset);
}

Declaration& Declaration::texts(const std::string& name, Words& values, const std::string& word,
                                const std::string& about) {
  CLI::Option* option = app_->add_option(name, values, about);
  // Else it takes what stands behind its value, the mesh, too.
  const bool is_option = name.starts_with('-');
  return keep(is_option ? option->expected(1)->take_all()->allow_extra_args(false) : option, word);
}

Declaration& Declaration::list(const std::string& name, Words& values, const std::string& word,
                               const std::string& about) {
  return keep(app_->add_option(name, values, about)->delimiter(',')->allow_extra_args(false), word);
}

Declaration& Declaration::flag(const std::string& name, bool& value, const std::string& about) {
  return keep(app_->add_flag(name, value, about), "");
}

Declaration& Declaration::flag_off(const std::string& name, bool& value, const std::string& about) {
  return keep(app_->add_flag_callback(
                  name, [&value] { value = false; }, about),
              "");
}

Declaration& Declaration::flag(const std::string& name, std::string& words,
                               const std::string& about) {
  return keep(app_->add_flag(name, words, about), "");
}

template <class Number>
Declaration& Declaration::number(const std::string& name, Number& value, const std::string& word,
                                 const Range<Number>& range, const std::string& about) {
  const auto check = [range](const std::string& text) { return complaint_of_number(text, range); };
  CLI::Option* option = app_->add_option(name, value, about)->check(CLI::Validator(check, ""));
  return keep(option, word, range.holds(value));
}
template Declaration& Declaration::number(const std::string&, int&, const std::string&,
                                          const Range<int>&, const std::string&);
template Declaration& Declaration::number(const std::string&, std::int64_t&, const std::string&,
                                          const Range<std::int64_t>&, const std::string&);
template Declaration& Declaration::number(const std::string&, std::uint64_t&, const std::string&,
                                          const Range<std::uint64_t>&, const std::string&);
template Declaration& Declaration::number(const std::string&, double&, const std::string&,
                                          const Range<double>&, const std::string&);

Declaration& Declaration::number(const std::string& name, std::optional<int>& value,
                                 const std::string& word, const Range<int>& range,
                                 const std::string& about) {
  const auto check = [range](const std::string& text) { return complaint_of_number(text, range); };
  return keep(app_->add_option(name, value, about)->check(CLI::Validator(check, "")), word);
}

Declaration& Declaration::word(const std::string& name, const Words& words,
                               const std::function<void(std::size_t)>& choose,
                               const std::string& about) {
  const auto take = [=](const std::string& typed) {
    for (std::size_t i = 0; i < words.size(); ++i)
      if (typed == words[i]) return choose(i);
    throw CLI::ValidationError(name, no_such_word(typed, words));
  };
  return keep(app_->add_option_function<std::string>(name, take, about), joined(words, "|"));
}

Declaration& Declaration::parsed(const std::string& name, const std::string& word,
                                 const std::function<bool(const std::string&)>& read,
                                 const std::string& complaint, const std::string& about) {
  const auto take = [=](const std::string& text) {
    if (read(text)) return;
    throw CLI::ValidationError(name, complaint + (complaint.ends_with("not ") ? text : ""));
  };
  return keep(app_->add_option_function<std::string>(name, take, about), word);
}

Declaration& Declaration::sphere(std::string& path) {
  return text("--sphere", path, "FILE", "The map of the mesh, in a file of its own");
}

Declaration& Declaration::data(Words& files) {
  return texts("--data", files, "FILE,…",
               "Numbers a vertex of the mesh, in files of their own: .shape.gii, .func.gii, "
               ".label.gii, .annot, .label, .mgh, .mgz, lh.thickness …; may be given again");
}

Declaration& Declaration::up(Up& up) {
  const auto direction = [this](const std::string& name, std::optional<Vector3>& value,
                                const Up& both, const std::string& about) {
    const auto take = [=, &value, &both](const std::string& text) {
      value = direction_named(text);
      if (!value && text != "auto") throw CLI::ValidationError(name, no_such_direction(text));
      const std::string clash = both.direction ? clash_of(both) : "";
      if (!clash.empty()) throw CLI::ValidationError("--front", clash);
    };
    keep(app_->add_option_function<std::string>(name, take, about), "auto|x|-x|y|-y|z|-z|X,Y,Z");
  };
  direction("--up", up.direction, up,
            "What points up in the mesh's file (default: what the file says: y where it "
            "comes from glTF; else z)");
  direction("--front", up.front, up,
            "What looks at who sees it (default: what the file says; else -y, z with y "
            "up)");
  return *this;
}

Declaration& Declaration::convention(Convention& convention) {
  std::vector<std::pair<std::string, Convention>> conventions;
  for (const ConventionInfo& info : all_conventions())
    conventions.emplace_back(info.name, info.convention);
  return choice("--convention", convention, conventions,
                "Where longitude goes in the image (default: sphparam)");
}

Declaration& Declaration::crease(double& degrees) {
  return number(
      "--crease", degrees, "DEGREES", {0, 180},
      "Where the mesh has no normals, edges that turn by more are hard (default: none is)");
}

Declaration& Declaration::source_normals(bool& down) {
  return choice("--source-normal-y", down, {{"gl", false}, {"dx", true}},
                "Where green points in the normal maps that the mesh comes with: up or down the "
                "image, as DirectX has it (default: gl)");
}

Declaration& Declaration::refine_poles(int& wedges, const std::string& about) {
  return number("--refine-poles", wedges, "N", {1, 1024}, about);
}

Declaration& Declaration::json(CommonArguments& arguments, const std::string& what) {
  return text("--json", arguments.json, "FILE", what + "; - for standard output").written();
}

Declaration& Declaration::threads(CommonArguments& arguments) {
  return number("--threads", arguments.threads, "N", {0, 4096},
                "How many threads (0: all cores); same bytes");
}

Declaration& Declaration::console(CommonArguments& arguments) {
  choice(
      "--progress", arguments.progress,
      {{"auto", ProgressStyle::Auto}, {"none", ProgressStyle::None}, {"json", ProgressStyle::Json}},
      "How far it is; auto: on a terminal (default: auto)");
  flag("-q,--quiet", arguments.quiet, "Errors only");
  flag("-v,--verbose", arguments.verbose, "Every stage");
  flag("--fail-on-warnings", arguments.strict,
       "Exit with status 6 where something is warned of or lost; outputs are written");
  declare_limits(*this);
  return *this;
}

Declaration& Declaration::written() {
  mark_written(*last_);
  return *this;
}

Declaration& Declaration::required() {
  last_->required();
  return *this;
}

Declaration& Declaration::multiple_of(int factor) {
  const auto check = [factor](const std::string& text) {
    return std::stoi(text) % factor == 0 ? "" : "expected a multiple of " + std::to_string(factor);
  };
  last_->check(CLI::Validator(check, ""));
  return *this;
}

Declaration& Declaration::preset(const std::string& value) {
  last_->default_str(value);
  return *this;
}

Declaration& Declaration::group(const std::string& heading) {
  group_ = heading;
  return *this;
}

std::function<bool(const std::string&)> Declaration::given() const {
  return [app = app_](const std::string& name) { return app->count(name) > 0; };
}

bool read_number(const std::string& text, double& value) {
  return CLI::detail::lexical_cast(text, value);
}

}  // namespace sphparam::cli
