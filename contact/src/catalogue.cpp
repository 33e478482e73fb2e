#include "wavebalance/contact/catalogue.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace wavebalance::contact {
namespace {

template <class Law>
LawEntry entry_of() {
  constexpr bool reads_velocity = requires(const Law& law) { law.force(0.0, 0.0); };
  constexpr bool has_rows = requires(const Law& law) { law.rows(); };
  constexpr bool has_penetration = requires(const Law& law) { law.penetration({}, {}); };
  constexpr bool reads_signal = requires(const Law& law) { law.reads_signal(); };
  return {Law::description(),
          reads_velocity,
          has_rows && !has_penetration,
          has_penetration && !reads_signal,
          reads_signal,
          [](const LawValues& values) -> AnyLaw { return Law::of(values); }};
}

template <std::size_t... Row>
std::vector<LawEntry> entries(std::index_sequence<Row...>) {
  return {entry_of<std::variant_alternative_t<Row, AnyLaw>>()...};
}

}  // namespace

AnyLaw LawEntry::make(const LawValues& values) const {
  const LawValues complete = complete_values(*this, values);
  try {
    return maker(complete);
  } catch (const LawFault&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw LawFault(parameters.empty() ? "" : std::string(parameters.front().name), error.what());
  }
}

const std::vector<LawEntry>& law_catalogue() {
  static const std::vector<LawEntry> all = entries(std::make_index_sequence<std::variant_size_v<AnyLaw>>());
  return all;
}

const LawEntry& law_entry(std::string_view name) {
  const std::vector<LawEntry>& all = law_catalogue();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const LawEntry& one) { return one.name == name; });
  if (found != all.end()) return *found;
  std::string names;
  for (const LawEntry& one : all) names += (names.empty() ? "\"" : ", \"") + std::string(one.name) + "\"";
  throw LawFault("", "there is no law \"" + std::string(name) + "\"; expected one of " + names);
}

}  // namespace wavebalance::contact
