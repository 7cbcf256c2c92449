#include "sphparam/io/up_axis.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "number_text.h"

// Axes of the mesh stay exact: 0 and ±1 are neither normalised nor projected, so that turning by
// them moves coordinates and rounds nothing.

namespace sphparam {
namespace {

constexpr std::string_view up_words = "up axis ", front_words = "front axis ";
constexpr double least_across = 1e-6;  // sine of the angle between up and front

const std::array<std::string, 3> axis_names = {"x", "y", "z"};

/// Is it x, −x, y, …?
bool is_axis(const Vector3& v) { return v.cwiseAbs().sum() == 1 && v.cwiseAbs().maxCoeff() == 1; }

Vector3 unit(const Vector3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!v.allFinite() || largest == 0)
    throw std::invalid_argument("a direction needs finite numbers that are not all 0");
  return is_axis(v) ? v : Vector3((v / largest).normalized());
}

std::optional<Vector3> three_numbers(std::string_view text) {
  Vector3 v;
  for (int k = 0; k < 3; ++k) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v[k]);
    if (error != std::errc() || !std::isfinite(v[k])) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (k == 2) break;
    if (!text.starts_with(',')) return std::nullopt;
    text.remove_prefix(1);
  }
  return text.empty() ? std::optional(v) : std::nullopt;
}

std::optional<Vector3> noted(const MeshFile& file, std::string_view words) {
  for (const std::string& comment : file.comments)
    if (comment.starts_with(words))
      if (const auto direction = direction_named(comment.substr(words.size()))) return direction;
  return std::nullopt;
}

void forget(MeshFile& file, std::string_view words) {
  std::erase_if(file.comments, [&](const std::string& comment) {
    return comment.starts_with(words) && direction_named(comment.substr(words.size()));
  });
}

void note(MeshFile& file, std::string_view words, const std::optional<Vector3>& direction) {
  if (!direction) return;
  forget(file, words);
  file.comments.push_back(std::string(words) + name_of_direction(*direction));
}

/// What looks at us where nobody says: see the header.
Vector3 usual_front(const Vector3& up) {
  const Vector3 a = up.cwiseAbs();
  return a.y() > std::max(a.x(), a.z()) ? Vector3(0, 0, 1) : Vector3(0, -1, 0);
}

/// The part of it that is across what is up, of length 1; nothing where there is none.
std::optional<Vector3> across(const Vector3& direction, const Vector3& up) {
  const Vector3 front = unit(direction);
  if (front.dot(up) == 0) return front;
  const Vector3 part = front - front.dot(up) * up;
  return part.norm() < least_across ? std::nullopt : std::optional<Vector3>(part.normalized());
}

}  // namespace

UprightAxes upright_axes(const MeshFile& file, const Up& wanted) {
  const Up said = noted_up(file);
  const Vector3 up = unit(wanted.direction.value_or(said.direction.value_or(Vector3(0, 0, 1))));
  if (wanted.front) {
    if (const auto front = across(*wanted.front, up)) return {up, *front};
    throw FrontError("the front, " + name_of_direction(*wanted.front) +
                     ", lies along what points up, " + name_of_direction(up));
  }
  const auto front = said.front ? across(*said.front, up) : std::nullopt;
  return {up, front ? *front : *across(usual_front(up), up)};
}

Eigen::Matrix3d upright_rotation(const UprightAxes& axes) {
  Eigen::Matrix3d rotation;
  rotation << axes.right().transpose(), axes.up.transpose(), axes.front.transpose();
  return rotation;
}

void note_up(MeshFile& file, const Up& wanted) {
  note(file, up_words, wanted.direction);
  note(file, front_words, wanted.front);
}

void take_up(MeshFile& file, const MeshFile& other) {
  forget(file, up_words);
  forget(file, front_words);
  note_up(file, noted_up(other));
}

Up noted_up(const MeshFile& file) { return {noted(file, up_words), noted(file, front_words)}; }

std::optional<Vector3> direction_named(const std::string& text) {
  const bool negative = text.starts_with('-');
  for (int k = 0; k < 3; ++k)
    if (text.substr(negative ? 1 : 0) == axis_names[static_cast<std::size_t>(k)])
      return Vector3((negative ? -1 : 1) * Vector3::Unit(k).array() + 0.0);
  const auto numbers = three_numbers(text);
  if (!numbers || numbers->isZero(0)) return std::nullopt;
  return unit(*numbers);
}

std::string name_of_direction(const Vector3& direction) {
  for (int k = 0; k < 3; ++k)
    if (is_axis(direction) && direction[k] != 0)
      return (direction[k] < 0 ? "-" : "") + axis_names[static_cast<std::size_t>(k)];
  return joined({shortest(direction[0]), shortest(direction[1]), shortest(direction[2])}, ",");
}

}  // namespace sphparam
