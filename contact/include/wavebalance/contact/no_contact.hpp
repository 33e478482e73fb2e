#pragma once
#include <limits>

#include "wavebalance/contact/force_and_tangent.hpp"
#include "wavebalance/contact/law_description.hpp"

namespace wavebalance::contact {

/// No obstacle: no force at any displacement, and an infinite gap.
struct NoContact {
  static LawDescription description() { return {.name = "none", .force = "no force"}; }
  static NoContact of(const LawValues&) { return {}; }

  double force(double) const { return 0.0; }
  double tangent(double) const { return 0.0; }
  double potential(double) const { return 0.0; }
  double gap() const { return std::numeric_limits<double>::infinity(); }
  static constexpr bool unilateral() { return true; }
  ForceAndTangent evaluate(double) const { return {}; }
  ForceAndTangent resolvent(double, double) const { return {}; }
};

}  // namespace wavebalance::contact
