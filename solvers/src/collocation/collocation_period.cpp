#include "collocation/collocation_period.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "collocation/collocation_evaluation.hpp"
#include "collocation/pole_response_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Cells that follow each other, with their panels and marks by their numbers in the grid of the period, and
// as a separate grid, whose last cell is the rest of the period.
struct Window {
  CellGrid grid;
  std::vector<std::size_t> panels, marks;

  // The numbers of its unknowns among n forces at q nodes each, and passages.
  std::vector<Index> unknowns(Index q, Index n) const {
    std::vector<Index> result;
    for (const std::size_t p : panels)
      for (Index k = 0; k < q; ++k) result.push_back(q * Index(p) + k);
    for (const std::size_t i : marks) result.push_back(n + Index(i));
    return result;
  }
};

// For each boundary, whether only the states of the poles continue over it: no panel, no passage at which
// the force of a panel vanishes that ends there, and none at which such a panel acts at once.
std::vector<bool> divisible(const Evaluation& now, const PoleResponse& response) {
  const CellGrid& grid = now.grid;
  std::vector<bool> result(std::size_t(grid.cells()), true);
  std::vector<std::vector<int>> forced(result.size());  // the contacts with a force in each cell
  for (const Panel& panel : grid.panels) {
    int cell = panel.cell;
    for (int i = 0; i < panel.cells; ++i, cell = grid.next(cell)) {
      if (i > 0) result[std::size_t(cell)] = false;
      forced[std::size_t(cell)].push_back(panel.contact);
    }
  }
  for (std::size_t i = 0; i < grid.marks.size(); ++i) {
    const CellGrid::Mark& mark = grid.marks[i];
    const std::vector<int>& before = forced[std::size_t(grid.before(mark.boundary))];
    if ((now.released[i].exists() && now.released[i].at_end) ||
        std::any_of(before.begin(), before.end(), [&](int contact) {
          return (contact != mark.contact || mark.acts_after) && response.acts_at_once(mark.contact, contact);
        }))
      result[std::size_t(mark.boundary)] = false;
  }
  return result;
}

// The cell after the longest one without a force, and its length; without any, one at which the period can be
// divided.
std::optional<std::pair<int, double>> first_cell(const CellGrid& grid, const std::vector<bool>& divisible) {
  std::vector<bool> forced(divisible.size(), false);
  for (const Panel& panel : grid.panels)
    for (int i = 0, cell = panel.cell; i < panel.cells; ++i, cell = grid.next(cell))
      forced[std::size_t(cell)] = true;
  std::pair<int, double> result{0, 0.0};
  for (int j = 0; j < grid.cells(); ++j)
    if (!forced[std::size_t(j)] && grid.length(j) > result.second) result = {grid.next(j), grid.length(j)};
  if (result.second > 0.0) return result;
  const auto found = std::find(divisible.begin(), divisible.end(), true);
  if (found == divisible.end()) return std::nullopt;
  return std::pair(int(found - divisible.begin()), 0.0);
}

// The windows of the period, in order of time from a first cell.
std::vector<Window> windows_of(const CellGrid& grid, const std::vector<bool>& divisible, int first) {
  std::vector<Window> windows;
  std::vector<std::pair<std::size_t, int>> place(divisible.size());  // window and cell of each cell
  for (int k = 0, j = first; k < grid.cells(); ++k, j = grid.next(j)) {
    if (k == 0 || divisible[std::size_t(j)]) windows.emplace_back();
    CellGrid& own = windows.back().grid;
    const double begin = own.boundaries.empty() ? grid.boundaries[std::size_t(j)] : own.boundaries.back();
    if (own.boundaries.empty()) own.boundaries.push_back(begin);
    place[std::size_t(j)] = {windows.size() - 1, own.cells() - 1};
    own.boundaries.push_back(begin + grid.length(j));
  }
  for (std::size_t p = 0; p < grid.panels.size(); ++p) {
    const auto [number, cell] = place[std::size_t(grid.panels[p].cell)];
    windows[number].panels.push_back(p);
    windows[number].grid.panels.push_back(grid.panels[p]);
    windows[number].grid.panels.back().cell = cell;
  }
  for (std::size_t i = 0; i < grid.marks.size(); ++i) {
    const auto [number, cell] = place[std::size_t(grid.marks[i].boundary)];
    windows[number].marks.push_back(i);
    windows[number].grid.marks.push_back(grid.marks[i]);
    windows[number].grid.marks.back().boundary = cell;
  }
  return windows;
}

// Part of an evaluation that belongs to a window with these unknowns.
Evaluation part_of(const Evaluation& now, const Window& window, const std::vector<Index>& unknowns) {
  const Index own_marks = Index(window.marks.size());
  const std::vector<Index> nodes(unknowns.begin(), unknowns.end() - own_marks);
  Evaluation part;
  part.grid = window.grid;
  part.force = now.force(nodes);
  part.tangent = now.tangent(nodes);
  part.damping = now.damping(nodes);
  part.own = now.own(nodes);
  part.passing.resize(own_marks);
  for (Index i = 0; i < own_marks; ++i) {
    const std::size_t mark = window.marks[std::size_t(i)];
    part.passing[i] = now.passing[Index(mark)];
    part.released.push_back(now.released[mark]);
    if (!part.released.back().exists()) continue;
    const auto own =
        std::find(window.panels.begin(), window.panels.end(), std::size_t(part.released.back().panel));
    part.released.back().panel = int(own - window.panels.begin());
  }
  part.holding = now.holding;
  part.force_size = now.force_size;
  part.displacement_size = now.displacement_size;
  return part;
}

// Re(a b).
Eigen::MatrixXd real_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return product(a.real(), b.real()) - product(a.imag(), b.imag());
}

Eigen::MatrixXcd times(const Eigen::MatrixXcd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXcd result(a.rows(), b.cols());
  result.real() = product(a.real(), b);
  result.imag() = product(a.imag(), b);
  return result;
}

// Whether the poles do the same within both: windows of equal panels without passages.
bool is_alike(const CellGrid& a, const CellGrid& b) {
  constexpr double rounding = 1e-15;  // periods
  if (!a.marks.empty() || !b.marks.empty() || a.cells() != b.cells() || a.panels.size() != b.panels.size())
    return false;
  for (int j = 0; j + 1 < a.cells(); ++j)
    if (std::abs(a.length(j) - b.length(j)) > rounding) return false;
  return std::equal(a.panels.begin(), a.panels.end(), b.panels.begin(), [](const Panel& p, const Panel& q) {
    return p.contact == q.contact && p.cell == q.cell && p.cells == q.cells;
  });
}

// Result of a window: its unknowns and its final states.
struct Passed {
  std::vector<Index> unknowns;
  Eigen::MatrixXd by_start;    // unknowns x s, by the states at the begin of the period
  Eigen::MatrixXcd states_by;  // poles x unknowns
  Eigen::VectorXcd decay;
};

// Advances the states of perturbations, poles x s, from window to window of a solution.
class Passing {
 public:
  Passing(const CollocationModel& model, const LegendreNodes& nodes, const Evaluation& now,
          const Eigen::VectorXd& impulses, Eigen::MatrixXcd start)
      : model_(model), nodes_(nodes), now_(now), impulses_(impulses), states_(std::move(start)) {}

  // Nothing where the equations are singular.
  std::optional<Passed> pass(const Window& window) {
    if (!cells_ || !is_alike(window.grid, grid_))
      cells_ = model_.response.free_cells(*model_.response.cells(window.grid, nodes_), model_.velocity);
    grid_ = window.grid;
    Passed passed{window.unknowns(nodes_.count(), now_.force.size()), {}, {}, cells_->decay};
    if (passed.unknowns.empty()) {
      states_.array().colwise() *= cells_->decay.array();
      return passed;
    }
    const Evaluation own = part_of(now_, window, passed.unknowns);
    const Eigen::VectorXd impulses = impulses_(passed.unknowns);
    const Lu<double> factor(jacobian(own, impulses, nodes_, cells_->influence));
    if (factor.is_singular()) return std::nullopt;
    const Eigen::MatrixXd velocity =
        model_.velocity ? real_product(cells_->velocity_by, states_) : Eigen::MatrixXd();
    passed.by_start =
        factor.solve(residual_by_motion(own, real_product(cells_->displacement_by, states_), velocity));
    passed.states_by = cells_->states_by * impulses.asDiagonal();
    states_.array().colwise() *= cells_->decay.array();
    states_ -= times(passed.states_by, passed.by_start);
    return passed;
  }

 private:
  const CollocationModel& model_;
  const LegendreNodes& nodes_;
  const Evaluation& now_;
  const Eigen::VectorXd& impulses_;
  Eigen::MatrixXcd states_;
  CellGrid grid_;                   // of the last window
  std::optional<FreeCells> cells_;  // the same
};

// Those that leave more than rounding after a flight of so many periods; poles are in the order of their
// decay.
Index lasting_poles(const Eigen::VectorXcd& exponents, double flight) {
  constexpr double negligible = 1e-18;
  Index left = 0;
  while (left < exponents.size() && std::exp(flight * exponents[left].real()) > negligible) ++left;
  return left;
}

// The map by what each window does, in order of time.
PeriodMap map_by(const std::vector<Passed>& windows, const RealStates& lasting, Index poles, Index unknowns) {
  PeriodMap map{{}, Eigen::MatrixXd(lasting.size(), unknowns), Eigen::MatrixXd(unknowns, lasting.size())};
  Eigen::VectorXcd decay = Eigen::VectorXcd::Ones(poles);
  for (auto window = windows.rbegin(); window != windows.rend(); ++window) {
    if (!window->unknowns.empty()) {
      map.by_unknowns(Eigen::all, window->unknowns) =
          lasting.real_of(decay.asDiagonal() * window->states_by.topRows(poles));
      map.unknowns_by(window->unknowns, Eigen::all) = window->by_start;
    }
    decay.array() *= window->decay.head(poles).array();
  }
  map.free = lasting.diagonal(decay);
  return map;
}

}  // namespace

Eigen::MatrixXd PeriodMap::all() const { return free - product(by_unknowns, unknowns_by); }

std::optional<PeriodMap> period_map(const CollocationModel& model, const CollocationIterate& solved,
                                    const Layout& panels, const LegendreNodes& nodes) {
  const Evaluation now = on_panels_of(panels, model, evaluate(model, solved, nodes), nodes);
  const Eigen::VectorXd impulses = impulses_of(panels, now, nodes);
  const std::vector<bool> divides = divisible(now, model.response);
  const auto first = first_cell(now.grid, divides);
  if (!first) return std::nullopt;
  const Eigen::VectorXcd& exponents = model.response.exponents();
  const Index left = lasting_poles(exponents, first->second);
  const RealStates lasting(exponents.head(left));
  Eigen::MatrixXcd start = Eigen::MatrixXcd::Zero(exponents.size(), lasting.size());
  start.topRows(left) = lasting.complex_of(Eigen::MatrixXd::Identity(lasting.size(), lasting.size()));
  Passing passing(model, nodes, now, impulses, std::move(start));
  std::vector<Passed> all;
  for (const Window& window : windows_of(now.grid, divides, first->first)) {
    auto passed = passing.pass(window);
    if (!passed) return std::nullopt;
    all.push_back(std::move(*passed));
  }
  return map_by(all, lasting, left, impulses.size());
}

}  // namespace wavebalance::solvers::detail
