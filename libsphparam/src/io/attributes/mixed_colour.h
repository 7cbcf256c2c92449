#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Whether a property of vertices of this name is of their colour: "red", "green", "blue", "alpha".
bool is_colour_name(std::string_view name);

/// Whether one of these properties is of the colour of vertices. A real number that is called "red"
/// and has no green and blue beside it is a number like others: the light of one band, say.
bool is_of_colour(const Property& property, const std::vector<Property>& properties);

/// What lies between colours, of one channel: the mean of its values, of a type, by their weights,
/// as light. Values are sRGB, and so is the mean; alpha, and where a value is beyond the curve, is
/// a plain mean. In the channel's type: whole numbers are rounded. It lies between the least and
/// the greatest value that has weight, and one with all the weight is copied. Requires: weights at
/// least 0 that sum to 1.
double mixed_colour(std::string_view channel, ScalarType type,
                    std::span<const std::pair<double, double>> weighed);

}  // namespace sphparam
