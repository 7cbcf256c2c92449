#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arguments/numbers.h"
#include "arguments/words.h"
#include "console/session.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/texture/convention.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sphparam::cli {

/// A subcommand as it is declared. An option is its name, the variable that takes its value, the
/// word that stands for the value in --help, and what it means. What a variable holds before is its
/// value where none is given; --help tells it, unless it is empty or out of range: nothing is
/// wanted then. Variables must live as long as the program.
class Declaration {
 public:
  Declaration(CLI::App& program, const std::string& name, const std::string& summary);

  /// A file without an option, which must be given.
  Declaration& input(const std::string& name, std::string& path, const std::string& about);
  /// -o, which must be given: a file, or a folder, that is written.
  Declaration& output(std::string& path, const std::string& word, const std::string& about);

  Declaration& text(const std::string& name, std::string& value, const std::string& word,
                    const std::string& about);
  /// One that may be given again; where it is no option, one after the other.
  Declaration& texts(const std::string& name, Words& values, const std::string& word,
                     const std::string& about);
  /// With commas between.
  Declaration& list(const std::string& name, Words& values, const std::string& word,
                    const std::string& about);
  Declaration& flag(const std::string& name, bool& value, const std::string& about);
  Declaration& flag_off(const std::string& name, bool& value, const std::string& about);
  /// One that may carry words after an equals sign; "true" without.
  Declaration& flag(const std::string& name, std::string& words, const std::string& about);

  /// For int, std::int64_t, std::uint64_t and double.
  template <class Number>
  Declaration& number(const std::string& name, Number& value, const std::string& word,
                      const Range<Number>& range, const std::string& about);
  Declaration& number(const std::string& name, std::optional<int>& value, const std::string& word,
                      const Range<int>& range, const std::string& about);

  /// One of a few words, which --help shows and shells complete. A wrong one is answered with the
  /// right ones.
  template <class Value>
  Declaration& choice(
      const std::string& name, Value& value,
      const std::vector<std::pair<std::string, std::type_identity_t<Value>>>& choices,
      const std::string& about) {
    const auto choose = [&value, choices](std::size_t i) { value = choices[i].second; };
    return word(name, names_of(choices, [](const auto& choice) { return choice.first; }), choose,
                about);
  }

  /// What `read` makes of the text; where it returns false, the complaint is made, and ends with
  /// the text if it ends with "not ".
  Declaration& parsed(const std::string& name, const std::string& word,
                      const std::function<bool(const std::string&)>& read,
                      const std::string& complaint, const std::string& about);

  // Options that several subcommands have, with one meaning in all of them:
  Declaration& sphere(std::string& path);
  Declaration& data(Words& files);
  /// --up and --front.
  Declaration& up(Up& up);
  Declaration& convention(Convention& convention);
  /// --crease: below 0 where none is wanted.
  Declaration& crease(double& degrees);
  /// --source-normal-y: true where green points down the image.
  Declaration& source_normals(bool& down);
  Declaration& refine_poles(int& wedges, const std::string& about);
  /// --json: what is in it.
  Declaration& json(CommonArguments& arguments, const std::string& what = "A report");
  Declaration& threads(CommonArguments& arguments);
  /// How much is told while it works, and how much memory and input it may take.
  Declaration& console(CommonArguments& arguments);

  /// The files that the one before names are written; all others are read.
  Declaration& written();
  /// The one before must be given.
  Declaration& required();
  /// The number before must be one.
  Declaration& multiple_of(int factor);
  /// What --help says of the one before where it is not given.
  Declaration& preset(const std::string& value);
  /// Those that follow stand together under a heading.
  Declaration& group(const std::string& heading);

  /// Once the command line is parsed: was this option on it?
  std::function<bool(const std::string&)> given() const;

  CLI::App& app() { return *app_; }

 private:
  Declaration& word(const std::string& name, const Words& words,
                    const std::function<void(std::size_t)>& choose, const std::string& about);
  Declaration& keep(CLI::Option* option, const std::string& word, bool tells_preset = false);

  CLI::App* app_;
  CLI::Option* last_ = nullptr;
  std::string group_ = "Options";
};

/// A number as CLI11 reads those of options.
bool read_number(const std::string& text, double& value);

}  // namespace sphparam::cli
