#pragma once

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The value of that name in a record's summary; a test failure when it has none.
template <class Type>
Type value_of(const Summary& summary, const std::string& name) {
  for (const auto& [key, value] : summary)
    if (key == name) return std::get<Type>(value);
  ADD_FAILURE() << "no " << name;
  return {};
}

}  // namespace wavebalance::app
