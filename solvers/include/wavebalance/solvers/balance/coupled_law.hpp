#pragma once
#include <concepts>
#include <functional>
#include <span>

#include "wavebalance/solvers/balance/period_law.hpp"

namespace wavebalance::solvers {

/// A law of one instant along several rows: in contact the force of each depends on the displacements of all.
/// Contact is where the penetration (m), a smooth function of them, is above 0. The forces in contact oppose
/// positive displacements, vanish with the penetration and go on smoothly where it is a little below.
template <class Law>
concept CoupledLaw = std::copy_constructible<Law> &&
    requires(const Law& law, std::span<const double> displacement, std::span<double> out) {
  { law.rows() } -> std::convertible_to<int>;                             // consecutive directions, 2 or 3
  { law.gap() } -> std::convertible_to<double>;                           // m, a length of the contact
  { law.penetration(displacement, out) } -> std::convertible_to<double>;  // m, and its slopes
  law.closed(displacement, out, out);                                     // forces, slopes row after row
  { law.potential(displacement) } -> std::convertible_to<double>;         // J, of the elastic part
};

/// Any of them behind one value type, as a law over a period that also goes on step by step.
class AnyCoupledLaw {
 public:
  template <class Law>  // same_as comes first: CoupledLaw tests copies and would otherwise test itself again
  requires(!std::same_as<Law, AnyCoupledLaw> && CoupledLaw<Law>) explicit AnyCoupledLaw(const Law& law)
      : rows_(law.rows()),
        gap_(law.gap()),
        penetration_([law](Values u, Results slopes) { return law.penetration(u, slopes); }),
        closed_([law](Values u, Results force, Results slopes) { law.closed(u, force, slopes); }),
        potential_([law](Values u) { return law.potential(u); }) {}

  int rows() const { return rows_; }
  double gap() const { return gap_; }
  double penetration(std::span<const double> displacement, std::span<double> slopes) const {
    return penetration_(displacement, slopes);
  }
  void closed(std::span<const double> displacement, std::span<double> force, std::span<double> slopes) const {
    closed_(displacement, force, slopes);
  }
  double potential(std::span<const double> displacement) const { return potential_(displacement); }

  /// As a PeriodLaw: pieces are 0 where the contact is open, 1 where it is closed.
  void evaluate(const PeriodKinematics& motion, PeriodForces& forces) const;
  /// As one that AdvancesInSteps.
  void advance(std::span<const double> before, std::span<const double> v, std::span<const double> flexibility,
               std::span<double> force) const;
  void start(std::span<const double> v, std::span<const double> flexibility, std::span<double> force) const;

 private:
  using Values = std::span<const double>;
  using Results = std::span<double>;

  int rows_;
  double gap_;
  std::function<double(Values, Results)> penetration_;
  std::function<void(Values, Results, Results)> closed_;
  std::function<double(Values)> potential_;
};

}  // namespace wavebalance::solvers
