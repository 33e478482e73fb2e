#pragma once
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace wavebalance {

/// Whether the compiler has a name for the value: it writes others as a cast, "(Enum)7".
template <class Enum, Enum value>
constexpr bool is_enumerator() {
  const std::string_view text = __PRETTY_FUNCTION__;
  return text[text.rfind('=') + 2] != '(';
}

/// The enumerators with values from 0 to 31, in this order.
template <class Enum>
std::vector<Enum> enumerators() {
  std::vector<Enum> found;
  const auto add = [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((is_enumerator<Enum, static_cast<Enum>(i)>() ? found.push_back(static_cast<Enum>(i)) : void()), ...);
  };
  add(std::make_index_sequence<32>());
  return found;
}

}  // namespace wavebalance
