// `sphparam survey`: which meshes of a folder map, which after repair, which not and why.

#include "sphparam/survey/survey.h"

#include <filesystem>

#include "arguments/limits.h"
#include "commands/command.h"
#include "console/places.h"
#include "sphparam/batch/run.h"
#include "survey/mesh_files.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Try every mesh of a folder: what maps, what after repair, what not and why.\n"
    "\n"
    "Examples:\n"
    "  sphparam survey scans/ -o survey.html\n"
    "  sphparam survey scans/ -o survey.html --json survey.json --size 640\n"
    "  mkdir found && sphparam survey scans/ -o survey.html --records found/\n"
    "  sphparam survey scans/ -o survey.html --max-seconds 60 --size 0\n"
    "\n"
    "The exit status is 0 when all map, be it after --repair, and 4 when one does not or asks for\n"
    "more; the page is written all the same.\n";

struct SurveyArguments : CommonArguments {
  std::string folder, output, records;
  int size = SurveyOptions{}.picture_size;
  double longest = 0;
};

void require_sensible(const SurveyArguments& arguments) {
  const std::string extension = extension_of(arguments.output);
  if (!is_stream(arguments.output) && extension != ".html" && extension != ".htm")
    throw UsageMistake("-o: a page is written as .html, not as " + output_name(arguments.output));
  if (arguments.size > 0 && arguments.size < 16)
    throw UsageMistake("--size: 0, or 16 to 4096 pixels");
  std::vector<std::string> meshes = mesh_files(arguments.folder);
  for (std::string& mesh : meshes) mesh = (std::filesystem::path(arguments.folder) / mesh).string();
  note_files_read(meshes);
  check_places({{"-o", arguments.output}, {"--json", arguments.json}});
}

Survey surveyed(const SurveyArguments& arguments, Session& session) {
  return survey_folder(arguments.folder, {.picture_size = arguments.size,
                                          .read = input_limits(),
                                          .isolated = true,
                                          .longest = arguments.longest,
                                          .records = arguments.records,
                                          .threads = session.threads(),
                                          .progress = session.progress()});
}

std::string line_of(const Survey& survey) {
  const auto all = static_cast<long>(survey.meshes.size());
  const long whole = survey.count(SurveyEnd::Maps), mended = survey.count(SurveyEnd::MapsMended),
             asked = survey.count(SurveyEnd::MapsIfAsked),
             stopped = survey.count(SurveyEnd::Stopped);
  return survey.folder + ": of " + std::to_string(all) + " " + std::to_string(whole) +
         " map as they are, " + std::to_string(mended) + " after --repair, " +
         std::to_string(asked) + " if asked for more, " +
         std::to_string(all - whole - mended - asked - stopped) + " do not" +
         (stopped > 0 ? ", " + std::to_string(stopped) + " were stopped: the page says why" : "");
}

int run_survey(SurveyArguments& arguments) try {
  require_sensible(arguments);
  Session session(arguments);
  session.hold_signals();
  const Survey survey = surveyed(arguments, session);
  session.console.clear_progress();
  session.files.add(arguments.output, survey_page(survey));
  session.add_report([&] { return to_json(survey, session.stopwatch.seconds()); });
  session.publish();
  const std::string line = line_of(survey);
  session.console.say(line + " → " + output_name(arguments.output));
  const long unasked = survey.count(SurveyEnd::Maps) + survey.count(SurveyEnd::MapsMended);
  if (unasked == static_cast<long>(survey.meshes.size())) return Ok;
  if (arguments.quiet) print_error(line);
  return MeshUnusable;
} catch (const BatchMachineError& error) {
  print_error(error.what());
  return FileError;
}

void declare_options(Declaration& command, SurveyArguments& arguments) {
  command.text("FOLDER", arguments.folder, " ", "Meshes are looked for in it and in its folders")
      .required()
      .output(arguments.output, "PAGE.html", "The page; - for standard output")
      .text("--records", arguments.records, "FOLDER",
            "What is found of a file is written to this folder, and taken from it if it is there")
      .written()
      .number("--max-seconds", arguments.longest, "N", {0, 1e9},
              "A file that takes longer is stopped; 0: as long as it takes")
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
