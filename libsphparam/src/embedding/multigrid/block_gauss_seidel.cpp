#include "embedding/multigrid/block_gauss_seidel.h"

#include <algorithm>

namespace sphparam {

SweepOrder order_sweeps(const std::vector<int>& start, const std::vector<int>& column, int size) {
  const int rows = static_cast<int>(start.size()) - 1, blocks = (rows + size - 1) / size;
  SweepOrder order;
  for (int b = 0; b < blocks; ++b) order.first_row.push_back(b * size);
  order.first_row.push_back(rows);
  std::vector<int> colour(at(blocks), -1), taken;  // taken[c]: last block that found c taken
  for (int b = 0; b < blocks; ++b) {
    for (int e = start[at(order.first_row[at(b)])]; e < start[at(order.first_row[at(b) + 1])];
         ++e) {
      const int c = colour[at(column[at(e)] / size)];
      if (c >= 0) taken[at(c)] = b;
    }
    const auto free = std::find_if(taken.begin(), taken.end(), [&](int t) { return t != b; });
    colour[at(b)] = static_cast<int>(free - taken.begin());
    if (free == taken.end()) taken.push_back(-1);
  }
  order.colour_start.push_back(0);
  for (int c = 0; c < static_cast<int>(taken.size()); ++c) {
    for (int b = 0; b < blocks; ++b) {
      if (colour[at(b)] == c) order.blocks.push_back(b);
    }
    order.colour_start.push_back(static_cast<int>(order.blocks.size()));
  }
  return order;
}

}  // namespace sphparam
