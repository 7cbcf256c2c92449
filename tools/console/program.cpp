// The program: declares the subcommands, parses the command line, runs the one that was asked for,
// and turns whatever goes wrong into a message and an exit code.

#include "console/program.h"

#include <sys/resource.h>
#include <unistd.h>
#if __has_include(<execinfo.h>)
#include <execinfo.h>
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "arguments/leading_options.h"
#include "arguments/limits.h"
#include "arguments/words.h"
#include "commands/command.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/help.h"
#include "console/interruption.h"
#include "console/mending_advice.h"
#include "console/mistakes.h"
#include "console/places.h"
#include "image/image_codec.h"
#include "io/files/temporary_file.h"
#include "sphparam/errors.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/no_room_error.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/records/inspection_record.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam::cli {

namespace {

/// Where --json of this subcommand goes; empty: nowhere.
std::string report_of(const CLI::App& command) {
  const CLI::Option* const json = command.get_option_no_throw("--json");
  return json && json->count() > 0 ? json->as<std::string>() : "";
}

/// What --json tells of an error that is about a mesh; nothing for others.
std::optional<RefusalRecord> refusal_of(const std::exception& error, const std::string& command) {
  RefusalRecord record{.command = command, .file = {}, .message = error.what()};
  if (const auto* const of_mesh = dynamic_cast<const MeshError*>(&error)) {
    record.defects = of_mesh->defects();
    record.code = MeshUnusable;
  }
  if (const auto* const of_file = dynamic_cast<const MeshRefusal*>(&error)) {
    record.file = of_file->path();
    record.repairs = of_file->done();
  }
  if (dynamic_cast<const UnmeasurableMesh*>(&error) ||
      dynamic_cast<const std::range_error*>(&error))
    record.code = MeshUnusable;
  if (dynamic_cast<const NotCertifiedError*>(&error)) record.code = NotCertified;
  if (record.code == 0) return std::nullopt;
  return record;
}

/// Where nothing comes of a mesh, --json says why.
int run_reported(const Command& command) try {
  return command.run();
} catch (const std::exception& error) {
  const std::string path = report_of(*command.options);
  const auto record = path.empty() ? std::nullopt : refusal_of(error, command.options->get_name());
  if (record) try {
      write_file(path, to_json(*record));
    } catch (const WriteError& unwritten) {
      print_error(unwritten.what());
    }
  throw;
}

int usage_error(const CLI::App& program, const std::string& message) {
  std::string name = "sphparam";
  for (const CLI::App* app = &program; !app->get_subcommands().empty();) {
    app = app->get_subcommands().front();
    name += " " + app->get_name();
  }
  print_error(message);
  std::fprintf(stderr, "Try '%s --help'.\n", name.c_str());
  return UsageError;
}

/// All subcommands, as they are declared.
struct Program {
  CLI::App app{program_summary, "sphparam"};
  std::vector<Command> commands;

  Program() {
    shape_help(app);
    app.set_version_flag("--version", std::string("sphparam ") + version);
    app.require_subcommand(0, 1);
    for (const auto declare :
         {declare_asset, declare_info, declare_map, declare_repair, declare_wrap, declare_survey,
          declare_verify, declare_render, declare_compare, declare_spharm, declare_remesh,
          declare_unimage, declare_match, declare_group, declare_measure, declare_paint,
          declare_report, declare_export, declare_bake}) {
      commands.push_back(declare(app));
    }
    for (Command& command : declare_batch(app)) commands.push_back(std::move(command));
    for (const auto declare : {declare_manual, declare_completion})
      commands.push_back(declare(app));
  }

  /// Null: none.
  const Command* asked_for() const {
    for (const Command& command : commands)
      if (command.options->parsed()) return &command;
    return nullptr;
  }
};

/// Null: there is none.
const CLI::App* subcommand_named(const CLI::App& program, const std::string& name) {
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->get_name() == name) return command;
  return nullptr;
}

/// Throws: UsageMistake where the words that help is wanted of are no subcommand, or none of it.
void require_subcommands(const CLI::App& program, std::span<char* const> words) {
  const CLI::App* command = &program;
  std::string typed;
  for (const char* const word : words) {
    if (word[0] == '-') return;
    const CLI::App* const next = subcommand_named(*command, word);
    const Words known = command_names(*command);
    if (!next && typed.empty())
      throw UsageMistake(std::string("unknown subcommand ") + word + did_you_mean(word, known));
    if (!next)
      throw UsageMistake(typed.substr(1) + " has no subcommand " + word +
                         (known.empty() ? ": sphparam help" + typed + " tells all of it"
                                        : "; it has " + joined(known)));
    typed += std::string(" ") + word;
    command = next;
  }
}

/// `sphparam FILE` is `sphparam asset FILE`, `sphparam help WORDS` is `sphparam WORDS --help`.
/// Throws: UsageMistake where help is wanted of no subcommand.
std::vector<char*> with_subcommand(const CLI::App& program, int argc, char** argv) {
  static char asset[] = "asset", help[] = "--help";
  std::vector<char*> words(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    require_subcommands(program, std::span(words).subspan(2));
    words.erase(words.begin() + 1);
    words.insert(words.end(), {help, nullptr});
    return words;
  }
  const bool is_word = argc > 1 && argv[1][0] != '-' && !subcommand_named(program, argv[1]);
  const bool is_file =
      argc > 1 &&
      (is_stream(argv[1]) || (is_word && (is_mesh_name(argv[1]) || ::access(argv[1], F_OK) == 0)));
  if (is_file) words.insert(words.begin() + 1, asset);
  words.push_back(nullptr);
  return words;
}

/// What was asked for goes the way of all outputs: who cannot be told hears so.
int tell(const CLI::App& app, const CLI::Success& help_or_version) {
  std::ostringstream text;
  const int code = app.exit(help_or_version, text, text);
  write_file("-", text.str());
  return code;
}

int run_program(int argc, char** argv) {
  Program program;
  try {
    put_subcommand_first(argc, argv);
    std::vector<char*> words = with_subcommand(program.app, argc, argv);
    argc = static_cast<int>(words.size()) - 1;
    argv = words.data();
    take_steps(argc, argv);
    program.app.parse(argc, argv);
    if (const Command* const command = program.asked_for()) {
      note_files_read(*command->options);
      return run_reported(*command);
    }
  } catch (const CLI::Success& help_or_version) {
    return tell(program.app, help_or_version);
  } catch (const CLI::ParseError& error) {
    return usage_error(program.app, explain(program.app, error));
  } catch (const UsageMistake& mistake) {
    return usage_error(program.app, mistake.what());
  } catch (const FrontError& error) {  // of what the file says is up
    return usage_error(program.app,
                       std::string("--front: ") + error.what() + "; choose another one, or --up");
  }
  std::fprintf(stderr, "%s\nMore: sphparam --help\n", program_summary);
  return UsageError;
}

/// A crash must not leave gigabytes of core dump where a batch runs.
void forbid_core_dumps() {
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

/// The C library loads what exceptions need to pass through its own functions when the first one
/// comes by, and aborts where there is no memory for that: it loads it now.
void load_unwinder() {
#if __has_include(<execinfo.h>)
  void* frame = nullptr;
  backtrace(&frame, 1);
#endif
}

constexpr char no_threads[] =
    "sphparam: error: the system has no room for more threads or processes\n";

bool has_no_threads(const std::system_error& error) {
  return error.code() == std::errc::resource_unavailable_try_again;
}

/// Where an exception can go no further: memory that runs out in a destructor, which happens in the
/// libraries for JSON and for options; threads that a library for images cannot start.
[[noreturn]] void end_at_once() {
  const char* message = "sphparam: error: internal error\n";
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    message = out_of_memory_message();
  } catch (const std::system_error& error) {
    if (has_no_threads(error)) message = no_threads;
  } catch (...) {
  }
  std::fputs(message, stderr);
  remove_temporaries_on_signal();
  _exit(InternalError);
}

int told(const std::exception& error, ExitCode code) {
  print_error(error.what());
  return code;
}

/// `file`: its name and a colon, where it is known. After repairs, what is wrong is that of the
/// mesh as they left it.
int mesh_error(const MeshError& error, const std::string& file, const std::string& advice,
               bool repaired = false) {
  const char* const when = repaired ? "after the repairs told last " : "";
  print_error(file + when + "this is not a closed genus-0 mesh:");
  std::fputs((defect_list(error.defects()) + advice).c_str(), stderr);
  return MeshUnusable;
}

/// `no_room`: what a file that the machine has no room for is answered with.
int guarded_main(int argc, char** argv, int no_room) {
  try {
    return run_program(argc, argv);
  } catch (const MeshRefusal& error) {
    const std::string advice = advice_for({argv + 1, argv + argc}, error);
    return mesh_error(error, display_name(error.path()) + ": ", advice, !error.done().empty());
  } catch (const MeshError& error) {
    return mesh_error(error, "", "");
  } catch (const UnmeasurableMesh& error) {
    return told(error, MeshUnusable);
  } catch (const std::range_error& error) {  // what numbers of the file that is wanted cannot hold
    return told(error, MeshUnusable);
  } catch (const NotCertifiedError& error) {
    return told(error, NotCertified);
  } catch (const ReadError& error) {
    print_error(told_refusal({argv + 1, argv + argc}, error.what()));
    return FileError;
  } catch (const ImageError& error) {
    return told(error, FileError);
  } catch (const NoRoomError& error) {
    told(error, FileError);
    return no_room;
  } catch (const WriteError& error) {
    return told(error, FileError);
  } catch (const Cancelled&) {
    print_error("interrupted");
    return Interrupted;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error& error) {
    if (has_no_threads(error)) end_at_once();
    print_error(std::string("internal error: ") + error.what());
    return InternalError;
  } catch (const std::exception& error) {
    print_error(std::string("internal error: ") + error.what());
    return InternalError;
  }
}

/// The options of a subcommand with what the words say. Throws: UsageMistake.
const CLI::App& asked_by(const std::vector<std::string>& words, Program& program) {
  try {
    program.app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success&) {
    throw UsageMistake(joined(words, " ") + " does nothing but show help");
  } catch (const CLI::ParseError& error) {
    throw UsageMistake(joined(words, " ") + ": " + explain(program.app, error));
  }
  const Command* const command = program.asked_for();
  if (!command) throw UsageMistake("no subcommand in " + joined(words, " "));
  return *command->options;
}

/// The exit code, whatever happens.
int run_to_the_end(int argc, char** argv, int no_room) {
  try {
    return guarded_main(argc, argv, no_room);
  } catch (...) {  // memory ran out, perhaps while another error was being told
    std::fputs(out_of_memory_message(), stderr);
    return InternalError;
  }
}

}  // namespace

int run_command_line(std::vector<std::string> words,
                     const std::vector<std::pair<std::string, std::string>>& presets, int no_room) {
  {
    const Program program;
    const CLI::App* const command = subcommand_named(program.app, words.at(0));
    for (const auto& [option, value] : presets) {
      const bool said = std::ranges::any_of(words, [&](const std::string& word) {
        return word == option || word.starts_with(option + "=");
      });
      if (!said && command && command->get_option_no_throw(option))
        words.insert(words.end(), {option, value});
    }
  }
  words.insert(words.begin(), "sphparam");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return run_to_the_end(static_cast<int>(words.size()), argv.data(), no_room);
}

std::vector<std::string> files_read_by(const std::vector<std::string>& words) {
  Program program;
  return files_read(asked_by(words, program));
}

std::vector<std::string> files_written_by(const std::vector<std::string>& words) {
  Program program;
  return files_written(asked_by(words, program));
}

int run_sphparam(int argc, char** argv) {
  forbid_core_dumps();
  load_unwinder();
  end_on_interruption();
  turn_signals_into_errors();
  std::set_terminate(end_at_once);
  return run_to_the_end(argc, argv, FileError);
}

}  // namespace sphparam::cli
