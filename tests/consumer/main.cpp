// Maps an octahedron by the library, prints its certificate, and writes the mesh for the
// installed program.

#include <sphparam/parameterize.h>

#include <Eigen/Core>
#include <fstream>
#include <iostream>

/// Eigen's products of large matrices use the widest vectors that this program is compiled for;
/// what the library asks of its users must not break them.
bool multiplies() {
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(600, 600);
  return ((ones * ones).array() == 600).all();
}

int main(int argc, char** argv) {
  sphparam::TriangleMesh mesh;
  mesh.positions.resize(6, 3);
  mesh.positions << 2, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;

  const sphparam::Parameterization result = sphparam::parameterize(mesh);
  const sphparam::DistortionSummary distortion =
      sphparam::summarise(sphparam::measure_distortion(mesh, result.map));
  std::cout << "one-to-one: " << (result.certificate.bijective() ? "yes" : "no")
            << "\nfolds: " << result.certificate.fold_count()
            << "\ndegree: " << result.certificate.degree
            << "\nmean |ln angle|: " << distortion.mean_abs_ln_angle << "\n";

  std::ofstream file(argc > 1 ? argv[1] : "octahedron.obj");
  for (const auto& p : mesh.positions.rowwise()) file << "v " << p << "\n";
  for (const auto& t : mesh.triangles.rowwise()) file << "f " << (t.array() + 1) << "\n";
  return file && multiplies() && result.certificate.bijective() ? 0 : 1;
}
