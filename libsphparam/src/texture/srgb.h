#pragma once

#include "srgb_curves.h"
