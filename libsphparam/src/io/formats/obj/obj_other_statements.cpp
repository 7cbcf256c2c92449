#include "io/formats/obj/obj_other_statements.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/read_options.h"

namespace sphparam {
namespace {

constexpr std::string_view silent[] = {"mg",       "lod",      "shadow_obj", "trace_obj", "bevel",
                                       "c_interp", "d_interp", "maplib",     "usemap"};
constexpr std::string_view told[] = {"l",    "p",     "vp",   "cstype", "deg",  "bmat", "step",
                                     "curv", "curv2", "surf", "parm",   "trim", "hole", "scrv",
                                     "sp",   "end",   "con",  "ctech",  "stech"};
constexpr std::pair<const char*, const char*> kinds_of_groups[] = {
    {"o", "object"}, {"g", "group"}, {"s", "smoothing group"}};

template <class List>
bool is_in(const List& list, std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

bool is_group(const std::string& keyword) {
  return std::ranges::any_of(kinds_of_groups,
                             [&](const auto& kind) { return keyword == kind.first; });
}

/// What stands for none.
bool is_none(const std::string& name) {
  constexpr std::string_view none[] = {"off", "0", "default", "(null)"};
  return is_in(none, name);
}

}  // namespace

void ObjOtherStatements::note(const std::string& keyword, TextScanner& scanner) {
  if (keyword == "mtllib") return add_name(libraries_, scanner.rest());
  if (is_group(keyword)) return add_name(groups_[keyword], scanner.rest());
  if (is_in(silent, keyword)) return;
  if (is_in(told, keyword)) return leave_out(keyword);
  if (unknown_++ > 0) return;
  first_unknown_ = sphparam::quoted(keyword);
  first_unknown_line_ = scanner.line_number();
}

// Most files say the same name again and again, or none but one.
void ObjOtherStatements::add_name(Names& names, std::string_view name) {
  if (name.empty() || name == names.last) return;
  names.last = name;
  if (names.distinct.insert(names.last).second) names.in_order.push_back(names.last);
}

void ObjOtherStatements::refuse_unknown(const TextScanner& scanner) const {
  if (unknown_ > 0) scanner.fail_at(first_unknown_line_, "unknown statement " + first_unknown_);
}

void ObjOtherStatements::tell_groups(std::vector<std::string>& notes) const {
  std::vector<std::string> words;
  for (const auto& [keyword, what] : kinds_of_groups) {
    const auto group = groups_.find(keyword);
    if (group == groups_.end()) continue;
    std::set<std::string> names = group->second.distinct;
    std::erase_if(names, is_none);
    const bool is_whole = names.size() == 1 && std::string_view(keyword) == "o";
    if (is_whole) notes.push_back("its object is called " + sphparam::quoted(*names.begin()));
    if (!names.empty() && !is_whole) words.push_back(counted(std::ssize(names), what));
  }
  if (!words.empty()) add_loss(notes, "the names of " + enumerated(words));
}

void ObjOtherStatements::tell_left_out(std::vector<std::string>& notes) const {
  for (const auto& [keyword, count] : left_out_)
    add_loss(notes, counted(count, "'" + keyword + "' statement"));
}

void ObjOtherStatements::tell_unknown(std::vector<std::string>& notes) const {
  if (unknown_ > 0)
    add_loss(notes, counted(unknown_, "unknown statement") + ", the first " + first_unknown_ +
                        " in line " + std::to_string(first_unknown_line_));
}

}  // namespace sphparam
