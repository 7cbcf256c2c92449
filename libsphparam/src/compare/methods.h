#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// Methods of others, as `sphparam/baselines` has them: those the paper measures itself against.
enum class Baseline { Tangential, Hemispheres, Brechbuehler, Stereographic, Conformal, Flow };

/// Every way this program can map a mesh: ours, and those of others.
using AnyMethod = std::variant<Method, Baseline>;

struct MethodInfo {
  AnyMethod method;
  const char* name;      // on the command line
  const char* citation;  // authors and year; of ours: what it is
};

/// All that look for a map; ours come first, and of these the default: what is compared.
const std::vector<MethodInfo>& all_methods();
/// These, and the one that takes the map from where the mesh lies: radial.
const std::vector<MethodInfo>& mapping_methods();
const MethodInfo& info_of(AnyMethod method);
std::optional<AnyMethod> method_named(std::string_view name);  // one of `all_methods`

struct MethodRun {
  Parameterization result;  // no rows in its map: none was made
  std::optional<BaselineAccount> account = std::nullopt;
};

/// Maps a mesh by any method. A method of others runs as its authors have it, with the certificate
/// of what comes out; it reads `threads` and `progress`, and with `repair_paper` its folds are
/// mended by `repair_map`. `made_by` names what made the map in the end.
/// `options.method` is not read. Throws: as `parameterize`.
MethodRun run_method(AnyMethod method, const TriangleMesh& mesh, const Topology& topology,
                     ParameterizeOptions options);

}  // namespace sphparam
