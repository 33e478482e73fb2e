#include "flow/flow_start.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/law_machine.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The discrete states of all contacts at each time.
std::vector<std::vector<int>> states_along(const std::vector<ContactMachine>& machines,
                                           const Eigen::MatrixXd& displacement,
                                           const Eigen::MatrixXd& force) {
  std::vector<std::vector<int>> result;
  for (Index k = 0; k < displacement.cols(); ++k) {
    std::vector<int>& now = result.emplace_back();
    for (const ContactMachine& machine : machines) {
      const auto rows = std::size_t(machine.law->rows());
      std::array<double, 2> memory{};
      now.push_back(machine.law->at({displacement.col(k).data() + machine.row, rows},
                                    {force.col(k).data() + machine.row, rows}, memory));
    }
  }
  return result;
}

struct CalmSamples {
  Index begin, length;
};

// The longest time in which no contact changes its state.
CalmSamples longest_calm(const std::vector<std::vector<int>>& states) {
  const auto count = Index(states.size());
  const auto at = [&](Index k) -> const std::vector<int>& { return states[std::size_t(k % count)]; };
  Index first = 0;
  while (first < count && at(first) == at(first + 1)) ++first;
  if (first == count) return {0, count};
  CalmSamples longest{0, 0};
  for (Index k = first + 1, begin = k; k <= first + count; ++k) {
    if (at(k) == at(k + 1)) continue;
    if (k + 1 - begin > longest.length) longest = {begin, k + 1 - begin};
    begin = k + 1;
  }
  return longest;
}

// The time at which the contacts move fastest: they begin to touch where they stop.
Index fastest_time(const Eigen::MatrixXd& displacement) {
  const Index count = displacement.cols();
  Index best = 0;
  double fastest = -1.0;
  for (Index k = 0; k < count; ++k) {
    const double moved =
        (displacement.col((k + 1) % count) - displacement.col((k + count - 1) % count)).norm();
    if (moved <= fastest) continue;
    fastest = moved;
    best = k;
  }
  return best;
}

Eigen::MatrixXd from_column(const Eigen::MatrixXd& values, Index first) {
  Eigen::MatrixXd result(values.rows(), values.cols());
  const Index rest = values.cols() - first;
  result << values.rightCols(rest), values.leftCols(first);
  return result;
}

// Column n belongs to Re(a exp(2 pi i n t)).
Eigen::MatrixXcd harmonics_of(const Eigen::MatrixXd& samples) {
  const Index count = samples.cols();
  Eigen::MatrixXcd result(samples.rows(), count / 2 + 1);
  for (Index c = 0; c < samples.rows(); ++c)
    result.row(c) = translate_spectrum(samples.row(c).transpose()).transpose() * (2.0 / double(count));
  result.col(0) *= 0.5;
  if (count % 2 == 0) result.col(count / 2) *= 0.5;
  return result;
}

}  // namespace

PeriodStart start_near(const ExactProblem& problem, const Eigen::MatrixXd& displacement,
                       const Eigen::MatrixXd& force, double share_of_calm) {
  const auto machines =
      machines_of(problem.laws, problem.dynamics, displacement.cwiseAbs().maxCoeff(), problem.frequency);
  const CalmSamples calm = longest_calm(states_along(machines, displacement, force));
  const Index count = displacement.cols(),
              first = calm.length == count
                          ? fastest_time(displacement)
                          : (calm.begin + Index(share_of_calm * double(calm.length))) % count;
  const double begin = double(first) / double(count);
  ContactFlow flow(begun_at(problem, begin), {});
  flow.start_near(harmonics_of(from_column(force - problem.dynamics.holding() * displacement, first)),
                  displacement.col(first), force.col(first));
  return {begin, flow.state(), flow.contact_states()};
}

Calm longest_calm(const std::vector<FlowEvent>& events, double whole) {
  if (events.empty()) return {0.0, whole};
  Calm longest{events.back().time, events.front().time + whole - events.back().time};
  for (std::size_t i = 1; i < events.size(); ++i)
    if (const double length = events[i].time - events[i - 1].time; length > longest.length)
      longest = {events[i - 1].time, length};
  return longest;
}

std::optional<PeriodStart> calmed(const ExactProblem& problem, const PeriodStart& start,
                                  const std::vector<FlowEvent>& events, double share_of_calm,
                                  const FlowOptions& options) {
  if (events.empty()) return start;
  const double whole = 1.0 / problem.frequency;
  const Calm calm = longest_calm(events, whole);
  const double later = std::fmod(calm.begin + share_of_calm * calm.length, whole);
  ContactFlow flow(begun_at(problem, start.begin), options);
  flow.start(start.state, start.contacts);
  if (flow.advance_to(later) != FlowStatus::converged) return std::nullopt;
  return PeriodStart{std::fmod(start.begin + later / whole, 1.0), flow.state(), flow.contact_states()};
}

ExactProblem begun_at(ExactProblem problem, double begin) {
  for (Index n = 0; n < problem.linear_motion.cols(); ++n)
    problem.linear_motion.col(n) *= std::polar(1.0, 2.0 * std::numbers::pi * double(n) * begin);
  return problem;
}

}  // namespace wavebalance::solvers::detail
