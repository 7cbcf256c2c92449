#include "reports/told_losses.h"

#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

void tell_losses(const MeshSource& source, Console& console) {
  tell_losses_of_reading(source.path, source.notes, console);
}

void tell_losses_of_reading(const std::string& path, const std::vector<std::string>& notes,
                            Console& console) {
  for (const std::string& loss : losses_among(notes))
    console.say("  " + display_name(path) + ": " + loss);
}

void tell_losses(const std::string& path, const std::vector<std::string>& losses,
                 Console& console) {
  for (const std::string& loss : losses) console.say("  " + output_name(path) + ": " + loss);
}

}  // namespace sphparam::cli
