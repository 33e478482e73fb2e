// Every law of the catalogue, made of values that its own description allows.
#include "wavebalance/contact/catalogue.hpp"

#include "temporary_folder.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

/// A value in the range that differs from its ends.
double value_inside(const LawRange& range) {
  if (std::isfinite(range.upper)) return 0.5 * (range.lower + range.upper);
  return std::isfinite(range.lower) ? range.lower + 0.75 : 0.75;
}

/// Numbers just outside the range, and those that no range has.
std::vector<double> values_outside(const LawRange& range) {
  std::vector<double> values{nan, infinity};
  if (std::isfinite(range.lower)) values.push_back(range.lower_excluded ? range.lower : range.lower - 1e-9);
  if (std::isfinite(range.upper)) values.push_back(range.upper + 1e-9);
  if (range.zero_excluded) values.push_back(0.0);
  return values;
}

class Catalogue : public ::testing::Test {
 protected:
  Catalogue() : table_(folder_.write("spring.csv", "-2,-4\n0,0\n1,2\n3,9\n").string()) {}

  LawValue example(const LawParameter& parameter) const {
    const double number = value_inside(parameter.range);
    if (parameter.kind == LawParameter::Kind::file) return table_;
    if (parameter.kind == LawParameter::Kind::number) return number;
    std::vector<double> list(static_cast<std::size_t>(parameter.length == 0 ? 3 : parameter.length));
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = number * static_cast<double>(i + 1);
    return list;
  }

  /// The values that must be given, or all.
  LawValues examples(const LawEntry& law, bool all) const {
    LawValues values;
    for (const LawParameter& one : law.parameters)
      if (all || one.required()) values.emplace(one.name, example(one));
    return values;
  }

  static std::string refusal(const LawEntry& law, const LawValues& values, const std::string& parameter) {
    try {
      law.make(values);
    } catch (const LawFault& fault) {
      EXPECT_EQ(fault.parameter(), parameter) << fault.what();
      return fault.what();
    }
    ADD_FAILURE() << law.name << " was made in spite of its " << parameter;
    return "";
  }

  TemporaryFolder folder_;
  std::string table_;
};

/// Central differences compared with the law's slopes, at rest and in motion, away from points where a
/// slope jumps.
template <class Law>
void check_derivatives(const Law& law, std::string_view name) {
  constexpr bool moving = requires { law.force(0.0, 0.0); };
  const auto force = [&](double u, double v) {
    if constexpr (moving)
      return law.force(u, v);
    else
      return law.force(u);
  };
  const auto tangent = [&](double u, double v) {
    if constexpr (moving)
      return law.tangent(u, v);
    else
      return law.tangent(u);
  };
  const double h = 1e-5;
  for (const double u : {-2.1, -0.93, -0.2, 0.31, 0.9, 1.13, 2.3}) {
    const double scale = std::abs(tangent(u, 0.0)) + std::abs(force(u, 0.0)) + 1.0;
    EXPECT_NEAR((law.potential(u + h) - law.potential(u - h)) / (2 * h), force(u, 0.0), 1e-7 * scale)
        << name << " at " << u;
    for (const double v : {0.0, 0.4}) {
      EXPECT_NEAR((force(u + h, v) - force(u - h, v)) / (2 * h), tangent(u, v), 1e-7 * scale)
          << name << " at " << u << ", " << v;
      if constexpr (moving) {
        EXPECT_NEAR((force(u, v + h) - force(u, v - h)) / (2 * h), law.damping(u, v), 1e-7 * scale)
            << name << " at " << u << ", " << v;
      }
    }
  }
}

TEST_F(Catalogue, MakesEveryLawFromValuesInItsRangesAndTheLawIsWhatTheRowSays) {
  for (const LawEntry& entry : law_catalogue())
    for (const bool all : {false, true}) {
      LawValues values = examples(entry, all);
      if (entry.acts_over_period)
        values.emplace("normal_load", 0.75);  // the limit without a normal direction
      if (values.contains("normal_load_speed2"))
        values["normal_load_speed2"] = 0.0;  // a scene adds it to normal_load at each frequency
      values.erase("normal_load_table");     // likewise
      std::visit(
          [&](const auto& law) {
            constexpr bool moving = requires { law.force(0.0, 0.0); };
            constexpr bool coupled = requires { law.penetration({}, {}); };
            constexpr bool signal = requires { law.reads_signal(); };
            constexpr bool has_rows = requires { law.rows(); };
            constexpr bool over_period = has_rows && !coupled;
            EXPECT_EQ(moving, entry.reads_velocity) << entry.name;
            EXPECT_EQ(coupled && !signal, entry.acts_in_plane) << entry.name;
            EXPECT_EQ(signal, entry.reads_signal) << entry.name;
            EXPECT_EQ(over_period, entry.acts_over_period) << entry.name;
            if constexpr (over_period) {
              EXPECT_EQ(law.friction(), value_inside(entry.find("friction")->range)) << entry.name;
              EXPECT_EQ(law.normal_stiffness(), all ? 0.75 : 0.0) << entry.name;
              return;
            } else if constexpr (coupled) {
              EXPECT_EQ(law.gap(), values.contains("gap") ? 0.75 : 0.0) << entry.name;
            } else {
              if (entry.has_gap()) {
                EXPECT_EQ(law.gap(), 0.75) << entry.name;
              }
              if (entry.beyond_gap_alone) {
                EXPECT_TRUE(law.unilateral()) << entry.name;
              }
              if constexpr (!moving) {
                EXPECT_EQ(std::isinf(law.force(1e3)), entry.rigid) << entry.name;
              }
              if (!entry.rigid) check_derivatives(law, entry.name);
            }
          },
          entry.make(values));
    }
}

TEST_F(Catalogue, HasEachNameOnceAndOneMeaningForAParameterName) {
  std::vector<std::string_view> names;
  std::vector<LawParameter> known;
  for (const LawEntry& entry : law_catalogue()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), entry.name), 0) << entry.name;
    EXPECT_EQ(&law_entry(entry.name), &entry);
    EXPECT_FALSE(entry.force.empty()) << entry.name;
    names.push_back(entry.name);
    for (const LawParameter& one : entry.parameters) {
      EXPECT_FALSE(one.help.empty()) << entry.name << "." << one.name;
      for (const LawParameter& other : known)
        if (other.name == one.name) {
          EXPECT_EQ(other.unit, one.unit) << one.name;
          EXPECT_EQ(other.kind, one.kind) << one.name;
          EXPECT_EQ(other.fallback, one.fallback) << one.name;
          EXPECT_EQ(other.same_as, one.same_as) << one.name;
        }
      known.push_back(one);
    }
  }
}

TEST_F(Catalogue, RefusesANumberOutOfRangeWithParameterValueAndRange) {
  for (const LawEntry& entry : law_catalogue())
    for (const LawParameter& one : entry.parameters) {
      if (one.kind == LawParameter::Kind::file) continue;
      for (const double outside : values_outside(one.range)) {
        LawValues values = examples(entry, true);
        LawValue& value = values.at(std::string(one.name));
        if (auto* list = std::get_if<std::vector<double>>(&value))
          list->back() = outside;
        else
          value = outside;
        const std::string text = refusal(entry, values, std::string(one.name));
        EXPECT_NE(text.find(std::string(one.name) + " is "), std::string::npos) << text;
        EXPECT_NE(text.find(one.range.text()), std::string::npos) << text;
      }
    }
}

TEST_F(Catalogue, RefusesMissingUnknownAndWrongKindsOfValues) {
  for (const LawEntry& entry : law_catalogue()) {
    LawValues values = examples(entry, true);
    values.emplace("softness", 1.0);
    EXPECT_NE(refusal(entry, values, "softness").find("no parameter of it"), std::string::npos);
    for (const LawParameter& one : entry.parameters) {
      const std::string name(one.name);
      values = examples(entry, true);
      values[name] = one.kind == LawParameter::Kind::file ? LawValue(1.0) : LawValue(std::string("stiff"));
      EXPECT_NE(refusal(entry, values, name).find("it must be "), std::string::npos);
      if (!one.required()) continue;
      values.erase(name);
      EXPECT_NE(refusal(entry, values, name).find("is missing; the law takes "), std::string::npos);
    }
  }
}

TEST_F(Catalogue, NamesAllLawsWhereThereIsNone) {
  try {
    law_entry("liner");
    FAIL();
  } catch (const LawFault& fault) {
    const std::string text = fault.what();
    EXPECT_NE(text.find("\"liner\"; expected one of \"none\", \"exponential\", \"linear\""),
              std::string::npos)
        << text;
  }
}

TEST_F(Catalogue, TakesADefaultFromAnotherParameter) {
  const AnyLaw law = law_entry("clearance").make({{"stiffness", 3.0}, {"gap", 0.5}});
  EXPECT_EQ(std::get<ClearanceLaw>(law).below().stiffness, 3.0);
  EXPECT_EQ(std::get<ClearanceLaw>(law).below().gap, 0.5);
}

}  // namespace
}  // namespace wavebalance::contact
