#include <catch2/catch.hpp>

#include "io/formats/freesurfer_reader.h"
#include "io/formats/freesurfer_writer.h"
#include "io/reading.h"
#include "sphparam/errors.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/vertex_data.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// As FreeSurfer writes it: big-endian, two line ends, a footer with the volume.
const std::string geometry =
    "valid = 1  # volume info valid\nfilename = ../mri/filled.mgz\nvolume = 256 256 256\n"
    "voxelsize = 1.000000000000000e+00 1.000000000000000e+00 1.000000000000000e+00\n"
    "xras   = -1.0 0.0 0.0\nyras   = 0.0 0.0 -1.0\nzras   = 0.0 1.0 0.0\ncras   = 0.5 -1.25 3.0\n";

std::string as_written_by_freesurfer(const std::string& footer) {
  MeshFile file;
  file.mesh = tetrahedron();
  file.comments = {"freesurfer created by greg on Thu Oct  1 12:00:00 2015"};
  return serialise_freesurfer(file) + footer;
}

const std::string tags = std::string("\0\0\0\2\0\0\0\0\0\0\0\x14", 12);

}  // namespace

TEST_CASE("freesurfer: a surface is read with its making and its volume, and written the same") {
  const std::string bytes = as_written_by_freesurfer(tags + geometry);
  CHECK(
      bytes.starts_with("\xff\xff\xfe"
                        "created by greg on Thu Oct  1 12:00:00 2015\n\n" +
                        std::string("\0\0\0\4\0\0\0\4\x3f\x80\0\0", 12)));
  const MeshFile file = read(bytes, "lh.white");
  CHECK(file.format == "FreeSurfer surface");
  CHECK(file.mesh.positions == tetrahedron().positions);
  CHECK(file.mesh.triangles == tetrahedron().triangles);
  CHECK(file.position_type == ScalarType::Float32);
  CHECK(file.notes.empty());
  CHECK(file.comments.size() == 11);
  CHECK(file.comments.at(9) == "freesurfer geometry cras   = 0.5 -1.25 3.0");
  CHECK(file.comments.at(10) == "gifti AnatomicalStructurePrimary CortexLeft");
  CHECK(serialise_freesurfer(file) == bytes);
}

TEST_CASE("freesurfer: what is said of a surface goes through other formats and back") {
  const std::string bytes = as_written_by_freesurfer(tags + geometry);
  const MeshFile file = read(bytes, "lh.white");
  for (const char* name : {"a.ply", "a.vtk", "a.vtp", "a.obj"})
    CHECK(serialise_freesurfer(read(serialise_mesh(name, file), name)) == bytes);
}

TEST_CASE("freesurfer: the side that a name says goes along where other names do not say it") {
  const std::string bytes = as_written_by_freesurfer("");
  const auto in_gifti = [](const MeshFile& file) {
    const MeshFile ply = read(serialise_mesh("sub01.sph.ply", file), "sub01.sph.ply");
    return structure_of(read(serialise_mesh("a.surf.gii", ply), "a.surf.gii"), "a.surf.gii");
  };
  CHECK(in_gifti(read(bytes, "rh.white")) == "CortexRight");
  CHECK(in_gifti(read(bytes, "bert/surf/lh.pial")) == "CortexLeft");
  CHECK(in_gifti(read(bytes, "white")).empty());
}

TEST_CASE("freesurfer: the volume geometry is metadata in GIFTI, and comes back as it was") {
  for (const char* real_ras : {"0", "1"}) {
    MeshFile file = read(as_written_by_freesurfer(tags + geometry), "lh.white");
    for (std::string& comment : file.comments)
      if (comment.starts_with("freesurfer real_ras")) comment.back() = *real_ras;
    const std::string gifti = serialise_mesh("lh.white.surf.gii", file);
    for (const char* value : {"256", "0.5", "-1.25", "3.0", "1.000000000000000e+00"})
      CHECK(contains(gifti, "<![CDATA[" + std::string(value) + "]]>"));
    for (const char* key : {"VolGeomWidth", "VolGeomZsize", "VolGeomX_R", "VolGeomC_S"})
      CHECK(contains(gifti, key));
    CHECK(contains(gifti, "NIFTI_XFORM_SCANNER_ANAT") == (*real_ras == '1'));
    const MeshFile back = read(gifti, "lh.white.surf.gii");
    CHECK(losses_among(back.notes).empty());
    file.comments[0] = "freesurfer created by sphparam";  // which GIFTI has no place for
    CHECK(serialise_freesurfer(back) == serialise_freesurfer(file));
  }
}

TEST_CASE("freesurfer: a volume geometry that is none, or not all there, is not made up") {
  const MeshFile whole = read(as_written_by_freesurfer(tags + geometry), "lh.white");
  const auto gifti = [&](const std::string& from, const std::string& to) {
    MeshFile file = whole;
    for (std::string& comment : file.comments) comment = replaced(comment, from, to);
    return serialise_mesh("x.surf.gii", file);
  };
  for (const auto& [from, to] : {std::pair("valid = 1", "valid = 0"), std::pair("cras", "x"),
                                 std::pair("-1.25", "nan"), std::pair("-1.25", "")})
    CHECK_FALSE(contains(gifti(from, to), "VolGeom"));
  // As long as what lines of the geometry begin with, which is all that they are known by.
  MeshFile told = whole;
  told.comments.insert(told.comments.begin(), "the volume moved to cras = 9 9 9");
  CHECK(contains(serialise_mesh("x.surf.gii", told), "<![CDATA[-1.25]]>"));
  const std::string broken = replaced(gifti("x", "x"), "-1.25", "far");
  const MeshFile read_back = read(broken, "x.surf.gii");
  CHECK(contains(losses_among(read_back.notes).at(0), "VolGeom"));
  CHECK_FALSE(contains(serialise_freesurfer(read_back), "cras"));
}

TEST_CASE("freesurfer: a sphere has the footer of its surface, and in GIFTI no volume") {
  const MeshFile file = read(as_written_by_freesurfer(tags + geometry), "lh.white");
  const MeshFile sphere = sphere_mesh(file, {file.mesh.positions}, {{"verdict", "bijective"}});
  const std::string bytes = serialise_mesh("lh.sphere", sphere, {.is_sphere = true});
  CHECK(contains(bytes, tags + geometry));
  CHECK(contains(bytes, "created by sphparam"));
  CHECK_FALSE(contains(serialise_mesh("s.surf.gii", sphere, {.is_sphere = true}), "VolGeom"));
}

TEST_CASE("freesurfer: a footer may be missing, start with its geometry, or say more") {
  CHECK(read(as_written_by_freesurfer("")).notes.empty());
  CHECK(read(as_written_by_freesurfer(tags.substr(8) + geometry)).comments.size() == 9);
  const MeshFile more =
      read(as_written_by_freesurfer(tags + geometry + std::string("\0\0\0\3commands", 12)));
  CHECK(losses_among(more.notes).size() == 1);
  CHECK(more.comments.size() == 10);
  const MeshFile other = read(as_written_by_freesurfer("something else"));
  CHECK(contains(losses_among(other.notes).at(0), "14 bytes"));
}

TEST_CASE("freesurfer: what is no surface is refused by name, what is cut short by the place") {
  CHECK(contains(complaint(std::string("\xff\xff\xff\0\0\0\4", 7), "lh.curv"), "file of values"));
  CHECK(contains(complaint("# HyperSurface 0.1 ASCII\n\nParameters {\n}\n", "a.surf"),
                 "a.surf: this is a surface of Amira or Avizo (HyperSurface)"));
  const std::string bytes = as_written_by_freesurfer("");
  for (std::size_t size = 3; size < bytes.size(); ++size) {
    INFO(size);
    CHECK(contains(complaint(bytes.substr(0, size), "lh.white"), "lh.white"));
  }
  // Before there is room made for all that was announced.
  CHECK(contains(complaint(bytes.substr(0, bytes.size() - 60)), "the coordinates and triangles"));
  CHECK(contains(complaint(bytes.substr(0, bytes.size() - 1)), "the coordinates and triangles"));
  std::string beyond = bytes;
  beyond.back() = 9;
  CHECK(contains(complaint(beyond), "names vertex 9 of 4"));
}

TEST_CASE("freesurfer: doubles are rounded and told, what 32 bits cannot hold is refused") {
  MeshFile file;
  file.mesh = icosphere(2);
  const MeshFile back = read(serialise_freesurfer(file));
  CHECK((back.mesh.positions - file.mesh.positions).cwiseAbs().maxCoeff() < 1e-7);
  CHECK(contains(losses_of_writing(file, back).at(0), "of 162 vertices"));
  file.mesh.positions *= 1e300;
  CHECK_THROWS_AS(serialise_freesurfer(file), WriteError);
  file.mesh = icosphere(2);
  file.mesh.positions *= 1e-33;
  CHECK_THROWS_AS(serialise_freesurfer(file), UnmeasurableMesh);
}

TEST_CASE("freesurfer: names of surfaces ask for the format, also for a sphere") {
  for (const char* name : {"lh.white", "rh.pial", "lh.sphere", "lh.sphere.reg", "a.surf"}) {
    CHECK(is_written(name));
    CHECK(has_float_spheres(name));
  }
  CHECK_FALSE(has_float_spheres("a.ply"));
}
