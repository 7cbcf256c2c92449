#pragma once

namespace sphparam::cli {

/// Options that (nearly) all subcommands have, -q, -v, --progress, --threads, --max-memory and
/// --limit, may stand before the subcommand too: puts the subcommand in front of them, in place.
/// Words are left as they are where anything else stands there.
void put_subcommand_first(int argc, char** argv);

}  // namespace sphparam::cli
