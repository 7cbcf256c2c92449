#pragma once

#include <set>
#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// The words of a command line after the program; one that begins with @ is a file of the scene.
using Words = std::vector<std::string>;

/// What is run, and what must come of it. Names of files are within the scene's folder.
struct Errand {
  TriangleMesh mesh;                 // scans/mesh.off
  Words words;                       // what faults meet
  std::vector<std::string> outputs;  // besides what is written into the folder `found`
  std::string map = {};              // of these, one to be proved
  std::set<int> other_codes = {};    // that a fault may end it with besides
  std::string unnamed = {};          // of these, one that may not be there before
  std::string given = {};            // a file of tests/hostile, with the ending of its format
  std::vector<Words> before = {};    // run first, and once, for what this one reads
};

/// Throws: std::runtime_error where there is none of this name.
Errand errand_named(const std::string& name);

}  // namespace sphparam::tests
