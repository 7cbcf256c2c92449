#include "reports/remesh_wording.h"

#include "number_text.h"

namespace sphparam::cli {

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
  std::string lines = to_text(record);
  lines.pop_back();  // its end of line is the console's
  console.say(lines);
}

}  // namespace sphparam::cli
