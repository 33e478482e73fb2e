#include "phases/phase_refinement.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The factor from one Legendre coefficient to the next, of the panel where they decay slowest among those
// with last ones above a ten-thousandth of the largest of these.
double decay_of(const PanelForces& forces) {
  const Eigen::MatrixXd& coefficients = forces.coefficients();
  const Index q = coefficients.rows(), middle = q / 2 - 1;
  const double limit = 1e-4 * coefficients.bottomRows(2).cwiseAbs().maxCoeff();
  double slowest = 0.1;
  for (Index p = 0; p < coefficients.cols(); ++p) {
    const auto own = coefficients.col(p).cwiseAbs();
    const double last = own.tail(2).maxCoeff(), before = own.segment(middle, 2).maxCoeff();
    if (last > limit) slowest = std::max(slowest, std::pow(last / before, 1.0 / double(q - 2 - middle)));
  }
  return slowest;
}

}  // namespace

EstimatedError error_of(const PhaseNewtonResult& solved, double motion_rms) {
  if (solved.iterate.forces.coefficients().size() == 0) return {};
  constexpr double slowest = 0.9;
  const double decay = std::min(slowest, decay_of(solved.iterate.forces));
  return {decay * decay / (1.0 - decay) * solved.resolution_error / motion_rms,
          solved.residual_error / motion_rms};
}

double rms_of(const Eigen::MatrixXd& values) { return values.norm() / std::sqrt(double(values.size())); }

bool divide(PhaseIterate& iterate, double share) {
  constexpr double layer = 0.15;
  const Eigen::MatrixXd& coefficients = iterate.forces.coefficients();
  const double limit = share * coefficients.cwiseAbs().maxCoeff();
  bool cut = false;
  for (std::size_t p = 0; p < iterate.forces.panels().size(); ++p) {
    const Panel& panel = iterate.forces.panels()[p];
    if (coefficients.col(Index(p)).tail(2).cwiseAbs().maxCoeff() <= limit) continue;
    Phase& phase = iterate.layout.phases[static_cast<std::size_t>(panel.phase)];
    const double begin = iterate.layout.begin(phase), length = iterate.layout.end(phase) - begin;
    const double from = (panel.begin - begin) / length, to = (panel.end - begin) / length, size = to - from;
    constexpr double edge = 1e-6;
    const bool first = phase.begin >= 0 && from < edge, last = phase.begin >= 0 && to > 1.0 - edge;
    if (first) phase.cuts.push_back(from + layer * size);
    if (last) phase.cuts.push_back(to - layer * size);
    if (!first && !last) phase.cuts.push_back(from + 0.5 * size);
    std::sort(phase.cuts.begin(), phase.cuts.end());
    cut = true;
  }
  return cut;
}

bool divide_panels(PhaseIterate& iterate, const ContactPhasesOptions& options) {
  return static_cast<int>(iterate.forces.panels().size()) < options.max_panels &&
         divide(iterate, 0.1 * options.tolerance);
}

bool make_finer(PhaseIterate& iterate, LegendreNodes& nodes, double error,
                const ContactPhasesOptions& options) {
  constexpr double margin = 0.3;
  const Index q = nodes.count();
  if (q == options.max_nodes) return divide_panels(iterate, options);
  const double digits = std::log(error / (margin * options.tolerance)), decay = decay_of(iterate.forces);
  // Where they do not decay, or the error is no number; of many panels the next size may be enough.
  const double most = iterate.layout.cut_by_others ? double(options.max_nodes) : 0.5 * double(q);
  const double more =
      decay < 1.0 ? std::fmax(0.0, std::fmin(most, std::ceil(digits / -std::log(decay)))) : most;
  nodes = LegendreNodes(std::min<Index>(options.max_nodes, q + std::max<Index>(q / 3, Index(more))));
  return true;
}

}  // namespace wavebalance::solvers::detail
