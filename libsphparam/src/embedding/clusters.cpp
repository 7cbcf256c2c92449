#include "embedding/clusters.h"

namespace sphparam {

void list_members(Clusters& clusters, int count) {
  std::vector<int>& start = clusters.start;
  start.assign(at(count) + 1, 0);
  for (const int c : clusters.of_row) {
    if (c >= 0) ++start[at(c) + 1];
  }
  for (size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  clusters.members.resize(at(start.back()));
  std::vector<int> place(start.begin(), start.end() - 1);
  for (size_t row = 0; row < clusters.of_row.size(); ++row) {
    const int c = clusters.of_row[row];
    if (c >= 0) clusters.members[at(place[at(c)]++)] = static_cast<int>(row);
  }
}

}  // namespace sphparam
