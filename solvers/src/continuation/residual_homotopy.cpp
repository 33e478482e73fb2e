#include "wavebalance/solvers/continuation/residual_homotopy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/option_checks.hpp"
#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {
namespace {

// p scales the residual of the start, which is added to the linear response.
class ResidualParameter final : public CurveParameter {
 public:
  explicit ResidualParameter(Eigen::VectorXd start_residual) : start_residual_(std::move(start_residual)) {}
  bool contains(double p) const override { return std::isfinite(p); }
  void set(ContactSystem& system, double p) const override { system.set_added_motion(p * start_residual_); }
  void slope(ContactSystem&, Eigen::VectorXd& slope) const override { slope = -start_residual_; }

 private:
  Eigen::VectorXd start_residual_;
};

// The operations of a point grow at least in proportion to the samples. For very many samples they are
// limited to a few seconds.
double limit_of_operations(ContactSystem& system, const ResidualHomotopyOptions& options) {
  constexpr double few_samples = 1536.0, most = 2.5;
  return options.max_operations * std::clamp(system.problem().samples() / few_samples, 1.0, most);
}

// The point of the last step that is nearest to p = 0. The corrector may fail at others.
Eigen::VectorXd nearest_to_solution(ArcLength& curve) {
  CurvePoint nearest = curve.point(), last;
  const auto keep = [&nearest](const CurvePoint& at) {
    if (std::abs(at.parameter) < std::abs(nearest.parameter)) nearest = at;
    return at.parameter;
  };
  curve.locate(keep, last);
  return std::move(nearest.displacement);
}

HomotopyStatus follow(ContactSystem& system, Eigen::VectorXd& u, const ResidualHomotopyOptions& options) {
  system.evaluate(u);
  const ResidualParameter parameter(system.residual());
  ArcLengthOptions arc;
  arc.displacement_scale = std::max(safe_norm(u) / std::sqrt(double(u.size())), system.laws().largest_gap());
  if (arc.displacement_scale == 0.0)
    arc.displacement_scale = safe_norm(system.problem().linear_response()) / std::sqrt(double(u.size()));
  arc.parameter_scale = 1.0;
  arc.initial_step = 0.1;
  arc.max_step = 0.5;
  arc.grazing_events = GrazingEvents::where_needed;
  arc.max_operations = limit_of_operations(system, options);
  ArcLength curve(system, parameter, arc);
  if (curve.start(u, 1.0, -1.0) != ArcLength::Status::advanced) return HomotopyStatus::lost;
  const double limit = system.operations() + arc.max_operations;
  for (int point = 1; point <= options.max_points; ++point) {
    if (curve.advance() != ArcLength::Status::advanced)
      return system.operations() > limit ? HomotopyStatus::effort_limit : HomotopyStatus::lost;
    if (curve.point().parameter <= 0.0) {
      u = nearest_to_solution(curve);
      return HomotopyStatus::arrived;
    }
    if (!goes_on(options.observer,
                 {"continuation", point, curve.point().parameter, "fraction of the residual"}))
      return HomotopyStatus::cancelled;
  }
  return HomotopyStatus::effort_limit;
}

}  // namespace

void ResidualHomotopyOptions::validate() const {
  detail::require_at_least("ResidualHomotopyOptions", "max_points", max_points, 1);
  detail::require_positive("ResidualHomotopyOptions", "max_operations", max_operations);
}

HomotopyStatus residual_homotopy(ContactSystem& system, Eigen::VectorXd& u,
                                 const ResidualHomotopyOptions& options) {
  options.validate();
  const HomotopyStatus status = follow(system, u, options);
  system.set_added_motion({});
  return status;
}

}  // namespace wavebalance::solvers
