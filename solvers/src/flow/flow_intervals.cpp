#include "flow/flow_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "collocation/exact_solution_parts.hpp"
#include "flow/panel.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"

namespace wavebalance::solvers {
namespace detail {
namespace {

// A time in which a contact stays in one state, in periods: 0 <= begin < 1.
struct Stay {
  int state;
  double begin, end;
};

double within_period(double time) { return time - std::floor(time); }

// Intervals of one contact, in the order of time from the beginning of the flow.
std::vector<Stay> stays_of(const ContactFlow& flow, std::size_t contact, double begin) {
  std::vector<Stay> stays;
  for (const FlowPanel& panel : flow.panels()) {
    const int state = panel.states[contact];
    const double from = begin + panel.begin / flow.period(), to = begin + panel.end / flow.period();
    if (stays.empty() || stays.back().state != state)
      stays.push_back({state, from, to});
    else
      stays.back().end = to;
  }
  if (stays.size() == 1) return {{stays.front().state, 0.0, 1.0}};
  if (stays.front().state == stays.back().state) {
    stays.front().begin = stays.back().begin - 1.0;
    stays.pop_back();
  }
  for (Stay& stay : stays) {
    const double whole = std::floor(stay.begin);
    stay.begin -= whole;
    stay.end -= whole;
  }
  return stays;
}

double sign_of_slip(ContactState kind, int state) {
  if (kind != ContactState::slip) return 0.0;
  return state == 2 ? 1.0 : -1.0;
}

// Stick has the sign of the slip before; slip in a plane has none.
FrictionAlong friction_along(const ContactMachine& machine, const FrictionConstants& constants,
                             const std::vector<Stay>& stays) {
  FrictionAlong along{machine.row, constants, {}};
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const Stay &stay = stays[i], &before = stays[(i + stays.size() - 1) % stays.size()];
    const ContactState kind = machine.law->kind(stay.state);
    FrictionPart part{FrictionPart::State::stick, stay.begin, stay.end, 0.0, 0.0};
    if (kind == ContactState::open) part.state = FrictionPart::State::open;
    if (kind == ContactState::slip) part.state = FrictionPart::State::slip;
    const Stay& signs = kind == ContactState::stick ? before : stay;
    if (constants.tangents == 1) part.sign = sign_of_slip(machine.law->kind(signs.state), signs.state);
    along.parts.push_back(part);
  }
  std::sort(along.parts.begin(), along.parts.end(),
            [](const FrictionPart& a, const FrictionPart& b) { return a.begin < b.begin; });
  return along;
}

// States of machines are numbered as the pieces of their laws are.
void append_exact(const ContactMachine& machine, int tangents, const std::vector<Stay>& stays,
                  std::vector<ForceInterval>& intervals) {
  for (const Stay& stay : stays) {
    if (machine.law->kind(stay.state) == ContactState::open) continue;
    const int end = machine.row + machine.law->rows();
    for (int row = machine.row; row < end; ++row)
      intervals.push_back({row, row < end - tangents ? 1 : stay.state, stay.begin, stay.end});
  }
}

// The period as cells, each with a panel for every row that has a force.
CellGrid grid_of(const ContactFlow& flow, double begin, Index rows, std::vector<Eigen::VectorXd>& values) {
  std::vector<std::pair<double, const FlowPanel*>> cells;
  for (const FlowPanel& panel : flow.panels())
    cells.emplace_back(within_period(begin + panel.begin / flow.period()), &panel);
  std::sort(cells.begin(), cells.end());
  CellGrid grid;
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const auto& [from, panel] = cells[j];
    grid.boundaries.push_back(from);
    const double to = j + 1 < cells.size() ? cells[j + 1].first : cells.front().first + 1.0;
    for (Index row = 0; row < rows; ++row) {
      if (panel->force.row(row).isZero(0.0)) continue;
      grid.panels.push_back({int(row), int(row), int(j), from, to, 1});
      values.push_back(panel->force.row(row).transpose());
    }
  }
  return grid;
}

}  // namespace

std::vector<Impact> impacts_of(const ContactFlow& flow, double begin) {
  std::vector<Impact> impacts;
  for (const FlowEvent& one : flow.events())
    if (one.impulse > 0.0)
      impacts.push_back({.contact = flow.machines()[std::size_t(one.contact)].row,
                         .time = within_period(begin + one.time / flow.period()),
                         .velocity_before = one.speed,
                         .velocity_after = one.after,
                         .impulse = one.impulse,
                         .energy_lost = 0.5 * one.impulse * (one.speed + one.after)});
  std::sort(impacts.begin(), impacts.end(), [](const Impact& a, const Impact& b) { return a.time < b.time; });
  return impacts;
}

namespace {

// Each impact is where two panels meet.
void set_impulses(CellGrid& grid, const std::vector<Impact>& impacts, double frequency) {
  for (const Impact& one : impacts)
    grid.impulses.push_back({one.contact, grid.boundary_near(one.time), one.impulse * frequency});
}

PanelForces forces_of(const CellGrid& grid, const LegendreNodes& nodes,
                      const std::vector<Eigen::VectorXd>& values) {
  Eigen::VectorXd all(nodes.count() * Index(values.size()));
  for (std::size_t p = 0; p < values.size(); ++p)
    all.segment(nodes.count() * Index(p), nodes.count()) = values[p];
  return {grid, nodes, all};
}

}  // namespace

Eigen::VectorXcd states_by_pole(const ContactDynamics& dynamics, const Eigen::VectorXd& state) {
  return RealStates(exponents_of(dynamics)).complex_of(state).col(0);
}

ExactSolution motion_of(const ExactProblem& problem, const ContactFlow& flow, const PeriodStart& start) {
  ExactSolution motion;
  const double begin = start.begin;
  for (std::size_t c = 0; c < flow.machines().size(); ++c) {
    const ContactMachine& machine = flow.machines()[c];
    const std::vector<Stay> stays = stays_of(flow, c, begin);
    const auto constants = problem.laws[machine.row].friction();
    if (constants) {
      motion.friction.push_back(friction_along(machine, *constants, stays));
      motion.cycles.push_back(flow.cycles()[c]);
    }
    append_exact(machine, constants ? constants->tangents : 1, stays, motion.intervals);
  }
  std::sort(motion.intervals.begin(), motion.intervals.end(),
            [](const ForceInterval& a, const ForceInterval& b) {
              return std::pair(a.contact, a.begin) < std::pair(b.contact, b.begin);
            });
  std::vector<Eigen::VectorXd> values;
  CellGrid grid = grid_of(flow, begin, problem.dynamics.contacts(), values);
  motion.impacts = impacts_of(flow, begin);
  set_impulses(grid, motion.impacts, problem.frequency);
  const LegendreNodes nodes(panel_nodes);
  ExactSolution::Parts parts{CollocationModel(problem, 1.0), {}, nodes, {}, {}};
  grid.begin = {grid.boundary_near(begin),
                parts.model.response.states(states_by_pole(problem.dynamics, start.state))};
  parts.iterate.forces = forces_of(grid, nodes, values);
  parts.start = start;
  motion.parts = ExactSolution::Parts::complete(std::move(parts));
  return motion;
}

void set_multipliers(ExactSolution& motion, Eigen::VectorXcd multipliers) {
  ExactSolution::Parts parts = *motion.parts;
  parts.multipliers = [known = std::move(multipliers)] { return known; };
  motion.parts = ExactSolution::Parts::complete(std::move(parts));
}

}  // namespace detail

}  // namespace wavebalance::solvers
