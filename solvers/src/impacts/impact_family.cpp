#include "wavebalance/solvers/impacts/impact_family.hpp"

#include "phases/phase_loads.hpp"

namespace wavebalance::solvers {

struct ImpactFamily::Parts {
  const ContactDynamics* dynamics;
  Eigen::VectorXd gaps, restitution;
  SweepParameter parameter;
  detail::FreeContacts free;
  double frequency, factor, full_load;
  int periods;

  ImpactsProblem at(double value) {
    const bool varies = parameter == SweepParameter::frequency;
    const double at_frequency = varies ? value / periods : frequency,
                 at_factor = varies ? factor : value / full_load;
    return {*dynamics, free.at(at_frequency, at_factor), at_frequency, gaps, restitution};
  }
};

ImpactFamily::ImpactFamily(const CondensedProblem& problem, const ContactDynamics& dynamics,
                           Eigen::VectorXd gaps, Eigen::VectorXd restitution, SweepParameter parameter)
    : parts_(std::make_unique<Parts>(
          Parts{&dynamics, std::move(gaps), std::move(restitution), parameter,
                detail::FreeContacts(problem.structure(), problem.load_harmonics(), dynamics.holding()),
                problem.frequency(), problem.load_factor(), problem.full_load(), problem.periods()})) {
  const bool varies = parameter == SweepParameter::frequency;
  at(varies ? problem.load_frequency() : problem.load_scale()).validate();
}

ImpactFamily::ImpactFamily(ImpactFamily&&) noexcept = default;
ImpactFamily& ImpactFamily::operator=(ImpactFamily&&) noexcept = default;
ImpactFamily::~ImpactFamily() = default;

SweepParameter ImpactFamily::parameter() const { return parts_->parameter; }

ImpactsProblem ImpactFamily::at(double value, int periods) const {
  return parts_->at(value).over_periods(periods);
}

Eigen::MatrixXcd ImpactFamily::contact_free_slope(double value, int periods) const {
  constexpr double share = 1e-5;
  const double step = share * (value == 0.0 ? parts_->full_load : value);
  const Eigen::MatrixXcd after = at(value + step, periods).contact_free,
                         before = at(value - step, periods).contact_free;
  return (after - before) / (2.0 * step);
}

double ImpactFamily::frequency_slope(int periods) const {
  return parts_->parameter == SweepParameter::frequency ? 1.0 / (parts_->periods * periods) : 0.0;
}

}  // namespace wavebalance::solvers
