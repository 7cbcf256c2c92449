#include "embedding/multigrid/block_gauss_seidel.h"

#include <algorithm>

#include "embedding/sweeps/least_colour.h"

namespace sphparam {

SweepOrder order_sweeps(const std::vector<int>& start, const std::vector<int>& column, int size) {
  const int rows = static_cast<int>(start.size()) - 1, blocks = (rows + size - 1) / size;
  SweepOrder order;
  for (int b = 0; b < blocks; ++b) order.first_row.push_back(b * size);
  order.first_row.push_back(rows);
  std::vector<int> colour(at(blocks), -1);
  int colours = 0;
  for (int b = 0; b < blocks; ++b) {
    const int first = start[at(order.first_row[at(b)])];
    const int last = start[at(order.first_row[at(b) + 1])];
    colour[at(b)] = least_free_colour(0, [&](const auto& take) {
      for (int e = first; e < last; ++e) take(colour[at(column[at(e)] / size)]);
    });
    colours = std::max(colours, colour[at(b)] + 1);
  }
  order.colour_start.push_back(0);
  for (int c = 0; c < colours; ++c) {
    for (int b = 0; b < blocks; ++b) {
      if (colour[at(b)] == c) order.blocks.push_back(b);
    }
    order.colour_start.push_back(static_cast<int>(order.blocks.size()));
  }
  return order;
}

}  // namespace sphparam
