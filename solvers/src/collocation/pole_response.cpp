#include "collocation/pole_response.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "collocation/pole_response_parts.hpp"
#include "linalg/dense.hpp"
#include "linalg/one_less_exp.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers::detail {
double CellGrid::length(int cell) const {
  const auto j = static_cast<std::size_t>(cell);
  return cell + 1 == cells() ? boundaries[0] + 1.0 - boundaries[j] : boundaries[j + 1] - boundaries[j];
}

int CellGrid::boundary_near(double time) const {
  const double within = time - std::floor(time);
  const auto above =
      static_cast<int>(std::lower_bound(boundaries.begin(), boundaries.end(), within) - boundaries.begin());
  const int after = above == cells() ? 0 : above, before = above == 0 ? cells() - 1 : above - 1;
  const auto distance = [&](int j) {
    const double d = boundaries[static_cast<std::size_t>(j)] - within;
    return std::abs(d - std::round(d));
  };
  return distance(before) < distance(after) ? before : after;
}

PoleResponse::PoleResponse(const ContactDynamics& dynamics, double period)
    : order_(dynamics.poles().size()), period_(period), constant_(dynamics.constant()) {
  const std::vector<ContactPole>& poles = dynamics.poles();
  std::iota(order_.begin(), order_.end(), Index{0});
  std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) {
    return poles[std::size_t(a)].exponent.real() > poles[std::size_t(b)].exponent.real();
  });
  exponents_ = period * exponents_of(dynamics)(order_);
  shapes_ = period * shapes_of(dynamics)(Eigen::all, order_);
  left_ = inputs_of(dynamics)(order_, Eigen::all).transpose();
  periodic_ = exponents_.unaryExpr(&one_less_exp).cwiseInverse();
  jump_ = (shapes_ * left_.transpose()).real();
  constexpr double rounding = 1e-9;
  const Eigen::MatrixXd size = shapes_.cwiseAbs() * left_.cwiseAbs().transpose();
  jump_ = (jump_.array().abs() > rounding * size.array()).select(jump_, 0.0);
}

Eigen::VectorXcd PoleResponse::states(const Eigen::VectorXcd& by_pole) const {
  return -by_pole(order_) / period_;
}

double PoleResponse::acceleration_at_once(int c) const {
  return std::abs(weights(c, c).cwiseProduct(exponents_).sum().real());
}

Eigen::VectorXcd PoleResponse::weights(int displaced, int forced) const {
  return shapes_.row(displaced).cwiseProduct(left_.row(forced)).transpose();
}

// For the cell that begins at a time of the panel.
PoleResponse::Part PoleResponse::part_of(const CellGrid& grid, std::size_t number, double begin,
                                         double length, bool last, const LegendreNodes& nodes) {
  const Panel& panel = grid.panels[number];
  const Index q = nodes.count();
  Part part{number, 0, q, 0, nodes.points, {}, nodes.coefficients};
  if (panel.cells == 1) {
    part.restriction.setIdentity(q, q);
    return part;
  }
  const auto before = [&](double time) {
    return (nodes.points.array() * (0.5 * panel.length()) + 0.5 * (panel.begin + panel.end) < time).count();
  };
  part.first = begin > panel.begin ? before(begin) : 0;
  part.count = (last ? q : before(begin + length)) - part.first;
  part.points.resize(part.count);
  for (Index i = 0; i < part.count; ++i)
    part.points[i] =
        std::clamp(2.0 * (panel.time(nodes.points[part.first + i]) - begin) / length - 1.0, -1.0, 1.0);
  const double from = 2.0 * (begin - panel.begin) / panel.length() - 1.0, share = length / panel.length();
  const Eigen::VectorXd within = from + share * (nodes.points.array() + 1.0);
  part.restriction = nodes.coefficients * legendre_values(within, q);
  part.coefficients = part.restriction * nodes.coefficients;
  return part;
}

std::shared_ptr<const PeriodCells> PoleResponse::cells(const CellGrid& grid,
                                                       const LegendreNodes& nodes) const {
  auto period = std::make_shared<PeriodCells>(
      PeriodCells{grid, nodes, std::vector<Cell>(static_cast<std::size_t>(grid.cells()))});
  for (std::size_t p = 0; p < grid.panels.size(); ++p) {
    double begin = grid.panels[p].begin;
    int cell = grid.panels[p].cell;
    for (int i = 0; i < grid.panels[p].cells; ++i, cell = grid.next(cell)) {
      const double length = grid.length(cell);
      const bool last = i + 1 == grid.panels[p].cells;
      period->cells[static_cast<std::size_t>(cell)].parts.push_back(
          part_of(grid, p, begin, length, last, nodes));
      begin += length;
    }
  }
  for (int j = 0; j < grid.cells(); ++j) {
    Cell& cell = period->cells[static_cast<std::size_t>(j)];
    cell.length = grid.length(j);
    const Eigen::VectorXcd z = (0.5 * cell.length) * exponents_;
    if (cell.parts.empty()) {
      cell.decay = (2.0 * z.array()).exp();
      continue;
    }
    cell.waves.emplace(z, nodes.count());
    cell.decay = cell.waves->decay();
    if (std::all_of(cell.parts.begin(), cell.parts.end(),
                    [&](const Part& part) { return grid.panels[part.panel].cells == 1; }))
      continue;
    Index count = 0;
    for (Part& part : cell.parts) {
      part.row = count;
      count += part.count;
    }
    cell.points.emplace(count);
    for (const Part& part : cell.parts) cell.points->segment(part.row, part.count) = part.points;
  }
  period->waves.resize(period->cells.size());
  for (std::size_t j = 0; j < period->cells.size(); ++j) {
    const Cell& cell = period->cells[j];
    if (cell.points)
      period->waves[j].emplace(*cell.waves, nodes, *cell.points);
    else if (cell.waves)
      period->waves[j].emplace(*cell.waves, nodes);
  }
  return period;
}

// Numbers of the equations: n displacements at nodes, m displacements and m velocities at marks, and n
// velocities at nodes.
std::vector<PoleResponse::Rows> PoleResponse::rows_of(const PeriodCells& period, bool velocity) const {
  const auto& [grid, nodes, cells, waves] = period;
  const Index n = period.count(), m = period.marks(), poles = exponents_.size();
  std::vector<Rows> rows(cells.size());
  std::vector<std::vector<std::size_t>> marks(cells.size());
  for (std::size_t i = 0; i < grid.marks.size(); ++i)
    marks[static_cast<std::size_t>(grid.marks[i].boundary)].push_back(i);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    Index of_panels = 0;
    for (const Part& part : cells[j].parts) of_panels += part.count * (velocity ? 2 : 1);
    Eigen::MatrixXcd states(of_panels + 2 * Index(marks[j].size()), poles);
    Index row = 0;
    const auto add = [&](const auto& block, Index number) {
      states.middleRows(row, block.rows()) = block;
      row += block.rows();
      for (Index i = 0; i < block.rows(); ++i) rows[j].numbers.push_back(number + i);
    };
    for (const Part& part : cells[j].parts) {
      const Eigen::VectorXcd shape = shapes_.row(grid.panels[part.panel].contact).transpose();
      const Eigen::MatrixXcd displacement =
          waves[j]->values().middleRows(part.row, part.count) * shape.asDiagonal();
      const Index number = nodes.count() * Index(part.panel) + part.first;
      add(displacement, number);
      if (velocity) add(displacement * exponents_.asDiagonal(), n + 2 * m + number);
    }
    for (const std::size_t i : marks[j]) {
      const Eigen::RowVectorXcd shape = shapes_.row(grid.marks[i].contact);
      add(shape, n + Index(i));
      add(shape.cwiseProduct(exponents_.transpose()), n + m + Index(i));
    }
    rows[j].real = states.real();
    rows[j].imag = states.imag();
  }
  return rows;
}

std::vector<PoleResponse::Sources> PoleResponse::sources_of(const PeriodCells& period) const {
  const auto& [grid, nodes, cells, waves] = period;
  const Index count = nodes.count(), n = period.count();
  std::vector<Sources> sources(cells.size());
  for (std::size_t j = 0; j < cells.size(); ++j) {
    Index marks = 0;
    const auto begins = static_cast<int>(j);
    for (const CellGrid::Mark& mark : grid.marks) marks += mark.boundary == begins ? 1 : 0;
    const Cell& ending = cells[static_cast<std::size_t>(grid.before(begins))];
    sources[j].states.resize(exponents_.size(), count * Index(ending.parts.size()) + marks);
    Index column = 0;
    Eigen::MatrixXd coefficients(count, count * Index(ending.parts.size()));
    for (const Part& part : ending.parts) {
      coefficients.middleCols(column, count) = part.coefficients;
      for (Index k = 0; k < count; ++k) sources[j].numbers.push_back(count * Index(part.panel) + k);
      column += count;
    }
    if (column > 0) {
      sources[j].states.leftCols(column).real() = product(ending.waves->at_end().real(), coefficients);
      sources[j].states.leftCols(column).imag() = product(ending.waves->at_end().imag(), coefficients);
    }
    for (Index i = 0; i < Index(ending.parts.size()); ++i) {
      const int contact = grid.panels[ending.parts[std::size_t(i)].panel].contact;
      sources[j].states.middleCols(count * i, count).array().colwise() *=
          0.5 * ending.length * left_.row(contact).transpose().array();
    }
    for (std::size_t i = 0; i < grid.marks.size(); ++i) {
      if (grid.marks[i].boundary != begins) continue;
      sources[j].states.col(column++) = left_.row(grid.marks[i].contact).transpose();
      sources[j].numbers.push_back(n + Index(i));
    }
  }
  return sources;
}

// Effect of one panel on the nodes of another in a common cell.
void PoleResponse::add_between(const PeriodCells& period, const Cell& cell, const WavesAtNodes& waves,
                               const Part& from, const Part& to, bool velocity, Eigen::MatrixXd& all) const {
  const CellGrid& grid = period.grid;
  const Index count = period.nodes.count(), n = period.count(), m = period.marks();
  const int forced = grid.panels[from.panel].contact, displaced = grid.panels[to.panel].contact;
  const Eigen::VectorXcd weight = (0.5 * cell.length) * weights(displaced, forced);
  const Index row = count * Index(to.panel) + to.first, column = count * Index(from.panel);
  const auto add = [&](Index first, const Eigen::VectorXcd& of_poles, double factor) {
    auto block = all.block(first, column, to.count, count);
    block += product(waves.up_to(of_poles, to.row, to.count), from.coefficients);
    if (factor != 0.0) block += factor * at_once(from, to, count);
  };
  add(row, weight, constant_(displaced, forced));
  if (velocity) add(n + 2 * m + row, weight.cwiseProduct(exponents_), jump_(displaced, forced));
}

// The force of one panel at the nodes of another, by its values at its own nodes.
Eigen::MatrixXd PoleResponse::at_once(const Part& from, const Part& to, Index count) {
  if (to.count == count && from.count == count) return Eigen::MatrixXd::Identity(count, count);
  return product(legendre_values(to.points, count), from.coefficients);
}

// The same of all panels of a cell, by each pole's integrals up to all nodes there.
void PoleResponse::add_by_poles(const PeriodCells& period, const Cell& cell, const WavesAtNodes& waves,
                                bool velocity, Eigen::MatrixXd& all) const {
  const CellGrid& grid = period.grid;
  const Index count = period.nodes.count(), n = period.count(), m = period.marks(), poles = exponents_.size(),
              parts = Index(cell.parts.size());
  Eigen::MatrixXd left(2 * poles, parts);
  for (Index i = 0; i < parts; ++i) {
    const auto forced = left_.row(grid.panels[cell.parts[std::size_t(i)].panel].contact).transpose();
    left.col(i).head(poles) = 0.5 * cell.length * forced.real();
    left.col(i).tail(poles) = -0.5 * cell.length * forced.imag();
  }
  const std::vector<Eigen::MatrixXcd> integrals = waves.integrals();
  const auto add = [&](const Part& to, Index first, const Eigen::VectorXcd& shape,
                       const Eigen::MatrixXd& factors) {
    Eigen::MatrixXd seen(to.count * count, 2 * poles);
    for (Index r = 0; r < poles; ++r) {
      const Eigen::MatrixXcd own = shape[r] * integrals[std::size_t(r)].middleRows(to.row, to.count);
      seen.col(r) = own.real().reshaped();
      seen.col(poles + r) = own.imag().reshaped();
    }
    const Eigen::MatrixXd by_parts = product(seen, left);
    for (Index i = 0; i < parts; ++i) {
      const Part& from = cell.parts[std::size_t(i)];
      const double factor = factors(grid.panels[to.panel].contact, grid.panels[from.panel].contact);
      auto block = all.block(first, count * Index(from.panel), to.count, count);
      block += by_parts.col(i).reshaped(to.count, count) * from.coefficients;
      if (factor != 0.0) block += factor * at_once(from, to, count);
    }
  };
  for (const Part& to : cell.parts) {
    if (to.count == 0) continue;
    const Eigen::VectorXcd shape = shapes_.row(grid.panels[to.panel].contact).transpose();
    const Index row = count * Index(to.panel) + to.first;
    add(to, row, shape, constant_);
    if (velocity) add(to, n + 2 * m + row, shape.cwiseProduct(exponents_), jump_);
  }
}

// Contributions within the cell of an equation: up to each node, and immediate. For many pairs of panels,
// each pole once needs far less than a series for each pair.
void PoleResponse::add_within_cells(const PeriodCells& period, bool velocity, Eigen::MatrixXd& all) const {
  constexpr std::size_t few_pairs = 16;
  const auto& [grid, nodes, cells, waves] = period;
  const Index count = nodes.count(), n = period.count(), m = period.marks();
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Cell& cell = cells[j];
    if (cell.parts.size() * cell.parts.size() > few_pairs) {
      add_by_poles(period, cell, *waves[j], velocity, all);
      continue;
    }
    for (const Part& from : cell.parts)
      for (const Part& to : cell.parts)
        if (to.count > 0) add_between(period, cell, *waves[j], from, to, velocity, all);
  }
  for (Index i = 0; i < m; ++i) {
    const CellGrid::Mark& mark = grid.marks[static_cast<std::size_t>(i)];
    if (!mark.acts_before)
      all(n + i, n + i) -= jump_(mark.contact, mark.contact);  // it has acted before only
    for (const Part& part : cells[static_cast<std::size_t>(grid.before(mark.boundary))].parts) {
      const int forced = grid.panels[part.panel].contact;
      if (forced == mark.contact && !mark.acts_after) continue;             // its force ends with zero
      const Eigen::RowVectorXd at_end = part.coefficients.colwise().sum();  // P_k(1) = 1
      all.block(n + i, count * Index(part.panel), 1, count) += constant_(mark.contact, forced) * at_end;
      all.block(n + m + i, count * Index(part.panel), 1, count) += jump_(mark.contact, forced) * at_end;
    }
  }
}

// The states of each source at the end of the period give the periodic states at its beginning, from which
// the states are propagated once.
Influence PoleResponse::influence(const PeriodCells& period, bool velocity) const {
  const auto& grid = period.grid;
  const auto& cells = period.cells;
  const Index n = period.count(), m = period.marks();
  const std::vector<Rows> rows = rows_of(period, velocity);
  const std::vector<Sources> sources = sources_of(period);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + 2 * m + (velocity ? n : 0), n + m);
  MovingStates states(exponents_.size(), n + m);
  const auto pass = [&](std::size_t cell) {
    const auto next = static_cast<std::size_t>(grid.next(static_cast<int>(cell)));
    states.multiply(cells[cell].decay);
    states.add(sources[next].states, sources[next].numbers);
  };
  Eigen::VectorXcd left = periodic_;
  for (std::size_t j = cells.size(); j-- > 0;) {
    const Sources& source = sources[j + 1 < cells.size() ? j + 1 : 0];
    states.add(source.states, source.numbers, left);
    left.array() *= cells[j].decay.array();
  }
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (!rows[j].numbers.empty())
      all(rows[j].numbers, Eigen::all) = states.seen_by(rows[j].real, rows[j].imag);
    if (j + 1 < cells.size()) pass(j);
  }
  add_within_cells(period, velocity, all);
  return split(all, n, m, velocity);
}

Influence PoleResponse::split(const Eigen::MatrixXd& all, Index n, Index m, bool velocity) {
  Influence result{all.topRows(n + m), {}, all.block(n + m, 0, m, n)};
  if (velocity) result.node_velocity = all.bottomRows(n);
  return result;
}

}  // namespace wavebalance::solvers::detail
