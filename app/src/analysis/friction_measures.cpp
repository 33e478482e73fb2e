#include "wavebalance/app/analysis/measures.hpp"

#include <numeric>

#include "wavebalance/contact/catalogue.hpp"

namespace wavebalance::app {
namespace {

double share_of(const contact::FrictionPeriod& period, contact::FrictionState state) {
  return double(std::ranges::count(period.state, state)) / double(period.state.size());
}

contact::CoulombLaw law_of(const SceneContact& contact) {
  return std::get<contact::CoulombLaw>(contact::law_entry(contact.law).make(contact.values));
}

/// Rigid friction in series with springs has the same motion of the slider, of displacements u + flexibility
/// f: springs so stiff that their deflection is small, and so soft that errors of u while it sticks are small
/// forces.
contact::FrictionPeriod period_of(const contact::CoulombLaw& law, int row, const solvers::Motion& contacts) {
  constexpr double share = 0.05;
  Eigen::MatrixXd rows = contacts.displacement.middleRows(row, law.rows()).transpose();
  const auto values = [&] {
    return std::span<const double>(rows.data(), static_cast<std::size_t>(rows.size()));
  };
  if (!law.rigid()) return law.over_period(contacts.points(), values(), false);
  const Eigen::MatrixXd force = contacts.force.middleRows(row, law.rows()).transpose();
  const Eigen::Index first = law.normal_rows();
  const double largest = force.rightCols(law.tangents()).cwiseAbs().maxCoeff();
  const Eigen::MatrixXd tangential = rows.rightCols(law.tangents());
  const double range = (tangential.colwise().maxCoeff() - tangential.colwise().minCoeff()).maxCoeff();
  const double flexibility = largest > 0.0 && range > 0.0 ? share * range / largest : 1.0;
  rows += flexibility * force;
  const std::vector<double> springs(static_cast<std::size_t>(first + law.tangents()), flexibility);
  return law.resolvent(springs).over_period(contacts.points(), values(), false);
}

/// Sets its wear, of the normal force times the distance of slip, J.
ContactFriction with_wear(ContactFriction friction, const SceneContact& contact, double normal_work) {
  friction.wears = contact.values.contains("wear_coefficient");
  if (friction.wears) friction.wear = contact::number_of(contact.values, "wear_coefficient") * normal_work;
  return friction;
}

ContactFriction friction_at(const SceneContact& contact, const contact::FrictionPeriod& period) {
  using enum contact::FrictionState;
  return with_wear(
      {contact.number, period.work, share_of(period, stick), share_of(period, slip), share_of(period, open)},
      contact, period.normal_work);
}

FrictionMeasures measures_of(const SceneContact& contact, int row, const solvers::Motion& contacts) {
  const contact::CoulombLaw law = law_of(contact);
  const contact::FrictionPeriod period = period_of(law, row, contacts);
  return {friction_at(contact, period),
          row,
          law,
          whole_name_of(contact),
          period.state,
          std::accumulate(period.slip.begin(), period.slip.end(), 0.0),
          period.history_dependent};
}

FrictionMeasures measures_of(const SceneContact& contact, const solvers::FrictionCycle& cycle) {
  const ContactFriction friction = friction_at(contact, cycle);
  const bool sticks = friction.slip_fraction == 0.0 && friction.open_fraction == 0.0;
  return {friction, cycle.row, law_of(contact), whole_name_of(contact), {}, cycle.slip, sticks};
}

template <class State>
contact::FrictionState state_of(State state) {
  if (state == State::open) return contact::FrictionState::open;
  return state == State::stick ? contact::FrictionState::stick : contact::FrictionState::slip;
}

/// The measures of an exact motion, and of one that was integrated in time.
std::vector<FrictionMeasures> exact_measures(const std::vector<SceneContact>& places,
                                             const solvers::ExactSolution& motion, int points) {
  std::vector<FrictionMeasures> all;
  for (std::size_t i = 0; i < motion.cycles.size(); ++i) {
    FrictionMeasures& one =
        all.emplace_back(measures_of(places[std::size_t(motion.cycles[i].row)], motion.cycles[i]));
    for (int l = 0; l < points; ++l)
      one.state.push_back(state_of(motion.friction[i].part_at(double(l) / points).state));
  }
  return all;
}

std::vector<FrictionMeasures> exact_measures(const std::vector<SceneContact>& places,
                                             const solvers::FlowMotion& flow) {
  std::vector<FrictionMeasures> all;
  for (std::size_t c = 0; c < flow.machines.size(); ++c) {
    const SceneContact& place = places[std::size_t(flow.machines[c].row)];
    if (!has_friction(place.law)) continue;
    FrictionMeasures& one = all.emplace_back(measures_of(place, flow.cycles[c]));
    for (const std::vector<int>& states : flow.sampled_states)
      one.state.push_back(state_of(flow.machines[c].law->kind(states[c])));
  }
  return all;
}

/// The law of the contact with friction whose first row this is.
using LawAtRow = std::pair<std::size_t, contact::CoulombLaw>;

/// In the force form the unknown belongs to the laws in series with its springs.
std::vector<LawAtRow> laws_of_rows(const std::vector<SceneContact>& places,
                                   const Eigen::VectorXd& flexibility) {
  std::vector<LawAtRow> laws;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!has_friction(places[i].law) || places[i].place != 0) continue;
    contact::CoulombLaw law = law_of(places[i]);
    if (flexibility.size() > 0)
      law = law.resolvent({flexibility.data() + i, static_cast<std::size_t>(law.rows())});
    laws.emplace_back(i, std::move(law));
  }
  return laws;
}

}  // namespace

std::vector<FrictionMeasures> friction_measures(const Scene& scene, const solvers::Motion& contacts,
                                                std::optional<double> frequency) {
  std::vector<FrictionMeasures> all;
  const std::vector<SceneContact> places = contacts_of(scene, frequency);
  for (std::size_t i = 0; i < places.size() && !contacts.empty(); ++i)
    if (has_friction(places[i].law) && places[i].place == 0)
      all.push_back(measures_of(places[i], static_cast<int>(i), contacts));
  return all;
}

std::vector<FrictionMeasures> friction_measures(const Scene& scene, const Response& response) {
  if (!response.moves || !has_friction(scene)) return {};
  if (response.flow) return exact_measures(contacts_of(scene), *response.flow);
  if (is_exact(response) && response.exact->motion.parts != nullptr)
    return exact_measures(contacts_of(scene), response.exact->motion, response.contacts.points());
  return friction_measures(scene, response.contacts, response.load_frequency);
}

ContactFriction friction_at(const SceneContact& contact, const solvers::FrictionCycle& cycle) {
  using enum solvers::ContactState;
  return with_wear({contact.number, cycle.work, cycle.share(stick), cycle.share(slip), cycle.share(open)},
                   contact, cycle.wear);
}

FrictionShares::FrictionShares(std::vector<ContactFriction> contacts) : each(std::move(contacts)) {
  for (const ContactFriction& one : each) {
    work += one.work;
    stick_fraction += one.stick_fraction / double(each.size());
    slip_fraction += one.slip_fraction / double(each.size());
    open_fraction += one.open_fraction / double(each.size());
  }
}

void append_shares(Summary& row, const FrictionShares& shares) {
  row.emplace_back("friction_work_J", shares.work);
  row.emplace_back("stick_fraction", shares.stick_fraction);
  row.emplace_back("slip_fraction", shares.slip_fraction);
  row.emplace_back("open_fraction", shares.open_fraction);
}

std::vector<FrictionShares> friction_along(const Scene& scene, const solvers::FrequencySweep& curve) {
  if (!has_friction(scene)) return {};
  std::vector<FrictionShares> along;
  const std::vector<SceneContact> places = contacts_of(scene);
  Scene read = scene;
  read.contact = with_tables_read(scene.contact);
  std::vector<LawAtRow> laws = laws_of_rows(contacts_of(scene), curve.series_flexibility);
  for (const solvers::SweepPoint& point : curve.points) {
    if (has_growing_normal_load(scene.contact))
      laws = laws_of_rows(contacts_of(read, point.frequency), curve.series_flexibility);
    const std::size_t points =
        static_cast<std::size_t>(point.unknown.size()) / std::size_t(contact_count(scene));
    std::vector<ContactFriction> each;
    for (const auto& [row, law] : laws) {
      const std::span<const double> rows(point.unknown.data() + row * points,
                                         static_cast<std::size_t>(law.rows()) * points);
      each.push_back(friction_at(places[row], law.over_period(static_cast<int>(points), rows, false)));
    }
    along.emplace_back(std::move(each));
  }
  return along;
}

}  // namespace wavebalance::app
