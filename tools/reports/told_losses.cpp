#include "reports/told_losses.h"

#include <algorithm>

#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

void tell_losses(const MeshSource& source, Console& console) {
  tell_losses_of_reading(source.path, source.notes, console);
}

void tell_notes(const MeshSource& source, Console& console) {
  tell_losses(source, console);
  for (const std::string& note : quiet_notes(source.notes)) console.note(note);
}

std::vector<std::string> quiet_notes(const std::vector<std::string>& notes) {
  std::vector<std::string> told = losses_among(notes);
  for (std::string& coarse : coarse_coordinates_among(notes)) told.push_back(std::move(coarse));
  std::vector<std::string> quiet;
  for (const std::string& note : notes)
    if (!std::ranges::count(told, note)) quiet.push_back(note);
  return quiet;
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
  for (const std::string& coarse : coarse_coordinates_among(notes))
    console.warning(display_name(path) + ": " + coarse);
}

void tell_losses(const std::string& path, const std::vector<std::string>& losses,
                 Console& console) {
  for (const std::string& loss : losses) console.loss(output_name(path) + ": " + loss);
}

}  // namespace sphparam::cli
