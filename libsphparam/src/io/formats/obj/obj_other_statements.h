#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/files/text_scanner.h"

namespace sphparam {

/// The statements of an OBJ file that are no part of a mesh of triangles: names of what faces
/// belong to and of libraries, curves and other things that are left out, and those that nobody
/// knows.
class ObjOtherStatements {
 public:
  /// Requires: the scanner is behind the keyword.
  void note(const std::string& keyword, TextScanner& scanner);
  /// Notes one that is told as left out.
  void leave_out(const std::string& keyword) { ++left_out_[keyword]; }

  /// Files of materials, in the order in which they are named, each once.
  const std::vector<std::string>& libraries() const { return libraries_.in_order; }

  /// Throws: ReadError at the first unknown statement, where there is one.
  void refuse_unknown(const TextScanner& scanner) const;

  /// Of how many objects and groups the names are lost. That of a single object is all of the
  /// file's: told, and no loss.
  void tell_groups(std::vector<std::string>& notes) const;
  void tell_left_out(std::vector<std::string>& notes) const;
  void tell_unknown(std::vector<std::string>& notes) const;

 private:
  /// The names that statements of one kind have given so far.
  struct Names {
    std::string last;
    std::set<std::string> distinct;
    std::vector<std::string> in_order;  // the distinct ones, as first seen
  };
  static void add_name(Names& names, std::string_view name);

  Names libraries_;
  std::map<std::string, Names> groups_;   // by keyword
  std::map<std::string, long> left_out_;  // by keyword
  long unknown_ = 0;
  std::string first_unknown_;
  long first_unknown_line_ = 0;
};

}  // namespace sphparam
