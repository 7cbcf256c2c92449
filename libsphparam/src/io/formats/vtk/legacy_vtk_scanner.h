#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/vtk/vtk_surface.h"

namespace sphparam {

/// Words, numbers and strings of a legacy VTK file, whose text and big-endian data take turns.
class LegacyVtkScanner {
 public:
  /// Requires: `bytes` and `name` outlive the scanner.
  LegacyVtkScanner(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void set_binary(bool binary) { binary_ = binary; }

  /// The rest of the line, blanks at its ends removed, and past it.
  std::string_view line();

  /// The next word; empty at the end of the file.
  std::string_view word();
  /// The same in upper case, without moving.
  std::string next_keyword();
  /// A name, whose percent signs mean bytes.
  std::string name_word();
  std::int64_t count(const char* what);

  /// Numbers of one type. Throws: ReadError where they are not there: nothing is set aside before.
  std::vector<double> numbers(std::string_view type, std::int64_t count, VtkType& kept,
                              TextDigits digits = TextDigits::AsDeclared);
  std::vector<std::string> strings(std::int64_t count);
  static bool is_string_type(std::string_view type);

  [[noreturn]] void fail(const std::string& message) const;

 private:
  void skip_blanks();
  void end_line();
  std::vector<double> binary_numbers(VtkType type, std::size_t count);
  std::vector<double> text_numbers(VtkType& type, std::size_t count, TextDigits digits);
  std::vector<double> bits(std::size_t count);
  std::string binary_string();

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace sphparam
