#include "wavebalance/solvers/balance/contact_law.hpp"

#include <limits>

namespace wavebalance::solvers {
namespace {

struct NoContact {
  double force(double) const { return 0.0; }
  double tangent(double) const { return 0.0; }
  double potential(double) const { return 0.0; }
  double gap() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace

AnyContactLaw::AnyContactLaw() : AnyContactLaw(NoContact{}) {}

double AnyContactLaw::force(double displacement) const { return model_->force(displacement); }
double AnyContactLaw::tangent(double displacement) const { return model_->tangent(displacement); }
double AnyContactLaw::potential(double displacement) const { return model_->potential(displacement); }

}  // namespace wavebalance::solvers
