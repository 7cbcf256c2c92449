#include "reports/told_losses.h"

#include <algorithm>

#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

void tell_losses(const MeshSource& source, Console& console) {
  tell_losses_of_reading(source.path, source.notes, console);
}

void tell_notes(const MeshSource& source, Console& console) {
  tell_losses(source, console);
  const std::vector<std::string> losses = losses_among(source.notes);
  for (const std::string& note : source.notes)
    if (!std::ranges::count(losses, note)) console.note(note);
}

void add_replaced(std::vector<std::string>& losses, const MeshFile& file) {
  const auto has = [&](const char* name) { return file.find_vertex_property(name) != nullptr; };
  if (has("sx") && has("sy") && has("sz")) return;  // they are a map's
  std::vector<std::string> names;
  for (const char* name : {"theta", "phi", "sx", "sy", "sz"})
    if (has(name)) names.emplace_back(name);
  if (!names.empty()) add_loss(losses, enumerated(names) + " of vertices: the map's stand there");
}

void tell_replaced(const MeshSource& source, Console& console) {
  std::vector<std::string> losses;
  add_replaced(losses, source.file);
  tell_losses_of_reading(source.path, losses, console);
}

void tell_other_numbers(const MeshSource& source, Console& console) {
  if (std::ranges::count(source.notes, other_numbers_note))
    console.say(display_name(source.path) + ": " + other_numbers_note);
}

void tell_losses_of_reading(const std::string& path, const std::vector<std::string>& notes,
                            Console& console) {
  for (const std::string& loss : losses_among(notes))
    console.loss(display_name(path) + ": " + loss);
}

void tell_losses(const std::string& path, const std::vector<std::string>& losses,
                 Console& console) {
  for (const std::string& loss : losses) console.loss(output_name(path) + ": " + loss);
}

}  // namespace sphparam::cli
