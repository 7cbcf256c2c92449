#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "embedding/multigrid/block_matrix.h"

namespace sphparam {

/// Which rows of a matrix go together on the next coarser level.
struct Aggregates {
  std::vector<int> of_row;          // −1: pinned
  std::vector<int> start, members;  // aggregate → rows

  int count() const { return static_cast<int>(start.size()) - 1; }
};

/// Fills in `start` and `members` from `of_row`.
void list_members(Aggregates& aggregates, int count);

/// How strongly rows are connected.
template <int N>
class Connections {
 public:
  /// Borrows the matrix. `strength`: |A_ij| > this · √(|A_ii||A_jj|) is strong.
  Connections(const BlockMatrix<N>& a, double strength) : a_(a), strength_(strength) {
    norm_.reserve(a.diagonal.size());
    for (const Block<N>& d : a.diagonal) norm_.push_back(std::sqrt(squared_norm(d)));
  }

  bool is_strong(int row, int entry) const {
    return squared_norm(a_.off[at(entry)]) >
           strength_ * strength_ * norm_[at(row)] * norm_[at(a_.column[at(entry)])];
  }

  /// To be compared with those of the same row.
  double weight(int entry) const {
    return squared_norm(a_.off[at(entry)]) / norm_[at(a_.column[at(entry)])];
  }

 private:
  const BlockMatrix<N>& a_;
  double strength_;
  std::vector<double> norm_;
};

/// Rows whose strong neighbours are all free gather them, first come, first served. Returns the
/// number of aggregates; `of_row` of all others stays −1.
template <int N>
int gather_neighbours(const BlockMatrix<N>& a, const Connections<N>& connections,
                      const std::vector<char>& pinned, std::vector<int>& of_row) {
  int aggregates = 0;
  for (int i = 0; i < a.rows(); ++i) {
    if (of_row[at(i)] >= 0 || (!pinned.empty() && pinned[at(i)])) continue;
    bool free = true;
    int found = 0;
    for (int e = a.start[at(i)]; free && e < a.start[at(i) + 1]; ++e) {
      if (!connections.is_strong(i, e)) continue;
      ++found;
      free = of_row[at(a.column[at(e)])] < 0;
    }
    if (!free || found == 0) continue;
    of_row[at(i)] = aggregates;
    for (int e = a.start[at(i)]; e < a.start[at(i) + 1]; ++e) {
      if (connections.is_strong(i, e)) of_row[at(a.column[at(e)])] = aggregates;
    }
    ++aggregates;
  }
  return aggregates;
}

/// Rows left over join the aggregate of their strongest neighbour, if one has an aggregate by now,
/// or are one of their own. Returns the number of aggregates.
template <int N>
int join_strongest(const BlockMatrix<N>& a, const Connections<N>& connections,
                   const std::vector<char>& pinned, int aggregates, std::vector<int>& of_row) {
  const std::vector<int> cores = of_row;
  for (int i = 0; i < a.rows(); ++i) {
    if (of_row[at(i)] >= 0 || (!pinned.empty() && pinned[at(i)])) continue;
    double strongest = 0;
    for (int e = a.start[at(i)]; e < a.start[at(i) + 1]; ++e) {
      const int core = cores[at(a.column[at(e)])];
      const double weight = connections.weight(e);
      if (core < 0 || !(weight > strongest)) continue;
      strongest = weight;
      of_row[at(i)] = core;
    }
    if (of_row[at(i)] < 0) of_row[at(i)] = aggregates++;
  }
  return aggregates;
}

/// Aggregates by strong connections, greedily. `pinned` rows (none, if empty) are in no aggregate.
/// Requires: they have no entries. Cost: linear.
template <int N>
Aggregates aggregate(const BlockMatrix<N>& a, const std::vector<char>& pinned, double strength) {
  const Connections<N> connections(a, strength);
  Aggregates aggregates;
  aggregates.of_row.assign(at(a.rows()), -1);
  int count = gather_neighbours(a, connections, pinned, aggregates.of_row);
  count = join_strongest(a, connections, pinned, count, aggregates.of_row);
  list_members(aggregates, count);
  return aggregates;
}

}  // namespace sphparam
