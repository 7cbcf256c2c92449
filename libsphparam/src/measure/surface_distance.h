#pragma once

#include "sphparam/measure/surface_distance.h"
