#pragma once

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The value of that name in a record's summary; a test failure when it has none.
template <class Type>
Type value_of(const Summary& summary, const std::string& name) {
  if (const Entry* entry = find_entry(summary, name)) return std::get<Type>(entry->value);
  ADD_FAILURE() << "no " << name;
  return {};
}

}  // namespace wavebalance::app
