#include "sums_choices.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

using Json = nlohmann::ordered_json;

constexpr double parts_of_range = 5000.0;

/// Integers of 1/parts_of_range of the range of all curves.
class Units {
 public:
  explicit Units(const Values& curves) {
    for (const auto& one : curves)
      if (one.allFinite()) {
        lower_ = std::min(lower_, one.minCoeff());
        upper_ = std::max(upper_, one.maxCoeff());
      }
  }
  double unit() const { return (upper_ - lower_) / parts_of_range; }
  Json operator()(const Eigen::VectorXd& values) const {
    if (!values.allFinite()) return nullptr;
    Json list = Json::array();
    for (const double value : values) list.push_back(std::lround(value / unit()));
    return list;
  }

 private:
  double lower_ = std::numeric_limits<double>::infinity(), upper_ = -lower_;
};

/// The verdict under a reading of each statement that has it: place among the statements and the word.
Json verdicts_under(const report::Artefact& artefact, const std::string& name) {
  Json list = Json::array();
  for (std::size_t i = 0; i < artefact.statements().size(); ++i)
    for (const auto& reading : artefact.statements()[i].readings)
      if (reading.name == name || reading.name == name + ", differentiated")
        list.push_back({{"statement", i + 1}, {"verdict", to_string(reading.verdict)}});
  return list;
}

}  // namespace

void attach_sums(report::Artefact& artefact, const Case& study, const Readings& readings,
                 const SumsView& view) {
  const auto shown = [&](const Eigen::VectorXd& history) -> Eigen::VectorXd {
    return view.scale * window(history, view.from, view.to);
  };
  const Eigen::VectorXd reference = (study.reference().*view.history)();
  Values curves{shown(reference)};
  for (std::size_t i = 0; i < all_sums().size(); ++i)
    for (const auto& one : readings.values(i, view.history)) curves.push_back(shown(one));
  const Units units(curves);
  Json data{{"label", view.label},  {"from", view.from},         {"to", view.to},
            {"unit", units.unit()}, {"choices", choice_names()}, {"reference", units(curves[0])}};
  data["level"] = std::isfinite(view.level) ? Json(view.level) : Json();
  for (const Pair& pair : readings.chosen())
    data["pairs"].push_back({{"label", pair.label}, {"steps", has_haar_trial(pair)}});
  for (std::size_t i = 0; i < all_sums().size(); ++i) {
    Json one{{"name", all_sums()[i].name()},
             {"choices", all_sums()[i].choices()},
             {"ofText", all_sums()[i].of_text()}};
    for (const auto& values : readings.values(i, view.history)) {
      one["curves"].push_back(units(shown(values)));
      one["errors"].push_back(values.allFinite() ? Json(app::relative_rms_error(values, reference)) : Json());
    }
    one["verdicts"] = verdicts_under(artefact, all_sums()[i].name());
    data["readings"].push_back(std::move(one));
  }
  artefact.script("readings", "readings", data.dump());
}

}  // namespace wavebalance::jl14
