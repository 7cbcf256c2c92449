#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/materials.h"

namespace sphparam {

/// A factor of an extension of glTF, and where it is kept: one of the two.
struct FinishTerm {
  const char* extension;  // without "KHR_materials_"
  const char* key;        // of its object; no two extensions share one
  double MaterialFinish::*number = nullptr;
  MaterialFinish::Colour MaterialFinish::*colour = nullptr;
  double least = 0, most = 1;  // what the extension allows
};

/// All that are carried, extension by extension.
const std::vector<FinishTerm>& finish_terms();

/// The numbers of a term.
std::vector<double> numbers_of(const FinishTerm& term, const MaterialFinish& finish);

/// Sets a term; what the extension does not allow is as if it was not there.
void set_numbers(const FinishTerm& term, const std::vector<double>& numbers,
                 MaterialFinish& finish);

/// The extensions that a finish needs, by their whole names: those with a factor that says
/// something, and that have an effect.
std::vector<std::string> extensions_of(const MaterialFinish& finish);

/// A finish as a word of metadata: "clearcoatFactor=1 sheenColorFactor=1,0,0", without what says
/// nothing; and back, passing over what makes no sense.
std::string to_text(const MaterialFinish& finish);
MaterialFinish finish_in(std::string_view text);

}  // namespace sphparam
