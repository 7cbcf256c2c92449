#pragma once

#include <filesystem>

namespace sphparam {

/// The file of the running program, links followed: what belongs to it is found from there, so that
/// all of it can be moved together. As `link` says; where nobody mounted /proc, by the name that
/// the program was started by; empty where that is gone too.
std::filesystem::path program_path(const std::filesystem::path& link = "/proc/self/exe");

}  // namespace sphparam
