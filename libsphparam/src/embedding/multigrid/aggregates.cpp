#include "embedding/multigrid/aggregates.h"

namespace sphparam {

void list_members(Aggregates& aggregates, int count) {
  std::vector<int>& start = aggregates.start;
  start.assign(at(count) + 1, 0);
  for (const int c : aggregates.of_row) {
    if (c >= 0) ++start[at(c) + 1];
  }
  for (size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  aggregates.members.resize(at(start.back()));
  std::vector<int> place(start.begin(), start.end() - 1);
  for (size_t row = 0; row < aggregates.of_row.size(); ++row) {
    const int c = aggregates.of_row[row];
    if (c >= 0) aggregates.members[at(place[at(c)]++)] = static_cast<int>(row);
  }
}

}  // namespace sphparam
