#include "wavebalance/solvers/balance/contact_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace wavebalance::solvers {

ContactLaws::ContactLaws(std::vector<AnyContactLaw> laws) : laws_(std::move(laws)) {
  if (laws_.empty()) throw std::invalid_argument("ContactLaws: the list of laws is empty; give one or more");
}

void ContactLaws::require(int contacts) const {
  if (laws_.size() == 1 || laws_.size() == static_cast<std::size_t>(contacts)) return;
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

bool ContactLaws::have_finite_force() const {
  return std::all_of(laws_.begin(), laws_.end(), [](const AnyContactLaw& law) { return !law.is_rigid(); });
}

std::vector<int> ContactLaws::rigid(int contacts) const {
  std::vector<int> found;
  for (int c = 0; c < contacts; ++c)
    if ((*this)[c].is_rigid()) found.push_back(c);
  return found;
}

bool ContactLaws::unilateral() const {
  return std::all_of(laws_.begin(), laws_.end(), [](const AnyContactLaw& law) { return law.unilateral(); });
}

bool ContactLaws::have_force_form() const {
  return std::all_of(laws_.begin(), laws_.end(),
                     [](const AnyContactLaw& law) { return law.has_force_form(); });
}

bool ContactLaws::depend_on_velocity() const {
  return std::any_of(laws_.begin(), laws_.end(),
                     [](const AnyContactLaw& law) { return law.depends_on_velocity(); });
}

ContactLaws ContactLaws::resolvents(const Eigen::VectorXd& flexibility) const {
  std::vector<AnyContactLaw> laws;
  for (int c = 0; c < flexibility.size(); ++c) laws.emplace_back(ResolventLaw((*this)[c], flexibility[c]));
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
                           Eigen::VectorXd& force, Eigen::VectorXd& tangent, Eigen::VectorXd& damping) const {
  const Eigen::Index points = displacement.size() / contacts;
  for (Eigen::Index l = 0; l < displacement.size(); ++l) {
    const ForceSlopes at = (*this)[static_cast<int>(l / points)].at(displacement[l], velocity[l]);
    force[l] = at.force;
    tangent[l] = at.tangent;
    damping[l] = at.damping;
  }
}

void ContactLaws::require_numbers(int contacts, const Eigen::VectorXd& displacement) const {
  constexpr double largest = 1e9;
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
  return Eigen::MatrixXd::NullaryExpr(
      displacement.rows(), displacement.cols(), [&](Eigen::Index contact, Eigen::Index point) {
        return (*this)[static_cast<int>(contact)].force(displacement(contact, point));
      });
}

Eigen::MatrixXd ContactLaws::force(const Eigen::MatrixXd& displacement,
                                   const Eigen::MatrixXd& velocity) const {
  return Eigen::MatrixXd::NullaryExpr(displacement.rows(), displacement.cols(),
                                      [&](Eigen::Index contact, Eigen::Index point) {
                                        return (*this)[static_cast<int>(contact)].force(
                                            displacement(contact, point), velocity(contact, point));
                                      });
}

}  // namespace wavebalance::solvers
