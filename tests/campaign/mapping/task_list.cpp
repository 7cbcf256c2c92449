#include "mapping/task_list.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "elementary.h"

namespace sphparam::campaign {
namespace {

/// The last digit of a number whose digits have different bases, which then goes.
int next_digit(std::int64_t& number, std::int64_t base) {
  const auto digit = static_cast<int>(number % base);
  number /= base;
  return digit;
}

Way progressive(std::string name, double microseconds, Quality quality, Balance balance,
                double lambda = 1) {
  ParameterizeOptions options;
  options.quality = quality;
  options.balance = balance;
  options.energy.lambda = lambda;
  return {"progressive, " + std::move(name), options, microseconds};
}

}  // namespace

const std::vector<Way>& ways() {
  static const std::vector<Way> all{
      progressive("normal", 25, Quality::Normal, Balance::Lambda),
      progressive("draft", 20, Quality::Draft, Balance::Lambda),
      progressive("best", 80, Quality::Best, Balance::Lambda),
      progressive("conformal", 40, Quality::Normal, Balance::Conformal),
      progressive("equal-area", 100, Quality::Normal, Balance::EqualArea),
      progressive("λ = 0.1", 25, Quality::Normal, Balance::Lambda, 0.1),
      progressive("λ = 10", 25, Quality::Normal, Balance::Lambda, 10),
      {"curvilinear", {.method = Method::Curvilinear}, 25}};
  return all;
}

std::string name_of_size(int size) {
  return size == 0 ? "as it is" : std::to_string(sizes[static_cast<size_t>(size)]) + " triangles";
}

std::string name_of_order(int order) {
  return order == 0 ? "as it is" : "permutation " + std::to_string(order);
}

std::int64_t TaskList::end() const {
  return std::ssize(meshes_) * std::ssize(sizes) * orders_ * std::ssize(placements) *
         std::ssize(ways());
}

Task TaskList::task(std::int64_t number) const {
  Task task;
  task.way = next_digit(number, std::ssize(ways()));
  task.placement = next_digit(number, std::ssize(placements));
  task.order = next_digit(number, orders_);
  task.size = next_digit(number, std::ssize(sizes));
  task.mesh = static_cast<int>(number);
  return task;
}

const SourceMesh& TaskList::mesh_of(const Task& task) const {
  return meshes_[static_cast<size_t>(task.mesh)];
}

long TaskList::triangles(const Task& task) const {
  return mesh_of(task).triangles[static_cast<size_t>(task.size)];
}

double TaskList::estimate(const Task& task) const {
  return 1e-6 * ways()[static_cast<size_t>(task.way)].microseconds *
         static_cast<double>(triangles(task));
}

bool TaskList::possible(const Task& task) const {
  return mesh_of(task).refusal.empty() && triangles(task) > 0 &&
         (task.is_default() || estimate(task) <= longest_estimate);
}

std::vector<std::int64_t> TaskList::all() const {
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; number < end(); ++number) {
    if (possible(task(number))) numbers.push_back(number);
  }
  return numbers;
}

// Weighted draws without repeats: the smallest of the keys −ln(u) / w, u evenly in (0, 1]
// (Efraimidis and Spirakis, 2006).
std::vector<std::int64_t> TaskList::draw(std::int64_t count, std::uint64_t seed) const {
  std::vector<std::pair<double, std::int64_t>> keys;
  for (const std::int64_t number : all()) {
    const Task drawn = task(number);
    const double u =
        0x1p-53 * static_cast<double>((mixed(seed, static_cast<std::uint64_t>(number)) >> 11) + 1);
    const double key = -elementary::log(u) * std::max(1.0, estimate(drawn) / dear);
    keys.emplace_back(drawn.is_default() ? -1 : key, number);
  }
  std::ranges::sort(keys);
  keys.resize(static_cast<size_t>(std::min<std::int64_t>(count, std::ssize(keys))));
  std::vector<std::int64_t> numbers;
  for (const auto& [key, number] : keys) numbers.push_back(number);
  std::ranges::sort(numbers, {}, [&](std::int64_t number) {
    return std::tuple(-mesh_of(task(number)).triangles[0], number);
  });
  return numbers;
}

// The finaliser of SplitMix64 (Steele, Lea and Flood, 2014).
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t bits = seed * 0xd1342543de82ef95 + (number + 1) * 0x9e3779b97f4a7c15;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

}  // namespace sphparam::campaign
