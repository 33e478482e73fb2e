#include "collocation/collocation_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

constexpr double margin = 0.3;  // of the tolerance, for what a finer solution is to have

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

// New cuts of intervals in their panels. Where the cuts of each contact cut the others, one in a cell is
// enough for all, and two that nearly agree would move apart with the passages of their contacts.
class NewCuts {
 public:
  explicit NewCuts(Layout& layout) : layout_(layout) {}

  bool any() const { return any_; }

  // Near the ends of its interval, where layers of fast modes lie, or a panel without such an end in the
  // middle.
  void divide(const Panel& panel, bool at_ends) {
    constexpr double layer = 0.15, edge = 1e-6;
    const LayoutInterval& interval = layout_.intervals[static_cast<std::size_t>(panel.interval)];
    const double begin = layout_.begin(interval), end = layout_.end(interval), near = edge * (end - begin);
    const bool first = interval.begin >= 0 && panel.begin - begin < near,
               last = interval.begin >= 0 && end - panel.end < near;
    if (at_ends && first) add(panel, layer);
    if (at_ends && last) add(panel, 1.0 - layer);
    if (!at_ends && !first && !last) add(panel, 0.5);
  }

 private:
  struct Cut {
    int cell;
    double place;  // share of the panel
  };

  void add(const Panel& panel, double place) {
    constexpr double apart = 0.36;
    if (layout_.cut_by_others) {
      if (std::any_of(cuts_.begin(), cuts_.end(), [&](const Cut& cut) {
            return cut.cell == panel.cell && std::abs(cut.place - place) < apart;
          }))
        return;
      cuts_.push_back({panel.cell, place});
    }
    any_ = true;
    LayoutInterval& interval = layout_.intervals[static_cast<std::size_t>(panel.interval)];
    const double begin = layout_.begin(interval), length = layout_.end(interval) - begin;
    interval.cuts.push_back((panel.begin + place * panel.length() - begin) / length);
    std::sort(interval.cuts.begin(), interval.cuts.end());
  }

  Layout& layout_;
  std::vector<Cut> cuts_;
  bool any_ = false;
};

bool divide(CollocationIterate& iterate, const Eigen::Array<bool, Eigen::Dynamic, 1>& panels) {
  NewCuts cuts(iterate.layout);
  for (const bool at_ends : {true, false})
    for (Index p = 0; p < panels.size(); ++p)
      if (panels[p]) cuts.divide(iterate.forces.panels()[static_cast<std::size_t>(p)], at_ends);
  return cuts.any();
}

// So many that the last coefficients fall to the tolerance, and at least a third more.
Index wanted_nodes(const CollocationIterate& iterate, Index q, const EstimatedError& error,
                   const CollocationOptions& options) {
  const double digits = std::log(error.resolution / (margin * options.tolerance)),
               decay = decay_of(iterate.forces);
  // Where they do not decay, or the error is no number; of many panels the next size may be enough.
  const double most = iterate.layout.cut_by_others ? double(options.max_nodes) : 0.5 * double(q);
  const double more =
      decay < 1.0 ? std::fmax(0.0, std::fmin(most, std::ceil(digits / -std::log(decay)))) : most;
  return q + std::max<Index>(q / 3, Index(more));
}

}  // namespace

EstimatedError error_of(const CollocationResult& solved, double motion_rms) {
  if (solved.iterate.forces.coefficients().size() == 0) return {};
  constexpr double slowest = 0.9;
  const double decay = std::min(slowest, decay_of(solved.iterate.forces));
  return {decay * decay / (1.0 - decay) * solved.resolution_error / motion_rms,
          solved.residual_error / motion_rms, solved.panel_errors / solved.panel_errors.sum()};
}

double rms_of(const Eigen::MatrixXd& values) { return values.norm() / std::sqrt(double(values.size())); }

bool divide(CollocationIterate& iterate, double share) {
  const auto last = iterate.forces.coefficients().bottomRows(2).cwiseAbs().colwise().maxCoeff().transpose();
  return divide(iterate, (last.array() > share * iterate.forces.coefficients().cwiseAbs().maxCoeff()).eval());
}

void join_panels(CollocationIterate& iterate, const EstimatedError& error, const LegendreNodes& nodes,
                 const CollocationOptions& options) {
  constexpr double nothing = 1e-3, edge = 1e-6;
  if (wanted_nodes(iterate, nodes.count(), error, options) >= options.max_nodes) return;
  Layout& layout = iterate.layout;
  const std::vector<Panel>& panels = iterate.forces.panels();
  for (std::size_t p = 0; p < panels.size(); ++p) {
    LayoutInterval& interval = layout.intervals[static_cast<std::size_t>(panels[p].interval)];
    if (interval.begin < 0 || !(error.shares[Index(p)] < nothing)) continue;
    const double begin = layout.begin(interval), length = layout.end(interval) - begin;
    const double first = (panels[p].begin - begin) / length, last = (panels[p].end - begin) / length;
    if (!(first < edge || last > 1.0 - edge)) continue;
    std::erase_if(interval.cuts,
                  [&](double cut) { return std::abs(cut - (first < edge ? last : first)) < edge; });
  }
}

bool divide_panels(CollocationIterate& iterate, const EstimatedError& error,
                   const CollocationOptions& options) {
  const auto panels = iterate.forces.panels().size();
  const double limit = margin * options.tolerance / (error.resolution * double(panels));
  return static_cast<int>(panels) < options.max_panels && divide(iterate, !(error.shares.array() <= limit));
}

bool make_finer(CollocationIterate& iterate, LegendreNodes& nodes, const EstimatedError& error,
                const CollocationOptions& options) {
  const Index q = nodes.count();
  if (q == options.max_nodes) return divide_panels(iterate, error, options);
  nodes = LegendreNodes(std::min<Index>(options.max_nodes, wanted_nodes(iterate, q, error, options)));
  return true;
}

}  // namespace wavebalance::solvers::detail
