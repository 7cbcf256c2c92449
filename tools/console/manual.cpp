// What --help says, as roff: the options come from the declarations that parse them, so the manual
// cannot lag behind; only what no option tells is written here.

#include "console/manual.h"

#include <cstdio>
#include <sstream>

#include "console/exit_codes.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

constexpr char description[] = R"(.SH DESCRIPTION
Every closed triangle surface without handles, however dented or long of limb, can be laid onto the
unit sphere so that each point has exactly one image.
.B sphparam
finds such a map with little distortion of angles and areas, and proves with exact arithmetic that
what it wrote is one-to-one: every triangle is positively oriented, and the sphere is covered once.
.PP
Longitude theta in [0, 2 pi) and the polar angle phi in [0, pi] from the north pole +z are in
radians: x = cos theta sin phi, y = sin theta sin phi, z = cos phi. Vertices and faces are numbered
from 0, as in the file.
.PP
A file name
.B \-
is standard input or output. Data goes to standard output, messages to standard error. The bytes
written are the same for any number of threads.
)";

constexpr char files[] = R"(.SH FILES
.TP
.I NAME.sph.ply
A map: an ordinary binary PLY of the mesh with double properties sx, sy, sz (the point on the
sphere: what is certified), theta and phi a vertex, and in its header, as comments, how it came
about. Whatever the source carried is kept.
.PP
An output waits under a temporary name in its folder until it is complete and proved; then it is
renamed. Interrupted, killed or out of disk space, the old file or the complete new one is there.
.SH ENVIRONMENT
.TP
.B NO_COLOR
Any value that is not empty: no colours on a terminal.
.TP
.B TERM
.I dumb
means no colours and no progress line.
.TP
.B SPHPARAM_MODULES
A folder where the modules of images and scenes are looked for first.
)";

constexpr char closing[] = R"(.SH STANDARDS
R. Zayer, C. R\[:o]ssl, H.\-P. Seidel:
.I Curvilinear Spherical Parameterization.
Shape Modeling International, 2006.
)";

/// The character of UTF-8 that begins there, beyond ASCII, as roff names it: \[u00D7].
std::string named_character(const std::string& text, size_t& at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text.at(i)); };
  const unsigned char first = byte(at);
  const size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  unsigned code = first & (0x3FU >> more);
  for (size_t i = 0; i < more; ++i) code = code << 6 | (byte(++at) & 0x3FU);
  char name[16];
  std::snprintf(name, sizeof name, "\\[u%04X]", code);
  return name;
}

/// Text that roff takes as it is: a dot or a quote that begins a line would be a command.
std::string roff(const std::string& text) {
  std::string safe;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x80) {
      safe += named_character(text, i);
      continue;
    }
    const bool begins_line = safe.empty() || safe.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\' || c == '-') safe += '\\';
    safe += c == '\\' ? 'e' : c;
  }
  return safe;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// Paragraphs of a help text but its first: examples stand as they are, remarks are filled.
std::string remarks(const std::string& text) {
  std::stringstream lines(text.substr(std::min(text.size(), text.find('\n') + 1)));
  std::string result;
  bool verbatim = false;
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.starts_with("  ");
    if (verbatim != indented) result += indented ? ".EX\n" : ".EE\n";
    verbatim = indented;
    result += line.empty() ? ".PP\n" : roff(line) + "\n";
  }
  return result + (verbatim ? ".EE\n" : "");
}

std::string option_lines(const OptionEntry& option) {
  std::string line = ".TP\n", between;
  for (const std::string& name : option.names) {
    line += between;
    line += option.positional ? italic(name) : bold(name);
    between = ", ";
  }
  if (!option.value.empty()) line.append(" ").append(italic(option.value));
  line.append("\n").append(roff(option.description));
  const bool has_preset = !option.preset.empty() && option.preset != "\"\"";
  if (has_preset) line.append(" (default: ").append(roff(option.preset)).append(")");
  if (option.required && !option.positional) line += "; required";
  return line + ".\n";
}

std::string option_section(const CommandEntry& command) {
  std::string text, group;
  for (const OptionEntry& option : command.options) {
    if (option.group != group && option.group != "Options") {
      text += ".PP\n" + italic(option.group + ":") + "\n";
    }
    group = option.group;
    text += option_lines(option);
  }
  return text;
}

std::string usage(const CommandEntry& command) {
  std::string line = bold("sphparam " + command.name) + " [" + italic("options") + "]";
  for (const OptionEntry& option : command.options) {
    if (!option.positional) continue;
    const std::string name = italic(option.names.front());
    line += option.required ? " " + name : " [" + name + "]";
  }
  return line;
}

std::string exit_section() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : exit_meanings) {
    text += ".TP\n" + bold(std::to_string(exit.code)) + "\n" + roff(exit.meaning) + ".\n";
  }
  return text;
}

}  // namespace

std::string manual_page(const std::vector<CommandEntry>& table) {
  const CommandEntry& program = table.front();
  std::string page = ".TH SPHPARAM 1 \"\" \"sphparam " + std::string(version) + "\"\n" +
                     ".SH NAME\nsphparam \\- map closed genus\\-0 triangle meshes one\\-to\\-one "
                     "onto the sphere\n" +
                     ".SH SYNOPSIS\n.nf\n";
  for (size_t i = 1; i < table.size(); ++i) page += usage(table[i]) + "\n";
  page += ".fi\n" + std::string(description) + remarks(program.text) + option_section(program);
  page += ".SH COMMANDS\n";
  for (size_t i = 1; i < table.size(); ++i) {
    page += ".SS " + usage(table[i]) + "\n" + roff(table[i].headline()) + "\n" +
            remarks(table[i].text) + option_section(table[i]);
  }
  return page + files + exit_section() + closing;
}

}  // namespace sphparam::cli
