#pragma once
#include <vector>

#include "wavebalance/solvers/balance/contact_law.hpp"

namespace wavebalance::solvers {

/// The resolvent of a law as a law of v = u + flexibility f: the law of the force form. Its potential is
/// the sum over law and spring.
class ResolventLaw {
 public:
  /// Throws std::invalid_argument for a flexibility that is not positive and finite (m/N).
  ResolventLaw(AnyContactLaw law, double flexibility);

  double force(double v) const { return evaluate(v).force; }
  double tangent(double v) const { return evaluate(v).tangent; }
  double potential(double v) const;
  double gap() const { return law_.gap(); }
  bool unilateral() const { return law_.unilateral(); }
  std::vector<double> kinks() const;
  ForceSlope evaluate(double v) const { return law_.resolvent(v, flexibility_); }

 private:
  AnyContactLaw law_;
  double flexibility_;
};

}  // namespace wavebalance::solvers
