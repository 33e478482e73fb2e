#include "phases/pole_response.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linalg/dense.hpp"
#include "phases/pole_response_parts.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// start exp(rate t) at times of which most follow each other by equal steps. O(times).
void decay(Complex rate, const Eigen::Ref<const Eigen::VectorXd>& times, Complex start,
           Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> real,
           Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> imag) {
  constexpr double rounding = 1e-14;
  const double step = times.size() > 1 ? times[1] - times[0] : 0.0;
  const Complex factor = std::exp(rate * step);
  Complex value = 0.0;
  for (Index i = 0; i < times.size(); ++i) {
    const bool follows = i > 0 && std::abs(times[i] - times[i - 1] - step) < rounding;
    value = follows ? Complex(value.real() * factor.real() - value.imag() * factor.imag(),
                              value.real() * factor.imag() + value.imag() * factor.real())
                    : start * std::exp(rate * times[i]);
    real[i] = value.real();
    imag[i] = value.imag();
  }
}

}  // namespace

double CellGrid::length(int cell) const {
  const auto j = static_cast<std::size_t>(cell);
  return cell + 1 == cells() ? boundaries[0] + 1.0 - boundaries[j] : boundaries[j + 1] - boundaries[j];
}

PoleResponse::PoleResponse(const ContactDynamics& dynamics, double period) : constant_(dynamics.constant()) {
  const Index contacts = constant_.rows();
  std::vector<ContactPole> poles = dynamics.poles();
  std::stable_sort(poles.begin(), poles.end(), [](const ContactPole& a, const ContactPole& b) {
    return a.exponent.real() > b.exponent.real();
  });
  const auto count = Index(poles.size());
  exponents_.resize(count);
  shapes_.resize(contacts, count);
  left_.resize(contacts, count);
  for (Index r = 0; r < count; ++r) {
    const ContactPole& pole = poles[static_cast<std::size_t>(r)];
    const double weight = pole.exponent.imag() > 0.0 ? 2.0 : 1.0;
    exponents_[r] = period * pole.exponent;
    shapes_.col(r) = weight * period * pole.residue * pole.shape;
    left_.col(r) = pole.left;
  }
  periodic_ = (1.0 - exponents_.array().exp()).inverse();
  jump_ = (shapes_ * left_.transpose()).real();
  constexpr double rounding = 1e-9;
  const Eigen::MatrixXd size = shapes_.cwiseAbs() * left_.cwiseAbs().transpose();
  jump_ = (jump_.array().abs() > rounding * size.array()).select(jump_, 0.0);
}

Eigen::VectorXcd PoleResponse::weights(int displaced, int forced) const {
  return shapes_.row(displaced).cwiseProduct(left_.row(forced)).transpose();
}

std::vector<PoleResponse::Cell> PoleResponse::cells_of(const CellGrid& grid,
                                                       const LegendreNodes& nodes) const {
  std::vector<Cell> cells(static_cast<std::size_t>(grid.cells()));
  for (std::size_t p = 0; p < grid.panels.size(); ++p)
    cells[static_cast<std::size_t>(grid.panels[p].cell)].panels.push_back(p);
  for (int j = 0; j < grid.cells(); ++j) {
    Cell& cell = cells[static_cast<std::size_t>(j)];
    cell.length = grid.length(j);
    if (cell.panels.empty()) {
      cell.decay = (cell.length * exponents_.array()).exp();
    } else {
      cell.waves.emplace((0.5 * cell.length) * exponents_, nodes);
      cell.decay = cell.waves->decay();
    }
  }
  return cells;
}

// Numbers of the equations: n displacements at nodes, m displacements and m velocities at marks, and n
// velocities at nodes.
std::vector<PoleResponse::Rows> PoleResponse::rows_of(const CellGrid& grid, const std::vector<Cell>& cells,
                                                      Index count, bool velocity) const {
  const auto n = count * Index(grid.panels.size()), m = Index(grid.marks.size()), poles = exponents_.size();
  std::vector<Rows> rows(cells.size());
  std::vector<std::vector<std::size_t>> marks(cells.size());
  for (std::size_t i = 0; i < grid.marks.size(); ++i)
    marks[static_cast<std::size_t>(grid.marks[i].boundary)].push_back(i);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Index of_panels = count * Index(cells[j].panels.size()) * (velocity ? 2 : 1);
    Eigen::MatrixXcd states(of_panels + 2 * Index(marks[j].size()), poles);
    Index row = 0;
    const auto add = [&](const auto& block, Index number) {
      states.middleRows(row, block.rows()) = block;
      row += block.rows();
      for (Index i = 0; i < block.rows(); ++i) rows[j].numbers.push_back(number + i);
    };
    for (const std::size_t p : cells[j].panels) {
      const Eigen::VectorXcd shape = shapes_.row(grid.panels[p].contact).transpose();
      const Eigen::MatrixXcd displacement = cells[j].waves->at_nodes() * shape.asDiagonal();
      add(displacement, count * Index(p));
      if (velocity) add(displacement * exponents_.asDiagonal(), n + 2 * m + count * Index(p));
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

std::vector<PoleResponse::Sources> PoleResponse::sources_of(const CellGrid& grid,
                                                            const std::vector<Cell>& cells,
                                                            const LegendreNodes& nodes) const {
  const Index count = nodes.count(), n = count * Index(grid.panels.size());
  std::vector<Sources> sources(cells.size());
  for (std::size_t j = 0; j < cells.size(); ++j) {
    Index marks = 0;
    const auto begins = static_cast<int>(j);
    for (const CellGrid::Mark& mark : grid.marks) marks += mark.boundary == begins ? 1 : 0;
    const Cell& ending = cells[static_cast<std::size_t>(grid.before(begins))];
    sources[j].states.resize(exponents_.size(), count * Index(ending.panels.size()) + marks);
    Index column = 0;
    for (const std::size_t p : ending.panels) {
      const Eigen::VectorXcd left = 0.5 * ending.length * left_.row(grid.panels[p].contact).transpose();
      sources[j].states.middleCols(column, count) =
          left.asDiagonal() * (ending.waves->at_end() * nodes.coefficients);
      for (Index k = 0; k < count; ++k) sources[j].numbers.push_back(count * Index(p) + k);
      column += count;
    }
    for (std::size_t i = 0; i < grid.marks.size(); ++i) {
      if (grid.marks[i].boundary != begins) continue;
      sources[j].states.col(column++) = left_.row(grid.marks[i].contact).transpose();
      sources[j].numbers.push_back(n + Index(i));
    }
  }
  return sources;
}

// What acts within the cell of an equation: up to each node, and at once.
void PoleResponse::add_within_cells(const CellGrid& grid, const std::vector<Cell>& cells,
                                    const LegendreNodes& nodes, bool velocity, Eigen::MatrixXd& all) const {
  const auto count = nodes.count(), n = count * Index(grid.panels.size()), m = Index(grid.marks.size());
  for (const Cell& cell : cells)
    for (const std::size_t from : cell.panels)
      for (const std::size_t to : cell.panels) {
        const int forced = grid.panels[from].contact, displaced = grid.panels[to].contact;
        const Eigen::VectorXcd weight = (0.5 * cell.length) * weights(displaced, forced);
        auto block = all.block(count * Index(to), count * Index(from), count, count);
        block += product(cell.waves->up_to_nodes(weight), nodes.coefficients);
        block.diagonal().array() += constant_(displaced, forced);
        if (!velocity) continue;
        auto rate = all.block(n + 2 * m + count * Index(to), count * Index(from), count, count);
        rate += product(cell.waves->up_to_nodes(weight.cwiseProduct(exponents_)), nodes.coefficients);
        rate.diagonal().array() += jump_(displaced, forced);
      }
  const Eigen::RowVectorXd at_end = nodes.coefficients.colwise().sum();  // P_k(1) = 1
  for (Index i = 0; i < m; ++i) {
    const CellGrid::Mark& mark = grid.marks[static_cast<std::size_t>(i)];
    if (!mark.acts_before)
      all(n + i, n + i) -= jump_(mark.contact, mark.contact);  // it has acted before only
    for (const std::size_t p : cells[static_cast<std::size_t>(grid.before(mark.boundary))].panels) {
      const int forced = grid.panels[p].contact;
      if (forced == mark.contact && !mark.acts_after) continue;  // its force ends with zero
      all.block(n + i, count * Index(p), 1, count) += constant_(mark.contact, forced) * at_end;
      all.block(n + m + i, count * Index(p), 1, count) += jump_(mark.contact, forced) * at_end;
    }
  }
}

Influence PoleResponse::influence(const CellGrid& grid, const LegendreNodes& nodes, bool velocity) const {
  constexpr double negligible = 1e-18;
  const auto n = nodes.count() * Index(grid.panels.size()), m = Index(grid.marks.size());
  const std::vector<Cell> cells = cells_of(grid, nodes);
  const std::vector<Rows> rows = rows_of(grid, cells, nodes.count(), velocity);
  const std::vector<Sources> sources = sources_of(grid, cells, nodes);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + 2 * m + (velocity ? n : 0), n + m);
  for (std::size_t s = 0; s < cells.size(); ++s) {
    if (sources[s].numbers.empty()) continue;
    Eigen::VectorXcd gone = periodic_;
    Index active = gone.size();
    std::size_t t = s;
    do {
      while (active > 0 && std::norm(gone[active - 1]) < negligible * negligible) --active;
      if (!rows[t].numbers.empty() && active > 0) {
        const Eigen::MatrixXcd states = gone.head(active).asDiagonal() * sources[s].states.topRows(active);
        all(rows[t].numbers, sources[s].numbers) = product(rows[t].real.leftCols(active), states.real()) -
                                                   product(rows[t].imag.leftCols(active), states.imag());
      }
      gone.head(active).array() *= cells[t].decay.head(active).array();
      t = static_cast<std::size_t>(grid.next(static_cast<int>(t)));
    } while (t != s);
  }
  add_within_cells(grid, cells, nodes, velocity, all);
  return split(all, n, m, velocity);
}

Influence PoleResponse::split(const Eigen::MatrixXd& all, Index n, Index m, bool velocity) {
  Influence result{all.topRows(n + m), {}, all.block(n + m, 0, m, n)};
  if (velocity) result.node_velocity = all.bottomRows(n);
  return result;
}

// poles x cells: the periodic states at the boundaries.
Eigen::MatrixXcd PoleResponse::states_at_boundaries(const CellGrid& grid, const std::vector<Cell>& cells,
                                                    const Eigen::MatrixXd& coefficients) const {
  Eigen::MatrixXcd states(exponents_.size(), Index(cells.size()));
  const auto advance = [&](const Eigen::VectorXcd& state, const Cell& cell) {
    Eigen::VectorXcd next = cell.decay.cwiseProduct(state);
    for (const std::size_t p : cell.panels)
      next += (0.5 * cell.length) * left_.row(grid.panels[p].contact)
                                        .transpose()
                                        .cwiseProduct(cell.waves->at_end() * coefficients.col(Index(p)));
    return next;
  };
  Eigen::VectorXcd from_rest = Eigen::VectorXcd::Zero(exponents_.size());
  for (const Cell& cell : cells) from_rest = advance(from_rest, cell);
  if (states.cols() > 0) states.col(0) = periodic_.cwiseProduct(from_rest);
  for (Index j = 1; j < states.cols(); ++j)
    states.col(j) = advance(states.col(j - 1), cells[static_cast<std::size_t>(j - 1)]);
  return states;
}

// The motion within a cell without forces, at times since its begin. So many times at once keep the states
// of all poles in the processor's cache.
ContactMotion PoleResponse::free_flight(const Eigen::VectorXcd& state, const Eigen::VectorXd& since) const {
  constexpr Index at_once = 64;
  const Eigen::MatrixXcd rates = shapes_ * exponents_.asDiagonal();
  const Eigen::MatrixXd shape_real = shapes_.real(), shape_imag = shapes_.imag(), rate_real = rates.real(),
                        rate_imag = rates.imag();
  ContactMotion result{Eigen::MatrixXd(contacts(), since.size()), Eigen::MatrixXd(contacts(), since.size())};
  Eigen::MatrixXd real, imag;
  for (Index begin = 0; begin < since.size(); begin += at_once) {
    const Index count = std::min(at_once, since.size() - begin);
    real.resize(state.size(), count);
    imag.resize(state.size(), count);
    for (Index r = 0; r < state.size(); ++r)
      decay(exponents_[r], since.segment(begin, count), state[r], real.row(r), imag.row(r));
    result.displacement.middleCols(begin, count) = shape_real * real - shape_imag * imag;
    result.velocity.middleCols(begin, count) = rate_real * real - rate_imag * imag;
  }
  return result;
}

// The same within a cell with forces, of which these are the Legendre coefficients. What the slow poles make
// is a polynomial.
ContactMotion PoleResponse::forced_flight(const CellGrid& grid, const Cell& cell,
                                          const Eigen::VectorXcd& state, const Eigen::MatrixXd& coefficients,
                                          const Eigen::VectorXd& since) const {
  const Index count = coefficients.rows();
  const Eigen::VectorXd points = ((2.0 / cell.length) * since.array() - 1.0).min(1.0);
  const Index degree = cell.waves->series_length() + count;
  const Eigen::MatrixXd values = legendre_values(points, degree);
  ContactMotion result{Eigen::MatrixXd::Zero(contacts(), since.size()),
                       Eigen::MatrixXd::Zero(contacts(), since.size())};
  const auto add = [&](Eigen::MatrixXd& motion, int c, const Eigen::VectorXcd& factor,
                       const Eigen::MatrixXd& at_once) {
    const Eigen::VectorXcd shape = shapes_.row(c).transpose().cwiseProduct(factor);
    Eigen::VectorXd series = Eigen::VectorXd::Zero(degree);
    series.head(degree - count) = cell.waves->slow_series(shape.cwiseProduct(state));
    for (const std::size_t p : cell.panels) {
      const int forced = grid.panels[p].contact;
      const Eigen::VectorXcd weight = (0.5 * cell.length) * shape.cwiseProduct(left_.row(forced).transpose());
      const auto force = coefficients.col(Index(p));
      series += convolution(cell.waves->slow_series(weight), count) * force;
      series.head(count) += at_once(c, forced) * force;
    }
    motion.row(c) += (values * series).transpose();
  };
  const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(exponents_.size());
  for (int c = 0; c < contacts(); ++c) {
    add(result.displacement, c, ones, constant_);
    add(result.velocity, c, exponents_, jump_);
  }
  if (cell.waves->fast().empty()) return result;
  ExponentialIntegrals<Complex> integrals(points, count);
  for (const Index r : cell.waves->fast()) {
    integrals.compute(0.5 * cell.length * exponents_[r]);
    Eigen::VectorXcd states = state[r] * integrals.decay();
    for (const std::size_t p : cell.panels)
      states += (0.5 * cell.length * left_(grid.panels[p].contact, r)) *
                (integrals.values() * coefficients.col(Index(p)));
    result.displacement += (shapes_.col(r) * states.transpose()).real();
    result.velocity += (exponents_[r] * shapes_.col(r) * states.transpose()).real();
  }
  return result;
}

ContactMotion PoleResponse::motion(const CellGrid& grid, const Eigen::MatrixXd& coefficients,
                                   const LegendreNodes& nodes, const Eigen::VectorXd& times) const {
  ContactMotion result{Eigen::MatrixXd::Zero(contacts(), times.size()),
                       Eigen::MatrixXd::Zero(contacts(), times.size())};
  if (grid.panels.empty()) return result;
  const std::vector<Cell> cells = cells_of(grid, nodes);
  const Eigen::MatrixXcd states = states_at_boundaries(grid, cells, coefficients);
  std::vector<std::vector<Index>> numbers(cells.size());
  std::vector<std::vector<double>> since(cells.size());
  for (Index l = 0; l < times.size(); ++l) {
    const double first = grid.boundaries.front(), time = times[l] - first - std::floor(times[l] - first);
    const auto above = std::upper_bound(grid.boundaries.begin(), grid.boundaries.end(), first + time);
    const auto j = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, above - grid.boundaries.begin() - 1));
    numbers[j].push_back(l);
    since[j].push_back(first + time - grid.boundaries[j]);
  }
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (numbers[j].empty()) continue;
    const auto own = Eigen::VectorXd::Map(since[j].data(), Index(since[j].size()));
    const ContactMotion part = cells[j].panels.empty()
                                   ? free_flight(states.col(Index(j)), own)
                                   : forced_flight(grid, cells[j], states.col(Index(j)), coefficients, own);
    result.displacement(Eigen::all, numbers[j]) = part.displacement;
    result.velocity(Eigen::all, numbers[j]) = part.velocity;
  }
  return result;
}

}  // namespace wavebalance::solvers::detail
