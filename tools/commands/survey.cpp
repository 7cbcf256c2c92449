// `sphparam survey`: which meshes of a folder map, which after repair, which not and why.

#include "sphparam/survey/survey.h"

#include "arguments/limits.h"
#include "commands/command.h"
#include "console/places.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Try every mesh of a folder: what maps, what after repair, what not and why.\n"
    "\n"
    "Examples:\n"
    "  sphparam survey scans/ -o survey.html\n"
    "  sphparam survey scans/ -o survey.html --json survey.json --size 640\n"
    "  sphparam survey scans/ -o survey.html --size 0   without pictures\n"
    "\n"
    "The exit status is 0 when all map, be it after --repair, and 4 when one does not; the page "
    "is\n"
    "written all the same.\n";

struct SurveyArguments : CommonArguments {
  std::string folder, output;
  int size = SurveyOptions{}.picture_size;
};

void require_sensible(const SurveyArguments& arguments) {
  const std::string extension = extension_of(arguments.output);
  if (!is_stream(arguments.output) && extension != ".html" && extension != ".htm")
    throw UsageMistake("-o: a page is written as .html, not as " + output_name(arguments.output));
  if (arguments.size > 0 && arguments.size < 16)
    throw UsageMistake("--size: 0, or 16 to 4096 pixels");
  check_places({{"-o", arguments.output}, {"--json", arguments.json}});
}

int run_survey(SurveyArguments& arguments) {
  require_sensible(arguments);
  Session session(arguments);
  session.hold_signals();
  const Survey survey = survey_folder(arguments.folder, {.picture_size = arguments.size,
                                                         .read = input_limits(),
                                                         .threads = session.threads(),
                                                         .progress = session.progress()});
  session.console.clear_progress();
  session.files.add(arguments.output, survey_page(survey));
  session.add_report([&] { return to_json(survey, session.stopwatch.seconds()); });
  session.publish();
  const long all = static_cast<long>(survey.meshes.size());
  const long whole = survey.count(SurveyEnd::Maps), mended = survey.count(SurveyEnd::MapsMended);
  const std::string line = arguments.folder + ": " + std::to_string(whole) + " of " +
                           std::to_string(all) + " map as they are, " + std::to_string(mended) +
                           " after --repair, " + std::to_string(all - whole - mended) + " do not";
  session.console.say(line + " → " + output_name(arguments.output));
  if (whole + mended == all) return Ok;
  if (arguments.quiet) print_error(line);
  return MeshUnusable;
}

void declare_options(Declaration& command, SurveyArguments& arguments) {
  command.text("FOLDER", arguments.folder, " ", "Meshes are looked for in it and in its folders")
      .required()
      .output(arguments.output, "PAGE.html", "The page; - for standard output")
      .number("--size", arguments.size, "N", {0, 4096},
              "Pixels of a picture, 16 to 4096; 0: no pictures")
      .json(arguments)
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_survey(CLI::App& program) {
  return make_command(program, "survey", summary, declare_options, run_survey);
}

}  // namespace sphparam::cli
