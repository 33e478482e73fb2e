#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "collocation/exact_solution_parts.hpp"
#include "collocation/interval_count.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers {
namespace {

// How fast a perturbation of a closed contact turns or decays, in rad per period: by the contact's own mass
// and the largest slopes of its law on a part of an interval.
double perturbation_rate(const ExactSolution::Parts& parts, int interval, double begin, double end) {
  const int contact = parts.iterate.layout.intervals[static_cast<std::size_t>(interval)].contact;
  const detail::PoleResponse& response = parts.model.response;
  const double acceleration = response.acceleration_at_once(contact);
  double rate = 0.0;
  for (const double share : {0.01, 0.25, 0.5, 0.75, 0.99}) {
    const double time = begin + share * (end - begin);
    const double slope = std::abs(parts.tangent.in_interval(interval, time));
    const double stiffness = slope / (1.0 + slope * response.displacement_at_once(contact));
    const double damping = std::abs(parts.damping.in_interval(interval, time)) * parts.model.frequency;
    rate = std::max(rate, std::sqrt(stiffness * acceleration) + damping * acceleration);
  }
  return rate;
}

// The intervals cut into panels that resolve perturbations, which may move faster than the motion does: at
// most one radian a node. Nothing where cuts would make too many.
std::optional<detail::Layout> resolving_perturbations(const ExactSolution::Parts& parts) {
  detail::Layout result = parts.iterate.layout;
  const auto q = double(parts.nodes.count());
  const double most_unknowns = std::max(4000.0, q * double(parts.iterate.forces.panels().size()));
  double unknowns = 0.0;
  for (std::size_t i = 0; i < result.intervals.size(); ++i) {
    detail::LayoutInterval& interval = result.intervals[i];
    const double begin = result.begin(interval), length = result.end(interval) - begin;
    std::vector<double> ends = interval.cuts, cuts;
    ends.push_back(1.0);
    double from = 0.0;
    for (const double to : ends) {
      const double rate =
          perturbation_rate(parts, static_cast<int>(i), begin + from * length, begin + to * length);
      const double pieces = std::max(1.0, std::ceil(rate * (to - from) * length / q));
      if ((unknowns += pieces * q) > most_unknowns) return std::nullopt;
      for (double k = 1.0; k <= pieces; ++k)
        cuts.push_back(k < pieces ? from + (to - from) * k / pieces : to);
      from = to;
    }
    cuts.pop_back();
    interval.cuts = std::move(cuts);
  }
  return result;
}

std::optional<detail::PeriodMap> map_of(const ExactSolution::Parts& parts) {
  const std::optional<detail::Layout> panels = resolving_perturbations(parts);
  return panels ? detail::period_map(parts.model, parts.iterate, *panels, parts.nodes) : std::nullopt;
}

// Whether a contact has a force at a time.
bool acts(const std::vector<ForceInterval>& intervals, int contact, double time) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const ForceInterval& interval) {
    const double since = time - interval.begin;
    return interval.contact == contact && since - std::floor(since) <= interval.length();
  });
}

}  // namespace

Eigen::MatrixXd ExactSolution::displacement(const Eigen::VectorXd& times) const {
  return parts->model.motion(parts->iterate.forces, *parts->period, times).displacement;
}

Eigen::MatrixXd ExactSolution::velocity(const Eigen::VectorXd& times) const {
  return parts->model.frequency * parts->model.motion(parts->iterate.forces, *parts->period, times).velocity;
}

Eigen::MatrixXd ExactSolution::force(const Eigen::VectorXd& times) const {
  Eigen::MatrixXd forces = detail::force_at(parts->iterate.forces, parts->model, times);
  if (parts->model.holding == 0.0) return forces;
  // Holding springs of a free structure are subtracted; at open contacts rounding would remain.
  forces += parts->model.holding * displacement(times);
  for (Index c = 0; c < forces.rows(); ++c)
    for (Index k = 0; k < times.size(); ++k)
      if (!acts(intervals, int(c), times[k])) forces(c, k) = 0.0;
  return forces;
}

double ExactSolution::frequency() const { return parts->model.frequency; }

double ExactSolution::energy_lost() const {
  double sum = 0.0;
  for (const Impact& impact : impacts) sum += impact.energy_lost;
  return sum;
}

Eigen::VectorXcd ExactSolution::multipliers(int max_states) const {
  if (parts->multipliers) return parts->multipliers();
  Eigen::VectorXcd values = parts->model.response.free_multipliers();
  if (!parts->iterate.forces.panels().empty()) {
    const auto map = map_of(*parts);
    const bool computed = map && map->free.rows() <= max_states && map->unknowns_by.allFinite();
    values = computed ? detail::map_multipliers(map->all()) : Eigen::VectorXcd();
  }
  if (!values.allFinite()) return {};
  std::sort(values.begin(), values.end(),
            [](std::complex<double> a, std::complex<double> b) { return std::abs(a) > std::abs(b); });
  return values;
}

int ExactSolution::count_unstable(int max_evaluations) const {
  if (parts->multipliers) return detail::count_outside(parts->multipliers());
  if (parts->iterate.forces.panels().empty())
    return detail::count_outside(parts->model.response.free_multipliers());
  const auto map = map_of(*parts);
  return map && map->unknowns_by.allFinite() ? detail::count_unstable(*map, max_evaluations) : -1;
}

namespace detail {

void set_parts(ExactSolution& motion, const CollocationModel& model, const CollocationResult& solved,
               const LegendreNodes& nodes) {
  const CollocationIterate& iterate = solved.iterate;
  for (const LayoutInterval& interval : iterate.layout.intervals) {
    if (!model.laws[static_cast<std::size_t>(interval.contact)].exerts(interval.piece)) continue;
    const double begin = iterate.layout.begin(interval), whole = std::floor(begin);
    motion.intervals.push_back(
        {interval.contact, interval.piece, begin - whole, iterate.layout.end(interval) - whole});
  }
  std::sort(motion.intervals.begin(), motion.intervals.end(),
            [](const ForceInterval& a, const ForceInterval& b) {
              return std::pair(a.contact, a.begin) < std::pair(b.contact, b.begin);
            });
  const CellGrid& grid = iterate.forces.grid();
  motion.parts =
      ExactSolution::Parts::complete({model, iterate, nodes, PanelForces(grid, nodes, solved.tangent),
                                      PanelForces(grid, nodes, solved.damping)});
}

}  // namespace detail
}  // namespace wavebalance::solvers
