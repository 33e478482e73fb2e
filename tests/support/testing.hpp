#pragma once
// What nearly every test needs, most of it in the precompiled headers of all test programs.
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
