#include "tally.h"

#include <algorithm>
#include <cstdio>

namespace sphparam::campaign {
namespace {

constexpr const char* first_path = "progressive embedding";

}  // namespace

void Tally::add(std::int64_t number, const Outcome& outcome, bool compared_threads) {
  for (Counts* counts : {&all_, &families_[outcome.family]}) {
    ++counts->count;
    counts->certified += outcome.certified;
    counts->float32_folded += outcome.float32_folds > 0;
    counts->seconds += outcome.seconds;
    counts->slowest = std::max(counts->slowest, outcome.seconds);
    ++counts->stages[outcome.error.empty() ? outcome.made_by : "thrown"];
  }
  compared_ += compared_threads;
  hash_ += outcome.hash * static_cast<std::uint64_t>(2 * number + 1);
  const nlohmann::json item{{"number", number}, {"outcome", outcome}};
  if (!outcome.error.empty()) {
    thrown_.push_back(item);
  } else if (!outcome.certified) {
    uncertified_.push_back(item);
  }
  if (outcome.certified && outcome.made_by != first_path) rescued_.push_back(item);
  if (outcome.thread_dependent) thread_dependent_.push_back(item);
}

void Tally::add_loss(std::int64_t number, const std::string& reason) {
  lost_.push_back({{"number", number}, {"reason", reason}});
}

bool Tally::all_well() const {
  return uncertified_.empty() && lost_.empty() && thrown_.empty() && thread_dependent_.empty();
}

nlohmann::json Tally::json() const {
  const auto counts_of = [](const Counts& c) {
    return nlohmann::json{
        {"count", c.count},     {"certified", c.certified}, {"folded in float32", c.float32_folded},
        {"seconds", c.seconds}, {"slowest", c.slowest},     {"stages", c.stages}};
  };
  nlohmann::json families;
  for (const auto& [name, counts] : families_) families[name] = counts_of(counts);
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_));
  return {{"all", counts_of(all_)},
          {"families", families},
          {"compared with 2 and 4 threads", compared_},
          {"hash", hash},
          {"rescued", rescued_},
          {"uncertified", uncertified_},
          {"lost", lost_},
          {"thrown", thrown_},
          {"thread dependent", thread_dependent_}};
}

std::string Tally::table() const {
  std::string text =
      "| family | meshes | certified | made by | folded in float32 | slowest (s) |\n"
      "|---|---|---|---|---|---|\n";
  const auto add_row = [&](const std::string& name, const Counts& counts) {
    std::string stages;
    for (const auto& [stage, count] : counts.stages) {
      stages += (stages.empty() ? "" : ", ") + stage + " " + std::to_string(count);
    }
    char slowest[32];
    std::snprintf(slowest, sizeof slowest, "%.2f", counts.slowest);
    text += "| " + name + " | " + std::to_string(counts.count) + " | " +
            std::to_string(counts.certified) + " | " + stages + " | " +
            std::to_string(counts.float32_folded) + " | " + slowest + " |\n";
  };
  for (const auto& [name, counts] : families_) add_row(name, counts);
  add_row("all", all_);
  return text;
}

}  // namespace sphparam::campaign
