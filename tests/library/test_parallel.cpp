#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/grid_lift.h"
#include "most_threads.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/errors.h"
#include "sphparam/parallel.h"
#include "sphparam/parameterize.h"
#include "sphparam/stopped_by.h"
#include "support/forks.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Whether two threads meet in one loop.
bool has_two_threads() {
  std::atomic<int> inside{0};
  std::atomic<bool> met{false};
  parallel_for(2, 1, 2, [&](std::int64_t, std::int64_t) {
    ++inside;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (inside < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    if (inside == 2) met = true;
  });
  return met;
}

}  // namespace

TEST_CASE("threads: all cores are as many as the process keeps to, a number is itself") {
  const int cores = resolve_threads(0);
  keep_to_threads(1);
  CHECK(resolve_threads(0) == 1);
  CHECK(resolve_threads(-3) == 1);
  CHECK(resolve_threads(5) == 5);
  keep_to_threads(cores + 7);
  CHECK(resolve_threads(0) == cores);
  keep_to_threads(0);
  CHECK(resolve_threads(0) == cores);
}

TEST_CASE("parallel: chunks cover the range once, whatever the sizes") {
  for (const int count : {0, 1, 7, 1000, 1001}) {
    for (const int grain : {1, 10, 5000}) {
      for (const int threads : {0, 1, 3, 40}) {
        std::vector<int> visits(static_cast<size_t>(count), 0);
        parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
          for (std::int64_t i = first; i < last; ++i) ++visits[static_cast<size_t>(i)];
        });
        CHECK(visits == std::vector<int>(static_cast<size_t>(count), 1));
      }
    }
  }
}

TEST_CASE("parallel: an exception of a body reaches the caller after all bodies have ended") {
  std::atomic<int> running{0};
  const auto body = [&](std::int64_t first, std::int64_t) {
    ++running;
    if (first == 30) {
      --running;
      throw std::runtime_error("chunk 30");
    }
    --running;
  };
  CHECK_THROWS_WITH(parallel_for(100, 10, 4, body), "chunk 30");
  CHECK(running == 0);
  // The pool is as good as new.
  std::atomic<int> sum{0};
  parallel_for(100, 10, 4, [&](std::int64_t first, std::int64_t last) {
    sum += static_cast<int>(last - first);
  });
  CHECK(sum == 100);
}

TEST_CASE("parallel: the exception is that of the first chunk, whoever is faster") {
  const auto body = [](std::int64_t first, std::int64_t) {
    if (first == 30 || first == 50 || first == 90)
      throw std::runtime_error("chunk " + std::to_string(first));
  };
  for (int run = 0; run < 200; ++run) CHECK_THROWS_WITH(parallel_for(100, 10, 4, body), "chunk 30");
}

TEST_CASE("parallel: what a slow worker does not get to others do") {
  std::vector<int> visits(64, 0);
  parallel_for(64, 1, 2, [&](std::int64_t first, std::int64_t) {
    if (first == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++visits[static_cast<size_t>(first)];
  });
  CHECK(visits == std::vector<int>(64, 1));
}

TEST_CASE("parallel: a loop inside a loop ends") {
  std::atomic<int> sum{0};
  parallel_for(8, 1, 4, [&](std::int64_t, std::int64_t) {
    parallel_for(8, 1, 4, [&](std::int64_t, std::int64_t) { ++sum; });
  });
  CHECK(sum == 64);
}

TEST_CASE("parallel: a loop does not wait for one of another thread") {
  std::promise<void> begun, other_is_done;
  auto waiting = other_is_done.get_future().share();
  std::atomic<bool> waited{true};
  std::thread slow([&] {
    parallel_for(4, 1, 2, [&](std::int64_t first, std::int64_t) {
      if (first == 0) begun.set_value();
      if (waiting.wait_for(patience) != std::future_status::ready) waited = false;
    });
  });
  begun.get_future().wait();
  std::atomic<int> sum{0};
  parallel_for(100, 10, 2, [&](std::int64_t first, std::int64_t last) {
    sum += static_cast<int>(last - first);
  });
  other_is_done.set_value();
  slow.join();
  CHECK(sum == 100);
  CHECK(waited);
}

TEST_CASE("parallel: a process that is forked ends, whatever loops its parent has run") {
  REQUIRE(has_two_threads());
  CHECK(status_of_fork([] { return true; }) == 0);
  CHECK(has_two_threads());  // the parent's threads are still there
}

#ifndef __SANITIZE_THREAD__  // which lets no fork of many threads begin others
TEST_CASE("parallel: a process that is forked has threads of its own, and so have its forks") {
  REQUIRE(has_two_threads());
  CHECK(status_of_fork([] { return has_two_threads(); }) == 0);
  CHECK(status_of_fork([] { return status_of_fork([] { return has_two_threads(); }) == 0; }) == 0);
  CHECK(status_of_fork([] {
          return has_two_threads() && status_of_fork([] { return has_two_threads(); }) == 0;
        }) == 0);
}

TEST_CASE("parallel: a process may be forked while another thread's loop runs") {
  std::promise<void> begun, forks_are_done;
  auto waiting = forks_are_done.get_future().share();
  std::thread loop([&] {
    parallel_for(2, 1, 2, [&](std::int64_t first, std::int64_t) {
      if (first == 0) begun.set_value();
      waiting.wait_for(patience);
    });
  });
  begun.get_future().wait();
  CHECK(status_of_fork([] { return has_two_threads(); }) == 0);
  forks_are_done.set_value();
  loop.join();
}
#endif

TEST_CASE("parallel: loops that are stopped do no more chunks, nor do loops inside them") {
  for (const int threads : {1, 3}) {
    std::atomic<bool> stop{false};
    std::atomic<int> outer{0}, inner{0};
    const StoppedBy stopped(stop);
    CHECK_THROWS_AS(parallel_for(100, 1, threads,
                                 [&](std::int64_t, std::int64_t) {
                                   ++outer;
                                   stop = true;
                                   parallel_for(100, 1, threads,
                                                [&](std::int64_t, std::int64_t) { ++inner; });
                                 }),
                    Cancelled);
    CHECK(outer <= threads);
    CHECK(inner == 0);
    CHECK_THROWS_AS(parallel_for(1, 1, 1, [&](std::int64_t, std::int64_t) { ++inner; }), Cancelled);
  }
  int done = 0;  // both have ended
  parallel_for(1, 1, 1, [&](std::int64_t, std::int64_t) { ++done; });
  CHECK(done == 1);
}

TEST_CASE("parallel: a stop is its own thread's, and the later of two holds") {
  const std::atomic<bool> yes{true}, no{false};
  const auto is_stopped = [] {
    try {
      parallel_for(1, 1, 1, [](std::int64_t, std::int64_t) {});
      return false;
    } catch (const Cancelled&) {
      return true;
    }
  };
  const StoppedBy first(yes);
  CHECK(is_stopped());
  {
    const StoppedBy second(no);
    CHECK_FALSE(is_stopped());
  }
  CHECK(is_stopped());
  bool elsewhere = true;
  std::thread([&] { elsewhere = is_stopped(); }).join();
  CHECK_FALSE(elsewhere);
}

TEST_CASE("parallel: sums have the same bits for any number of threads") {
  const auto chunk = [](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (std::int64_t i = first; i < last; ++i) sum += std::sin(static_cast<double>(i)) * 1e10;
    return sum;
  };
  const double one = parallel_sum(100000, 1, chunk);
  CHECK(parallel_sum(100000, 2, chunk) == one);
  CHECK(parallel_sum(100000, 5, chunk) == one);
}

TEST_CASE("parallel: any number of threads below 1 means all cores") {
  for (const int threads : {0, -1, std::numeric_limits<int>::min()})
    CHECK(resolve_threads(threads) == std::max(1U, std::thread::hardware_concurrency()));
  CHECK(resolve_threads(1) == 1);
  CHECK(resolve_threads(4096) == 4096);
  const TriangleMesh mesh = icosphere(3);
  CHECK(parameterize(mesh, {.threads = -7}).map.points == parameterize(mesh).map.points);
}

TEST_CASE("parallel: who is to work by one thread makes no other") {
  const TriangleMesh mesh = icosphere(5);  // several chunks of all loops
  const Topology topology(mesh, 1);
  CHECK_FALSE(stays_alone([&] { Topology(mesh, 2); }));
  for (const Method method :
       {Method::Progressive, Method::Curvilinear, Method::Paper, Method::Radial})
    CHECK(stays_alone([&] { parameterize(mesh, {.method = method, .threads = 1}); }));
  CHECK(stays_alone([&] { repair_map(mesh, {mesh.positions}, {.threads = 1}); }));
  CHECK(stays_alone([&] { gnomonic_embedding(mesh, topology, {.threads = 1}); }));
  CHECK(stays_alone([&] { grid_lift(mesh, topology, {.threads = 1}); }));
  const int vertices = static_cast<int>(mesh.vertex_count());
  CHECK(stays_alone([&] { Topology::try_build(mesh.triangles, vertices, 1); }));
  CHECK(stays_alone([&] { require_sphere(mesh, 1); }));
  CHECK(
      stays_alone([&] { certify_chart(spherical_chart(mesh, topology, {mesh.positions}, 1), 1); }));
}
