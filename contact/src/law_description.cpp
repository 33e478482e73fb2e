#include "wavebalance/contact/law_description.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace wavebalance::contact {
namespace {

std::string names_text(const LawDescription& law) {
  std::string text;
  for (const LawParameter& one : law.parameters) text += (text.empty() ? "" : ", ") + std::string(one.name);
  return text.empty() ? "none" : text;
}

[[noreturn]] void fail(const LawDescription& law, std::string_view parameter, const std::string& rest) {
  throw LawFault(std::string(parameter),
                 "the law \"" + std::string(law.name) + "\": " + std::string(parameter) + rest);
}

void require_in_range(const LawDescription& law, const LawParameter& parameter, double value) {
  if (parameter.range.contains(value)) return;
  const std::string unit = parameter.unit.empty() ? "" : " in " + std::string(parameter.unit);
  fail(law, parameter.name,
       " is " + detail::text(value) + "; it must be a number" + unit + ", " + parameter.range.text());
}

void require_list(const LawDescription& law, const LawParameter& parameter, const std::vector<double>& list) {
  const auto length = static_cast<std::size_t>(parameter.length);
  if (list.empty() || (length > 0 && list.size() != length))
    fail(law, parameter.name,
         " has " + std::to_string(list.size()) + " entries; it must have " +
             (length > 0 ? std::to_string(length) : "one or more"));
  for (const double one : list) require_in_range(law, parameter, one);
}

void require_value(const LawDescription& law, const LawParameter& parameter, const LawValue& value) {
  constexpr std::string_view kinds[] = {"a number", "a list of numbers", "the name of a file"};
  if (value.index() != static_cast<std::size_t>(parameter.kind))
    fail(law, parameter.name,
         " is " + std::string(kinds[value.index()]) + "; it must be " +
             std::string(kinds[static_cast<std::size_t>(parameter.kind)]));
  if (const auto* number = std::get_if<double>(&value)) require_in_range(law, parameter, *number);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) require_list(law, parameter, *list);
  if (const auto* file = std::get_if<std::string>(&value); file && file->empty())
    fail(law, parameter.name, " is empty; it must be the name of a file");
}

const LawValue& value_of(const LawValues& values, std::string_view name) {
  const auto found = values.find(name);
  if (found == values.end())
    throw std::out_of_range("a law takes the parameter " + std::string(name) + ", which has no value");
  return found->second;
}

}  // namespace

bool LawRange::contains(double value) const {
  return std::isfinite(value) && (lower_excluded ? value > lower : value >= lower) && value <= upper &&
         !(zero_excluded && value == 0.0);
}

std::string LawRange::text() const {
  if (zero_excluded) return "finite and not zero";
  if (std::isfinite(upper))
    return (lower_excluded ? "above " + detail::text(lower) + " and at most "
                           : "in " + detail::text(lower) + "..") +
           detail::text(upper);
  if (!std::isfinite(lower)) return "finite";
  return std::string("finite and ") + (lower_excluded ? "above " : "at least ") + detail::text(lower);
}

const LawParameter* LawDescription::find(std::string_view parameter) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const LawParameter& one) { return one.name == parameter; });
  return found == parameters.end() ? nullptr : &*found;
}

LawValues complete_values(const LawDescription& law, LawValues values) {
  for (const auto& [name, value] : values)
    if (law.find(name) == nullptr)
      fail(law, name, " is no parameter of it; expected one of " + names_text(law));
  for (const LawParameter& parameter : law.parameters) {
    const auto given = values.find(parameter.name);
    if (given == values.end() && parameter.required())
      fail(law, parameter.name, " is missing; the law takes " + names_text(law));
    if (given == values.end() && parameter.may_lack) continue;
    if (given == values.end() && parameter.fallback)
      values.emplace(parameter.name, *parameter.fallback);
    else if (given == values.end())
      values.emplace(parameter.name, value_of(values, parameter.same_as));
    require_value(law, parameter, value_of(values, parameter.name));
  }
  return values;
}

double number_of(const LawValues& values, std::string_view name) {
  return std::get<double>(value_of(values, name));
}

double number_or(const LawValues& values, std::string_view name, double without) {
  return values.contains(name) ? number_of(values, name) : without;
}

const std::vector<double>& list_of(const LawValues& values, std::string_view name) {
  return std::get<std::vector<double>>(value_of(values, name));
}

const std::string& file_of(const LawValues& values, std::string_view name) {
  return std::get<std::string>(value_of(values, name));
}

}  // namespace wavebalance::contact
