#include "wavebalance/solvers/balance/contact_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/balance/resolvent_law.hpp"

namespace wavebalance::solvers {

ContactLaws::ContactLaws(std::vector<AnyContactLaw> laws) : laws_(std::move(laws)) {
  if (laws_.empty()) throw std::invalid_argument("ContactLaws: the list of laws is empty; give one or more");
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    if (laws_[i].rows() < 1)
      throw std::invalid_argument("ContactLaws: law " + std::to_string(i + 1) + " has " +
                                  std::to_string(laws_[i].rows()) + " rows; it must have at least 1");
    law_of_row_.insert(law_of_row_.end(), static_cast<std::size_t>(laws_[i].rows()), i);
  }
}

ContactLaws ContactLaws::over_frequency(AtFrequency make, double load_frequency) {
  ContactLaws laws = make(load_frequency);
  laws.make_ = std::make_shared<const AtFrequency>(std::move(make));
  return laws;
}

ContactLaws ContactLaws::at(double load_frequency) const {
  if (!make_ || !(load_frequency > 0.0)) return *this;
  ContactLaws laws = (*make_)(load_frequency);
  laws.make_ = make_;
  return laws;
}

void ContactLaws::require(int contacts) const {
  const bool one_for_all = laws_.size() == 1 && !laws_.front().acts_over_period();
  if (one_for_all || law_of_row_.size() == static_cast<std::size_t>(contacts)) return;
  if (act_over_period())
    throw std::invalid_argument("ContactLaws: the laws act along " + std::to_string(law_of_row_.size()) +
                                " contact directions, but the structure has " + std::to_string(contacts) +
                                "; a law over a period takes as many as it has rows");
  throw std::invalid_argument("ContactLaws: there are " + std::to_string(laws_.size()) + " laws for " +
                              std::to_string(contacts) + " contacts; give one for all or one each");
}

Eigen::VectorXd ContactLaws::gaps(int contacts) const {
  Eigen::VectorXd gaps(contacts);
  for (int c = 0; c < contacts; ++c) gaps[c] = (*this)[c].gap();
  return gaps;
}

double ContactLaws::largest_gap() const {
  double largest = 0.0;
  for (const AnyContactLaw& law : laws_)
    if (const double gap = std::abs(law.gap()); std::isfinite(gap)) largest = std::max(largest, gap);
  return largest;
}

bool ContactLaws::have_finite_force() const { return std::ranges::none_of(laws_, &AnyContactLaw::is_rigid); }

std::vector<int> ContactLaws::rigid(int contacts) const {
  std::vector<int> found;
  for (int c = 0; c < contacts; c += (*this)[c].rows()) {
    const AnyContactLaw& law = (*this)[c];
    if (!law.is_rigid()) continue;
    const auto friction = law.friction();
    for (int row = friction ? friction->normal_rows : 0; row < law.rows(); ++row) found.push_back(c + row);
  }
  return found;
}

bool ContactLaws::have_impacts() const {
  return std::ranges::any_of(laws_, [](const AnyContactLaw& law) { return law.restitution().has_value(); });
}

bool ContactLaws::have_impacts_alone(int contacts) const {
  for (int c = 0; c < contacts; ++c)
    if (!(*this)[c].restitution()) return false;
  return true;
}

Eigen::VectorXd ContactLaws::restitution(int contacts) const {
  Eigen::VectorXd all(contacts);
  for (int c = 0; c < contacts; ++c) {
    const std::optional<double> one = (*this)[c].restitution();
    if (!one)
      throw std::invalid_argument("the law of contact " + std::to_string(c + 1) +
                                  " has no restitution; where one contact has impacts, all must");
    all[c] = *one;
  }
  return all;
}

bool ContactLaws::unilateral() const { return std::ranges::all_of(laws_, &AnyContactLaw::unilateral); }

double ContactLaws::largest_force(const Eigen::MatrixXd& force) const {
  if (unilateral()) return force.maxCoeff();
  double largest = 0.0;
  for (int c = 0; c < force.rows(); c += (*this)[c].rows()) {
    const auto own = force.middleRows(c, (*this)[c].rows());
    largest =
        std::max(largest, (*this)[c].coupled() ? own.colwise().norm().maxCoeff() : own.cwiseAbs().maxCoeff());
  }
  return largest;
}

bool ContactLaws::have_force_form() const {
  return std::ranges::all_of(laws_, &AnyContactLaw::has_force_form);
}

bool ContactLaws::depend_on_velocity() const {
  return std::ranges::any_of(laws_, &AnyContactLaw::depends_on_velocity);
}

bool ContactLaws::act_over_period() const {
  return std::ranges::any_of(laws_, &AnyContactLaw::acts_over_period);
}

bool ContactLaws::advance_in_steps() const {
  return std::ranges::all_of(
      laws_, [](const AnyContactLaw& law) { return !law.acts_over_period() || law.advances_in_steps(); });
}

ContactLaws ContactLaws::resolvents(const Eigen::VectorXd& flexibility) const {
  std::vector<AnyContactLaw> laws;
  for (int c = 0; c < flexibility.size(); c += (*this)[c].rows()) {
    const AnyContactLaw& law = (*this)[c];
    if (law.acts_over_period())
      laws.push_back(
          law.over_period_resolvent({flexibility.data() + c, static_cast<std::size_t>(law.rows())}));
    else
      laws.emplace_back(ResolventLaw(law, flexibility[c]));
  }
  return ContactLaws(std::move(laws));
}

void ContactLaws::evaluate(int contacts, const Eigen::VectorXd& displacement, Eigen::VectorXd& force,
                           Eigen::VectorXd& tangent) const {
  const auto points = static_cast<std::size_t>(displacement.size() / contacts);
  for (int c = 0; c < contacts; ++c) {
    const std::size_t first = static_cast<std::size_t>(c) * points;
    (*this)[c].evaluate({displacement.data() + first, points}, {force.data() + first, points},
                        {tangent.data() + first, points});
  }
}

void ContactLaws::evaluate(int contacts, const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                           ContactForces& forces) const {
  forces.force.setZero(displacement.size());
  forces.slopes.displacement.setZero(displacement.size());
  forces.slopes.velocity.setZero(velocity.size());
  forces.slopes.others.clear();
  forces.pieces.setZero(act_over_period() ? displacement.size() : 0);
  const int points = static_cast<int>(displacement.size()) / contacts;
  for (int c = 0; c < contacts; c += (*this)[c].rows())
    evaluate_law(c, points, displacement, velocity, forces);
}

void ContactLaws::evaluate_law(int row, int points, const Eigen::VectorXd& displacement,
                               const Eigen::VectorXd& velocity, ContactForces& forces) const {
  const AnyContactLaw& law = (*this)[row];
  const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(points);
  const auto count = static_cast<std::size_t>(law.rows()) * static_cast<std::size_t>(points);
  const auto own = [&](auto& values) {
    return values.size() > 0 ? std::span(values.data() + first, count) : std::span(values.data(), 0);
  };
  const std::size_t before = forces.slopes.others.size();
  PeriodForces result{own(forces.force), own(forces.slopes.displacement), own(forces.slopes.velocity),
                      forces.slopes.others, own(forces.pieces)};
  law.evaluate({points, own(displacement), own(velocity)}, result);
  for (std::size_t i = before; i < forces.slopes.others.size(); ++i) {
    forces.slopes.others[i].force += static_cast<int>(first);
    forces.slopes.others[i].displacement += static_cast<int>(first);
  }
}

void ContactLaws::require_numbers(int contacts, const Eigen::VectorXd& displacement) const {
  constexpr double largest = 1e9;
  if (act_over_period()) return;
  const Eigen::Index points = displacement.size() / contacts;
  for (Eigen::Index l = 0; l < displacement.size(); ++l) {
    const double u = displacement[l];
    if (!(std::abs(u) <= largest)) continue;
    const ForceSlopes at = (*this)[static_cast<int>(l / points)].at(u, 0.0);
    const bool force = std::isnan(at.force);
    if (!force && !std::isnan(at.tangent) && !std::isnan(at.damping)) continue;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", u);
    throw std::invalid_argument("the law of contact " + std::to_string(l / points + 1) +
                                " returned nan as its " + (force ? "force" : "slope") +
                                " at u = " + text.data() + " m; it must return a number");
  }
}

Eigen::MatrixXd ContactLaws::force(const Eigen::MatrixXd& displacement) const {
  return force(displacement, {});
}

// At rest without velocities.
Eigen::MatrixXd ContactLaws::force(const Eigen::MatrixXd& displacement,
                                   const Eigen::MatrixXd& velocity) const {
  if (!act_over_period())
    return Eigen::MatrixXd::NullaryExpr(
        displacement.rows(), displacement.cols(), [&](Eigen::Index contact, Eigen::Index point) {
          const AnyContactLaw& law = (*this)[static_cast<int>(contact)];
          const double u = displacement(contact, point);
          return velocity.size() > 0 ? law.force(u, velocity(contact, point)) : law.force(u);
        });
  const auto contacts = static_cast<int>(displacement.rows());
  const auto samples = [](const Eigen::MatrixXd& by_contact) -> Eigen::VectorXd {
    return by_contact.transpose().reshaped();
  };
  ContactForces forces;
  evaluate(contacts, samples(displacement), depend_on_velocity() ? samples(velocity) : Eigen::VectorXd(),
           forces);
  return forces.force.reshaped(displacement.cols(), contacts).transpose();
}

}  // namespace wavebalance::solvers
