#pragma once
#include <cmath>
#include <functional>

#include "files/missing.hpp"

namespace wavebalance::app {

/// The largest of a number of all rows, which a member or a function gives; missing without any.
template <class Rows, class Number>
double largest_of(const Rows& rows, const Number& number) {
  double value = missing;
  for (const auto& row : rows) value = std::fmax(value, std::invoke(number, row));
  return value;
}

/// The least likewise.
template <class Rows, class Number>
double least_of(const Rows& rows, const Number& number) {
  double value = missing;
  for (const auto& row : rows) value = std::fmin(value, std::invoke(number, row));
  return value;
}

}  // namespace wavebalance::app
