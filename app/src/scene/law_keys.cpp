#include "scene/law_keys.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace wavebalance::app {
namespace {

using Type = ContactLawType;

struct ConstantOfLaws {
  std::string_view name;
  std::vector<Type> laws;
  bool needed = true;
};

const std::vector<ConstantOfLaws>& constants() {
  static const std::vector<ConstantOfLaws> all{
      {"constant", {Type::exponential}},
      {"exponent", {Type::exponential}},
      {"stiffness", {Type::linear, Type::clearance, Type::kelvin_voigt}},
      {"gap",
       {Type::exponential, Type::linear, Type::rigid, Type::bilinear, Type::clearance, Type::hunt_crossley,
        Type::kelvin_voigt}},
      {"slopes", {Type::bilinear}},
      {"cubic_stiffness", {Type::cubic}},
      {"polynomial", {Type::polynomial}},
      {"stiffness_below", {Type::clearance}, false},
      {"gap_below", {Type::clearance}, false},
      {"table", {Type::table}},
      {"hertz_stiffness", {Type::hunt_crossley}},
      {"power", {Type::hunt_crossley}, false},
      {"dissipation", {Type::hunt_crossley}},
      {"damping", {Type::kelvin_voigt}},
      {"damping_depth", {Type::kelvin_voigt}, false}};
  return all;
}

const ConstantOfLaws* find(std::string_view name) {
  const auto found = std::find_if(constants().begin(), constants().end(),
                                  [&](const ConstantOfLaws& one) { return one.name == name; });
  return found == constants().end() ? nullptr : &*found;
}

}  // namespace

bool law_takes(ContactLawType law, std::string_view key) {
  const ConstantOfLaws* constant = find(key);
  return constant != nullptr &&
         std::find(constant->laws.begin(), constant->laws.end(), law) != constant->laws.end();
}

bool law_needs(ContactLawType law, std::string_view key) { return law_takes(law, key) && find(key)->needed; }

std::span<const std::string_view> law_constant_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const ConstantOfLaws& one : constants()) all.push_back(one.name);
    return all;
  }();
  return names;
}

bool has_gap(ContactLawType law) { return law_takes(law, "gap"); }

bool is_damped(ContactLawType law) { return law == Type::hunt_crossley || law == Type::kelvin_voigt; }

bool acts_on_both_sides(ContactLawType law) {
  return law == Type::bilinear || law == Type::cubic || law == Type::polynomial || law == Type::clearance ||
         law == Type::table;
}

}  // namespace wavebalance::app
