// `sphparam verify`: proves a written map again, ours or a peer's.

#include "arguments/limits.h"
#include "commands/command.h"
#include "console/places.h"
#include "sphparam/records/verification_record.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Prove a written map again, ours or anybody's.\n"
    "\n"
    "Examples:\n"
    "  sphparam verify statue.sph.ply                 a map with sx sy sz, as `map` writes it\n"
    "  sphparam verify sphere.obj                     a bare sphere about the origin\n"
    "  sphparam verify statue.obj sphere.obj --json -   a mesh and its sphere, with figures\n"
    "  sphparam verify statue.glb                     what `export --theta-phi` wrote\n"
    "  sphparam verify statue.sph.ply --chart         the texture chart too\n"
    "\n"
    "The exit status is 0 when the map (and with --chart its chart) is one-to-one, 5 when it is\n"
    "not or theta and phi are not those of sx sy sz, and 3 when the two files are not of one\n"
    "connectivity: the same vertices in every triangle.\n";

struct VerifyArguments : CommonArguments {
  std::string file;
  std::string sphere;  // empty: the map is in `file`
  bool chart = false;
};

int run_verify(VerifyArguments& arguments) {
  Session session(arguments);
  require_report_place(arguments.json);
  session.console.progress("certificate", 0);
  const VerifiedMap map = verify_map(
      arguments.file,
      {.sphere = arguments.sphere, .read = input_limits(), .threads = arguments.threads});
  for (const std::string& note : map.notes) session.console.say("  note: " + note);
  const Words warnings = warnings_of(map);
  session.warn(warnings);
  VerificationRecord record = {.file = arguments.file,
                               .map = map,
                               .chart_wanted = arguments.chart,
                               .sphere = arguments.sphere};
  if (arguments.chart && map.certificate.bijective())
    record.chart = report_chart(map.mesh, map.map, arguments.threads);
  record.seconds = session.stopwatch.seconds();
  session.console.clear_progress();
  session.add_report([&] { return to_json(record); });
  const std::string text = to_text(record);
  if (!is_stream(arguments.json) && !arguments.quiet) session.files.add("-", text);
  session.publish();
  const bool chart_holds =
      !arguments.chart || (record.chart && record.chart->certificate.one_to_one());
  if (map.holds() && chart_holds) return Ok;
  if (arguments.quiet) {
    print_error(text.substr(0, text.size() - 1));
    if (!map.holds())
      for (const std::string& warning : warnings) print_error(warning);
  }
  return NotCertified;
}

void declare_options(Declaration& command, VerifyArguments& arguments) {
  command.input("FILE", arguments.file, "A written map, a sphere or a mesh; - for stdin")
      .text("SPHERE", arguments.sphere, " ", "The sphere of mesh FILE, same connectivity")
      .flag("--chart", arguments.chart, "Make the (u, v) chart for textures too, and prove it")
      .json(arguments)
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_verify(CLI::App& program) {
  return make_command(program, "verify", summary, declare_options, run_verify);
}

}  // namespace sphparam::cli
