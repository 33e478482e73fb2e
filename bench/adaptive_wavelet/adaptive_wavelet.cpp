#include "adaptive_wavelet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

void require_match(const CondensedProblem& problem, const MultiscaleBasis& basis) {
  if (basis.functions() == problem.pair().functions() && basis.points() == problem.points() &&
      problem.contact_free_response().size() == problem.points())
    return;
  throw std::invalid_argument("selected_balance: the basis has " + std::to_string(basis.functions()) +
                              " functions and " + std::to_string(basis.points()) + " points, the problem " +
                              std::to_string(problem.pair().functions()) + " and " +
                              std::to_string(problem.points()) + " with " +
                              std::to_string(problem.contact_free_response().size()) +
                              " samples; they must agree, with one contact and a frequency");
}

// A force at one sample beside whose effect the contact-free response is rounding: their difference loses
// nothing.
double dominant_force(CondensedProblem& problem, const Eigen::VectorXcd& free) {
  const double effect = (problem.coefficients(Eigen::VectorXd::Unit(problem.points(), 0)) - free).norm();
  if (!(effect > 0.0) || free.norm() == 0.0) return 1.0;
  return std::exp2(std::ceil(std::log2(free.norm() / effect)) + 20.0);
}

// Squared coefficients of u0 - K f_c outside the selection.
Eigen::VectorXd residual_indicator(CondensedProblem& problem, const MultiscaleBasis& basis,
                                   const SelectedResponse& response) {
  Eigen::VectorXd missing = basis.analysis(problem.coefficients(response.contact_force));
  for (const int function : response.selection) missing[function] = 0.0;
  return missing.cwiseAbs2();
}

// The indicator of a function that is not selected: the sum of the squares of the selected details next to
// it.
Eigen::VectorXd detail_indicator(const MultiscaleBasis& basis, const SelectedResponse& response) {
  Eigen::VectorXd indicator = Eigen::VectorXd::Zero(basis.functions());
  const std::set<int> selected(response.selection.begin(), response.selection.end());
  for (std::size_t i = 0; i < response.selection.size(); ++i) {
    const int function = response.selection[i];
    const int block = basis.block_of(function);
    if (block == 0) continue;
    const double square = std::pow(response.coefficients[static_cast<Eigen::Index>(i)], 2);
    for (int b = block; b <= block + 1 && b < basis.blocks(); ++b)
      for (const int other : basis.around(b, basis.centre(function), 1.0 / basis.size(block)))
        if (!selected.contains(other)) indicator[other] = std::max(indicator[other], square);
  }
  return indicator;
}

// The selection with the fewest functions added that hold `fraction` of the indicator's sum.
Selection refined(const Selection& selection, const Eigen::VectorXd& indicator, double fraction, int most) {
  std::vector<int> order(static_cast<std::size_t>(indicator.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return indicator[a] > indicator[b]; });
  const double target = fraction * indicator.sum();
  Selection result = selection;
  double sum = 0.0;
  for (const int function : order) {
    if (sum >= target || indicator[function] == 0.0 || static_cast<int>(result.size()) >= most) break;
    sum += indicator[function];
    result.push_back(function);
  }
  std::sort(result.begin(), result.end());
  return result;
}

void require_usable(const AdaptiveOptions& options) {
  if (!(options.fraction > 0.0 && options.fraction <= 1.0))
    detail::reject("adaptive_response", "fraction", options.fraction, "above 0 and at most 1");
  detail::require_positive("adaptive_response", "tolerance", options.tolerance);
  detail::require_positive("adaptive_response", "growth", options.growth);
  detail::require_at_least("adaptive_response", "max_rounds", options.max_rounds, 1);
}

}  // namespace

SelectedBalance selected_balance(CondensedProblem& problem, const MultiscaleBasis& basis,
                                 const Selection& selection) {
  require_match(problem, basis);
  basis.require_selection(selection);
  const auto count = static_cast<Eigen::Index>(selection.size());
  const int points = basis.points(), functions = basis.functions(), ratio = points / functions;
  SelectedBalance balance{selection, Eigen::VectorXd(count), Eigen::MatrixXd(points, count),
                          basis.samples(selection)};
  const Eigen::VectorXcd free = problem.coefficients(Eigen::VectorXd::Zero(points));
  const Eigen::VectorXd all = basis.analysis(free);
  for (Eigen::Index j = 0; j < count; ++j) balance.free[j] = all[selection[static_cast<std::size_t>(j)]];
  const double force = dominant_force(problem, free);
  // A force at sample l + ratio i does what that at l does, i fine translates later.
  for (int l = 0; l < ratio; ++l) {
    const Eigen::VectorXcd answer = problem.coefficients(force * Eigen::VectorXd::Unit(points, l));
    const Eigen::MatrixXd products = basis.correlations((free - answer) / force);
    for (Eigen::Index j = 0; j < count; ++j) {
      const int function = selection[static_cast<std::size_t>(j)];
      const int block = basis.block_of(function), offset = basis.offset(function);
      for (int i = 0; i < functions; ++i)
        balance.effect(l + ratio * i, j) = products(offset >= i ? offset - i : offset - i + functions, block);
    }
  }
  return balance;
}

AdaptiveResponse adaptive_response(CondensedProblem& problem, const MultiscaleBasis& basis,
                                   const AnyContactLaw& law, const AdaptiveOptions& options) {
  require_usable(options);
  AdaptiveResponse result;
  Selection selection = basis.uniform(options.complete_blocks);
  Eigen::VectorXd before;
  for (int round = 0; round < options.max_rounds; ++round) {
    result.rounds.push_back(
        {selected_response(selected_balance(problem, basis, selection), law, options.newton, before)});
    AdaptiveRound& current = result.rounds.back();
    if (!current.response.converged()) return result;
    const Eigen::VectorXd& u = current.response.displacement;
    if (round > 0) current.estimate = (u - before).norm() / u.norm();
    before = u;
    result.met_tolerance = current.estimate <= options.tolerance;
    if (result.met_tolerance) return result;
    const Eigen::VectorXd indicator = options.marking == Marking::residual
                                          ? residual_indicator(problem, basis, current.response)
                                          : detail_indicator(basis, current.response);
    const int count = static_cast<int>(selection.size());
    const int most = std::min(options.max_functions, count + std::max(1, int(options.growth * count)));
    Selection next = refined(selection, indicator, options.fraction, most);
    if (next == selection) return result;
    selection = std::move(next);
  }
  return result;
}

Selection near_instants(const MultiscaleBasis& basis, const std::vector<double>& instants, int complete,
                        int blocks, double reach) {
  const Selection coarse = basis.uniform(complete);
  std::set<int> selected(coarse.begin(), coarse.end());
  for (int b = complete; b < blocks && b < basis.blocks(); ++b)
    for (const double instant : instants)
      for (const int function : basis.around(b, instant, reach / basis.size(b))) selected.insert(function);
  return {selected.begin(), selected.end()};
}

std::vector<double> contact_instants(const Eigen::VectorXd& displacement, double gap) {
  std::vector<double> instants;
  const Eigen::Index points = displacement.size();
  for (Eigen::Index l = 0; l < points; ++l) {
    const double here = displacement[l] - gap, next = displacement[(l + 1) % points] - gap;
    if ((here > 0.0) != (next > 0.0)) instants.push_back((double(l) + here / (here - next)) / double(points));
  }
  return instants;
}

}  // namespace wavebalance::solvers
