#include "reports/remesh_wording.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "number_text.h"

namespace sphparam::cli {

namespace {

bool is_whole(double value) { return value == std::floor(value); }

bool is_colour(const std::string& name) {
  return name == "red" || name == "green" || name == "blue" || name == "alpha";
}

/// Numbers in floats that look like labels: few, and whole.
bool may_be_labels(const Property& property) {
  constexpr std::size_t most = 256;
  if (!is_floating(property.type) || is_colour(property.name)) return false;
  std::set<double> different;
  for (const double value : property.values)
    if (!is_whole(value) || (different.insert(value).second && different.size() > most))
      return false;
  return different.size() > 1;
}

/// Says which numbers that may be labels were averaged, and what makes them labels.
void tell_averaged_labels(const MeshFile& source, const MeshFile& made, Console& console) {
  for (const Property& property : source.vertex_properties) {
    const Property* const mean = made.find_vertex_property(property.name);
    if (!mean || mean->values.empty() || !may_be_labels(property)) continue;
    const auto broken =
        std::ranges::count_if(mean->values, [](double value) { return !is_whole(value); });
    if (broken == 0) continue;
    console.say("  " + property.name + ": whole numbers in floats are averaged, " +
                percent(static_cast<double>(broken) / static_cast<double>(mean->values.size())) +
                " of the new ones are not whole; labels are of an integer type, `property int " +
                property.name + "` in a PLY, or in Python values={\"" + property.name +
                "\": numbers.astype(int)}");
  }
}

}  // namespace

void tell(const RemeshRecord& record, Console& console) {
  const Remeshed& made = record.levels.front().mesh;
  const Remeshed::Figures& figures = made.figures();
  console.detail("  grid: " + short_number(record.grid_seconds) +
                 " s, location: " + short_number(figures.locate_seconds) +
                 " s, positions: " + short_number(figures.transfer_seconds) + " s");
  if (record.sample == SampleMode::Cell) {
    console.detail("  means over cells at " + std::to_string(figures.averaged) + " of " +
                   std::to_string(made.map().points.rows()) + " vertices");
  }
  for (const std::string& warning : warnings_of(record)) console.warning(warning);
  tell_averaged_labels(record.source.file(), made.file(), console);
  std::string lines = to_text(record);
  lines.pop_back();  // its end of line is the console's
  console.say(lines);
}

}  // namespace sphparam::cli
