#pragma once

#include "srgb.h"
