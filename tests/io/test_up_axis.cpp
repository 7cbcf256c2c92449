#include <catch2/catch.hpp>
#include <limits>

#include "sphparam/io/up_axis.h"

using namespace sphparam;

namespace {

const std::vector<std::string> names = {"x", "-x", "y", "-y", "z", "-z"};

Vector3 named(const std::string& name) { return direction_named(name).value(); }

Up wish(const std::string& up, const std::string& front = "") {
  return {direction_named(up), direction_named(front)};
}

}  // namespace

TEST_CASE("up: directions have names, and other directions numbers that read back the same") {
  for (const std::string& name : names) CHECK(name_of_direction(named(name)) == name);
  CHECK(named("-y") == Vector3(0, -1, 0));
  CHECK(named("0,0,2") == Vector3(0, 0, 1));
  const Vector3 askew = named("0.3,-4,1e300");
  CHECK(askew.isApprox(Vector3(0, 0, 1)));
  const Vector3 third = named("1,1,1");
  CHECK((named(name_of_direction(third)) - third).norm() < 1e-15);
  for (const char* text :
       {"", "w", "--x", "0,0,0", "1,2", "1,2,3,4", "1,2,nan", "inf,0,0", "1 2 3"})
    CHECK_FALSE(direction_named(text));
}

TEST_CASE("up: every pair of axes makes a rotation that puts up on y and the front on z, exactly") {
  for (const std::string& up : names)
    for (const std::string& front : names) {
      if (up.back() == front.back()) {
        CHECK_THROWS_AS(upright_axes({}, wish(up, front)), FrontError);
        continue;
      }
      const Eigen::Matrix3d rotation = upright_rotation(upright_axes({}, wish(up, front)));
      CHECK(rotation * named(up) == Vector3(0, 1, 0));
      CHECK(rotation * named(front) == Vector3(0, 0, 1));
      CHECK(rotation.determinant() == 1);
    }
}

TEST_CASE("up: what is askew is made upright, the front as near as it can be") {
  const UprightAxes axes = upright_axes({}, wish("0.1,0.2,1", "1,0,1"));
  const Eigen::Matrix3d rotation = upright_rotation(axes);
  CHECK((rotation * rotation.transpose()).isIdentity(1e-14));
  CHECK((rotation * Vector3(0.1, 0.2, 1).normalized() - Vector3::UnitY()).norm() < 1e-14);
  const Vector3 front = rotation * Vector3(1, 0, 1);
  CHECK(std::abs(front.x()) < 1e-14);
  CHECK(front.z() > 0);
  CHECK_THROWS_AS(upright_axes({}, wish("0.1,0.2,1", "0.2,0.4,2")), FrontError);
}

TEST_CASE("up: glTF's own axes stay, z up looks along −y, a direction that is none is refused") {
  CHECK(upright_rotation(upright_axes({}, wish("y"))).isIdentity(0));
  CHECK(upright_rotation(upright_axes({})) * Vector3(1, 2, 3) == Vector3(1, 3, -2));
  for (const std::string& up : names) CHECK_NOTHROW(upright_axes({}, wish(up)));
  CHECK_THROWS_AS(upright_axes({}, {.direction = Vector3::Zero()}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(upright_axes({}, {.front = Vector3(nan, 0, 1)}), std::invalid_argument);
}

TEST_CASE("up: comments keep it, what is asked for goes first and replaces them") {
  MeshFile file;
  file.comments = {"made by hand", "up axis banana"};
  const MeshFile plain = file;
  note_up(file, {});
  CHECK(file.comments == plain.comments);
  note_up(file, wish("y", "-x"));
  CHECK(file.comments.size() == 4);
  CHECK(file.comments[2] == "up axis y");
  CHECK(file.comments[3] == "front axis -x");
  CHECK(upright_axes(file).up == Vector3(0, 1, 0));
  CHECK(upright_axes(file).front == Vector3(-1, 0, 0));
  CHECK(upright_axes(file, wish("z")).front == Vector3(-1, 0, 0));
  CHECK(upright_axes(file, wish("x")).front == Vector3(0, -1, 0));  // −x is along it
  CHECK_THROWS_AS(upright_axes(file, wish("", "y")), FrontError);
  note_up(file, wish("-z"));
  CHECK(noted_up(file) == wish("-z", "-x"));
  take_up(file, plain);
  CHECK(file.comments == plain.comments);
}
