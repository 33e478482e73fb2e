#pragma once
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wavebalance::contact {

/// The numbers that a parameter of a law may be.
struct LawRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_excluded = false;
  bool zero_excluded = false;

  /// Whether `value` is finite and in the range.
  bool contains(double value) const;
  /// "finite and above 0", "finite and at least 0", "in 1..10", "finite and not zero", "finite".
  std::string text() const;
  bool operator==(const LawRange&) const = default;
};

inline constexpr LawRange above_zero{.lower = 0.0, .lower_excluded = true};
inline constexpr LawRange at_least_zero{.lower = 0.0};
inline constexpr LawRange zero_to_one{.lower = 0.0, .upper = 1.0};
inline constexpr LawRange other_than_zero{.zero_excluded = true};

/// One parameter of a law. One that has neither `fallback` nor `same_as` must be given unless it `may_lack`.
/// Parameters of one name have the same unit, kind and default in all laws.
struct LawParameter {
  enum class Kind { number, list, file };

  std::string_view name;  ///< as a key of a scene
  std::string_view unit;  ///< empty for pure numbers and files
  std::string_view help;
  LawRange range = {};  ///< of the number, or of each entry of the list
  Kind kind = Kind::number;
  int length = 0;                       ///< number of entries of a list; 0: any from 1 on
  std::optional<double> fallback = {};  ///< the value where none is given
  std::string_view same_as = {};        ///< or the parameter whose value it then has
  bool may_lack = false;                ///< the law is another one without it

  bool required() const { return !fallback && same_as.empty() && !may_lack; }
};

/// Description of a law by static texts; copies are cheap.
struct LawDescription {
  std::string_view name;   ///< as contact.law of a scene
  std::string_view force;  ///< the force in words and formulas of the parameters, opposed to u
  std::vector<LawParameter> parameters = {};
  bool beyond_gap_alone = true;  ///< whether no force acts below the gap, whatever the parameters
  bool rigid = false;            ///< whether the force beyond the gap is infinite

  /// The parameter of this name, or nullptr.
  const LawParameter* find(std::string_view parameter) const;
  bool has_gap() const { return find("gap") != nullptr; }
};

/// A number, a list of them, or the name of a file.
using LawValue = std::variant<double, std::vector<double>, std::string>;
/// Values of parameters by name.
using LawValues = std::map<std::string, LawValue, std::less<>>;

/// Values that make no law. The message names the law, the parameter, the value and what is allowed.
class LawFault : public std::invalid_argument {
 public:
  LawFault(std::string parameter, const std::string& message)
      : std::invalid_argument(message), parameter_(std::move(parameter)) {}
  const std::string& parameter() const { return parameter_; }  ///< empty where no parameter is at fault

 private:
  std::string parameter_;
};

/// The values with those filled in that have a default. Throws LawFault for a name that is no parameter, a
/// parameter that is missing or of another kind, and a value out of range.
LawValues complete_values(const LawDescription& law, LawValues values);

/// The number of a parameter that may lack, or `without` it.
double number_or(const LawValues& values, std::string_view name, double without);
/// Complete values by name. Throw std::out_of_range for others.
double number_of(const LawValues& values, std::string_view name);
const std::vector<double>& list_of(const LawValues& values, std::string_view name);
const std::string& file_of(const LawValues& values, std::string_view name);

/// A parameter with a default.
constexpr LawParameter with_default(LawParameter parameter, double value) {
  parameter.fallback = value;
  return parameter;
}
/// A parameter that has the value of another where none is given.
constexpr LawParameter same_as(std::string_view other, LawParameter parameter) {
  parameter.same_as = other;
  return parameter;
}
/// A parameter that need not be given.
constexpr LawParameter may_lack(LawParameter parameter) {
  parameter.may_lack = true;
  return parameter;
}
/// A list of `length` numbers, or of any from 1 on.
constexpr LawParameter list_parameter(LawParameter entries, int length = 0) {
  entries.kind = LawParameter::Kind::list;
  entries.length = length;
  return entries;
}
/// The name of a file.
constexpr LawParameter file_parameter(std::string_view name, std::string_view help) {
  return {name, "", help, {}, LawParameter::Kind::file};
}

/// The gap of most laws.
inline constexpr LawParameter gap_parameter{"gap", "m",
                                            "displacement towards the obstacle at which contact starts"};

}  // namespace wavebalance::contact
