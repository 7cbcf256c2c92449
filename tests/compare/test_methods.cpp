#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "compare/methods.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

TEST_CASE("methods: every one has a name of its own, under which it is found") {
  std::set<std::string> names;
  for (const MethodInfo& info : all_methods()) {
    CHECK(names.insert(info.name).second);
    CHECK(method_named(info.name) == info.method);
    CHECK(info_of(info.method).name == std::string(info.name));
  }
  CHECK(info_of(Method::Radial).name == std::string("radial"));
  CHECK(names.size() == 9);
  CHECK(all_methods().front().method == AnyMethod(Method::Progressive));
  CHECK_FALSE(method_named("tangentia"));
}

TEST_CASE("methods: each runs, and the certificate is of the map it made") {
  const TriangleMesh mesh = random_sphere_mesh(400, 3);
  const Topology topology(mesh);
  for (const MethodInfo& info : all_methods()) {
    INFO(info.name);
    const MethodRun run = run_method(info.method, mesh, topology, {});
    REQUIRE(run.result.map.points.rows() == mesh.vertex_count());
    const Certificate again = certify(topology, run.result.map);
    CHECK(again.bijective() == run.result.certificate.bijective());
    CHECK(again.fold_count() == run.result.certificate.fold_count());
    const bool of_others = std::holds_alternative<Baseline>(info.method);
    CHECK(run.account.has_value() == of_others);
    if (!of_others) continue;
    CHECK(run.result.made_by == info.name);
    CHECK_FALSE(run.account->statement.empty());
    CHECK_FALSE(run.result.stages.empty());
  }
}

TEST_CASE("methods: what others fold is mended when asked, and only then") {
  const TriangleMesh mesh = tube(60, 5);
  const Topology topology(mesh);
  long folded = 0;
  for (const MethodInfo& info : all_methods()) {
    if (!std::holds_alternative<Baseline>(info.method)) continue;
    INFO(info.name);
    const MethodRun as_made = run_method(info.method, mesh, topology, {});
    const MethodRun mended = run_method(info.method, mesh, topology, {.repair_paper = true});
    if (as_made.result.map.points.rows() == 0) continue;
    CHECK(mended.result.certificate.bijective());
    if (as_made.result.certificate.bijective()) {
      CHECK(mended.result.map.points == as_made.result.map.points);
      CHECK(mended.result.made_by == info.name);
    } else {
      ++folded;
      CHECK(mended.result.made_by != info.name);
    }
  }
  CHECK(folded > 0);
}
