#include "wavebalance/app/analysis/friction_measures.hpp"

#include <algorithm>
#include <numeric>
#include <variant>

#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/contact/catalogue.hpp"

namespace wavebalance::app {
namespace {

FrictionMeasures measures_of(const SceneContact& contact, int row, const solvers::Motion& contacts) {
  contact::CoulombLaw law =
      std::get<contact::CoulombLaw>(contact::law_entry(contact.law).make(contact.values));
  const Eigen::MatrixXd rows = contacts.displacement.middleRows(row, law.rows()).transpose();
  contact::FrictionPeriod period =
      law.over_period(contacts.points(), {rows.data(), static_cast<std::size_t>(rows.size())}, false);
  const auto share = [&](contact::FrictionState state) {
    return double(std::count(period.state.begin(), period.state.end(), state)) / contacts.points();
  };
  FrictionMeasures measures{row,
                            std::move(law),
                            {},
                            share(contact::FrictionState::stick),
                            share(contact::FrictionState::slip),
                            share(contact::FrictionState::open)};
  measures.slip = std::accumulate(period.slip.begin(), period.slip.end(), 0.0);
  if (const auto wears = contact.values.find("wear_coefficient"); wears != contact.values.end())
    measures.wear = std::get<double>(wears->second) * period.normal_work;
  measures.period = std::move(period);
  return measures;
}

}  // namespace

std::vector<FrictionMeasures> friction_measures(const Scene& scene, const solvers::Motion& contacts) {
  std::vector<FrictionMeasures> all;
  const std::vector<SceneContact> places = contacts_of(scene);
  for (std::size_t i = 0; i < places.size() && !contacts.empty(); ++i)
    if (has_friction(places[i].law) && places[i].place == 0)
      all.push_back(measures_of(places[i], static_cast<int>(i), contacts));
  return all;
}

}  // namespace wavebalance::app
