// Inputs and steps → items with their hashes. What is hashed of the options are the words as they
// run, without the path of the input: a data set that moved is the same, a changed pin file is not.

#include "sphparam/batch/plan.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "batch/content_hash.h"
#include "batch/input_hash.h"
#include "batch/manifest.h"
#include "batch/options_hash.h"
#include "batch/steps.h"
#include "option_domain.h"
#include "sphparam/errors.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

/// Threads of its own, which end here: who plans may fork then, and the pool of `parallel_for` does
/// not outlive a fork.
template <class Body>
void on_own_threads(std::size_t count, int threads, const Body& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < count;) body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < resolve_threads(threads); ++i) helpers.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

void hash_inputs(BatchPlan& plan, const BatchPlanOptions& options) {
  std::atomic<std::size_t> read = 0;
  const auto caller = std::this_thread::get_id();
  on_own_threads(plan.items.size(), options.threads, [&](std::size_t i) {
    BatchItem& item = plan.items[i];
    item.input = hash_of_input(item.path).hash;
    item.size = stamp_of(item.path).size;
    const double done = static_cast<double>(++read) / static_cast<double>(plan.items.size());
    if (!options.progress || std::this_thread::get_id() != caller) return;
    if (!options.progress("reading inputs", done)) throw Cancelled();
  });
}

}  // namespace

BatchPlan make_plan(const BatchInputs& inputs, const BatchPlanOptions& options) {
  require_at_least("chunk", options.chunk, 1);
  BatchPlan plan;
  plan.steps = complete_steps(options.steps);
  plan.columns = inputs.columns;
  for (const BatchInput& shape : inputs.shapes)
    plan.items.push_back({.id = shape.id, .path = shape.path, .values = shape.values});
  OptionsHash hash(plan);  // before anything is read: it complains of placeholders
  for (BatchItem& item : plan.items) item.options = hash.of(item);
  hash_inputs(plan, options);
  return with_chunk(std::move(plan), options.chunk);
}

BatchPlan with_chunk(BatchPlan plan, int chunk) {
  require_at_least("chunk", chunk, 1);
  plan.chunk = chunk;
  plan.name = content_hash(manifest_text(plan)).substr(0, 16);
  return plan;
}

}  // namespace sphparam
