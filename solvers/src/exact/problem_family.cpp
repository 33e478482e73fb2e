#include "wavebalance/solvers/exact/problem_family.hpp"

#include <numbers>

#include "balance/free_contacts.hpp"

namespace wavebalance::solvers {

struct ProblemFamily::Parts {
  ContactLaws laws;
  std::shared_ptr<const ContactDynamics> dynamics;
  DynamicsAlong along;
  LinearStructure structure;
  SweepParameter parameter;
  detail::FreeContacts free;
  double frequency, factor, full_load;
  int periods, repeats;
};

ProblemFamily::ProblemFamily(const CondensedProblem& problem, ContactLaws laws,
                             const ContactDynamics& dynamics, SweepParameter parameter)
    : parts_(std::make_unique<Parts>(Parts{
          std::move(laws), DynamicsAlong(dynamics).at(problem.structure()), dynamics, problem.structure(),
          parameter, detail::FreeContacts(problem.structure(), problem.load_harmonics(), dynamics.holding()),
          problem.frequency(), problem.load_factor(), problem.full_load(), problem.periods(),
          repeats_within_period(problem.load_harmonics())})) {
  parts_->laws.require(problem.contacts());
}

ProblemFamily::ProblemFamily(ProblemFamily&&) noexcept = default;
ProblemFamily& ProblemFamily::operator=(ProblemFamily&&) noexcept = default;
ProblemFamily::~ProblemFamily() = default;

SweepParameter ProblemFamily::parameter() const { return parts_->parameter; }
const ContactLaws& ProblemFamily::laws() const { return parts_->laws; }
const ContactDynamics& ProblemFamily::dynamics() const { return *parts_->dynamics; }

ExactProblem ProblemFamily::at(double value) const {
  const bool varies = parts_->parameter == SweepParameter::frequency;
  const double frequency = varies ? value / parts_->periods : parts_->frequency,
               factor = varies ? parts_->factor : value / parts_->full_load;
  const ContactLaws laws = parts_->laws.at(parts_->periods * frequency);
  if (!parts_->structure.turns())
    return {*parts_->dynamics, laws, parts_->free.at(frequency, factor), frequency};
  const double speed = 2.0 * std::numbers::pi * frequency * parts_->repeats;
  auto dynamics = parts_->along.at(parts_->structure.at_speed(speed));
  return {*dynamics, laws, parts_->free.at(frequency, factor), frequency, dynamics};
}

}  // namespace wavebalance::solvers
