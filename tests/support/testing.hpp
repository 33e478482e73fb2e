#pragma once
// Headers that nearly every test needs, most of them in the precompiled headers of all test programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "constants.hpp"
