#include <algorithm>
#include <cmath>
#include <numeric>

#include "collocation/pole_response_parts.hpp"
#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// start exp(rate t) at times of which most follow each other by equal steps forwards: backwards a state that
// has decayed to nothing does not come back. O(times).
void decay(Complex rate, const Eigen::Ref<const Eigen::VectorXd>& times, Complex start,
           Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> real,
           Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> imag) {
  constexpr double rounding = 1e-14;
  const double step = times.size() > 1 ? times[times.size() - 1] - times[times.size() - 2] : 0.0;
  const Complex factor = std::exp(rate * step);
  Complex value = 0.0;
  for (Index i = 0; i < times.size(); ++i) {
    const bool follows = i > 0 && step > 0.0 && std::abs(times[i] - times[i - 1] - step) < rounding;
    value = follows ? Complex(value.real() * factor.real() - value.imag() * factor.imag(),
                              value.real() * factor.imag() + value.imag() * factor.real())
                    : start * std::exp(rate * times[i]);
    real[i] = value.real();
    imag[i] = value.imag();
  }
}

// The states of one pole after another at points of a cell, from its begin and by a force.
class StatesAtPoints {
 public:
  StatesAtPoints(const Eigen::VectorXd& points, Index count)
      : real_(points, count), complex_(points, count) {}

  Eigen::VectorXcd operator()(Complex z, Complex start, const Eigen::VectorXcd& force) {
    if (z.imag() != 0.0) return of(complex_, z, start, force);
    return of(real_, z.real(), start, force);
  }

 private:
  template <class Scalar>
  static Eigen::VectorXcd of(ExponentialIntegrals<Scalar>& integrals, Scalar z, Complex start,
                             const Eigen::VectorXcd& force) {
    integrals.compute(z);
    return start * integrals.decay().template cast<Complex>() + integrals.values() * force;
  }

  ExponentialIntegrals<double> real_;
  ExponentialIntegrals<Complex> complex_;
};

}  // namespace

// poles x cells: the states at the boundaries, which are periodic or go on from those that are known.
Eigen::MatrixXcd PoleResponse::states_at_boundaries(const PeriodCells& period,
                                                    const Eigen::MatrixXd& coefficients) const {
  const auto& grid = period.grid;
  const auto& cells = period.cells;
  Eigen::MatrixXcd states(exponents_.size(), Index(cells.size()));
  const auto advance = [&](const Eigen::VectorXcd& state, Index j) {
    const Cell& cell = cells[static_cast<std::size_t>(j)];
    Eigen::VectorXcd next = cell.decay.cwiseProduct(state);
    for (const Part& part : cell.parts)
      next +=
          (0.5 * cell.length) *
          left_.row(grid.panels[part.panel].contact)
              .transpose()
              .cwiseProduct(cell.waves->at_end() * (part.restriction * coefficients.col(Index(part.panel))));
    for (const CellGrid::Impulse& one : grid.impulses)
      if (one.boundary == grid.next(static_cast<int>(j)))
        next += one.size * left_.row(one.contact).transpose();
    return next;
  };
  int first = 0;
  Eigen::VectorXcd begin = Eigen::VectorXcd::Zero(exponents_.size());
  if (grid.begin) {
    first = grid.begin->boundary;
    begin = grid.begin->states;
  } else {
    for (Index j = 0; j < states.cols(); ++j) begin = advance(begin, j);
    begin.array() *= periodic_.array();
  }
  if (states.cols() > 0) states.col(first) = begin;
  for (int j = first, left = grid.cells(); left > 1; --left, j = grid.next(j))
    states.col(grid.next(j)) = advance(states.col(j), j);
  return states;
}

// The motion within a cell without forces, at times since its begin. So many times at once keep the states
// of all poles in the processor's cache.
ContactMotion PoleResponse::free_flight(const Eigen::VectorXcd& state, const Eigen::VectorXd& since) const {
  constexpr Index at_once = 64;
  constexpr double nothing = -75.0;  // exponents
  const Eigen::MatrixXcd rates = shapes_ * exponents_.asDiagonal();
  const Eigen::MatrixXd shape_real = shapes_.real(), shape_imag = shapes_.imag(), rate_real = rates.real(),
                        rate_imag = rates.imag();
  ContactMotion result{Eigen::MatrixXd(contacts(), since.size()), Eigen::MatrixXd(contacts(), since.size())};
  Eigen::MatrixXd real, imag;
  for (Index begin = 0; begin < since.size(); begin += at_once) {
    const Index count = std::min(at_once, since.size() - begin);
    const double least = since.segment(begin, count).minCoeff();
    Index left = state.size();  // poles are in the order of their decay
    while (left > 0 && exponents_[left - 1].real() * least < nothing) --left;
    real.resize(left, count);
    imag.resize(left, count);
    for (Index r = 0; r < left; ++r)
      decay(exponents_[r], since.segment(begin, count), state[r], real.row(r), imag.row(r));
    result.displacement.middleCols(begin, count) =
        shape_real.leftCols(left) * real - shape_imag.leftCols(left) * imag;
    result.velocity.middleCols(begin, count) =
        rate_real.leftCols(left) * real - rate_imag.leftCols(left) * imag;
  }
  return result;
}

// The same within a cell with forces, of which these are the Legendre coefficients, at points in [-1, 1].
// The response of slow poles is a polynomial. Velocities only if requested.
ContactMotion PoleResponse::forced_flight(const PeriodCells& period, std::size_t number,
                                          const Eigen::VectorXcd& state, const Eigen::MatrixXd& coefficients,
                                          const Eigen::VectorXd& points, bool velocity,
                                          const WavesAtNodes* known) const {
  constexpr Index few_pairs = 16;
  const CellGrid& grid = period.grid;
  const Cell& cell = period.cells[number];
  const Index count = coefficients.rows();
  Eigen::MatrixXd forces(count, Index(cell.parts.size()));
  for (std::size_t i = 0; i < cell.parts.size(); ++i)
    forces.col(Index(i)) = cell.parts[i].restriction * coefficients.col(Index(cell.parts[i].panel));
  if (Index(cell.parts.size()) * contacts() > few_pairs)
    return by_poles(grid, cell, state, forces, points, velocity);
  const Index degree = cell.waves->series_length() + count;
  std::optional<WavesAtNodes> own;
  const WavesAtNodes& waves = known ? *known : own.emplace(*cell.waves, period.nodes, points);
  const std::vector<Index>& far = cell.waves->far();
  const FarPoles::Series far_series = far_motion(grid, cell, forces);
  const Eigen::VectorXcd far_states = state(far) - far_series.at_begin;
  ContactMotion result{Eigen::MatrixXd::Zero(contacts(), points.size()),
                       Eigen::MatrixXd::Zero(velocity ? contacts() : 0, points.size())};
  const auto add = [&](Eigen::MatrixXd& motion, int c, const Eigen::VectorXcd& factor,
                       const Eigen::MatrixXd& at_once) {
    const Eigen::VectorXcd shape = shapes_.row(c).transpose().cwiseProduct(factor);
    Eigen::VectorXd series = Eigen::VectorXd::Zero(degree);
    series.head(degree - count) = cell.waves->slow_series(shape.cwiseProduct(state));
    for (std::size_t i = 0; i < cell.parts.size(); ++i) {
      const int forced = grid.panels[cell.parts[i].panel].contact;
      const Eigen::VectorXcd weight = (0.5 * cell.length) * shape.cwiseProduct(left_.row(forced).transpose());
      const auto force = forces.col(Index(i));
      series += convolution(cell.waves->slow_series(weight), count) * force;
      series.head(count) += at_once(c, forced) * force;
    }
    if (!far.empty()) {
      const Eigen::VectorXcd seen = shape(far), left = seen.cwiseProduct(far_states);
      series.head(count) +=
          far_series.real.transpose() * seen.real() - far_series.imag.transpose() * seen.imag();
      motion.row(c) += waves.far_decay().times(left).transpose();
    }
    motion.row(c) += (waves.polynomials().leftCols(degree) * series).transpose();
  };
  const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(exponents_.size());
  for (int c = 0; c < contacts(); ++c) {
    add(result.displacement, c, ones, constant_);
    if (velocity) add(result.velocity, c, exponents_, jump_);
  }
  const std::vector<Index>& fast = cell.waves->fast();
  add_poles(
      grid, cell, fast, forces,
      [&](std::size_t i, const Eigen::VectorXcd& force) { return waves.states(i, state[fast[i]], force); },
      result);
  return result;
}

// The polynomials that these forces make of the far poles.
FarPoles::Series PoleResponse::far_motion(const CellGrid& grid, const Cell& cell,
                                          const Eigen::MatrixXd& forces) const {
  const std::vector<Index>& far = cell.waves->far();
  Eigen::MatrixXcd left(Index(far.size()), forces.cols());
  for (std::size_t i = 0; i < cell.parts.size(); ++i)
    left.col(Index(i)) =
        0.5 * cell.length * left_.row(grid.panels[cell.parts[i].panel].contact)(far).transpose();
  return cell.waves->far_poles().solve(left.real() * forces.transpose(), left.imag() * forces.transpose());
}

// With many contacts all poles one by one need far less than a series for each pair of contacts.
ContactMotion PoleResponse::by_poles(const CellGrid& grid, const Cell& cell, const Eigen::VectorXcd& state,
                                     const Eigen::MatrixXd& forces, const Eigen::VectorXd& points,
                                     bool velocity) const {
  ContactMotion result{Eigen::MatrixXd::Zero(contacts(), points.size()),
                       Eigen::MatrixXd::Zero(velocity ? contacts() : 0, points.size())};
  std::vector<Index> all(static_cast<std::size_t>(exponents_.size()));
  std::iota(all.begin(), all.end(), Index(0));
  StatesAtPoints states(points, forces.rows());
  add_poles(
      grid, cell, all, forces,
      [&](std::size_t r, const Eigen::VectorXcd& force) {
        return states(0.5 * cell.length * exponents_[Index(r)], state[Index(r)], force);
      },
      result);
  const Eigen::MatrixXd at_points = legendre_values(points, forces.rows()) * forces;
  for (std::size_t i = 0; i < cell.parts.size(); ++i) {
    const int forced = grid.panels[cell.parts[i].panel].contact;
    result.displacement += constant_.col(forced) * at_points.col(Index(i)).transpose();
    if (velocity) result.velocity += jump_.col(forced) * at_points.col(Index(i)).transpose();
  }
  return result;
}

// Responses of some poles there, one by one: `states` gives the states of one at the points, by its number
// in `poles` and the Legendre coefficients of the force on it.
template <class States>
void PoleResponse::add_poles(const CellGrid& grid, const Cell& cell, const std::vector<Index>& poles,
                             const Eigen::MatrixXd& forces, const States& states,
                             ContactMotion& result) const {
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const Index r = poles[k];
    Eigen::VectorXcd left(cell.parts.size());
    for (std::size_t i = 0; i < cell.parts.size(); ++i)
      left[Index(i)] = 0.5 * cell.length * left_(grid.panels[cell.parts[i].panel].contact, r);
    const Eigen::VectorXcd own = states(k, forces * left);
    result.displacement += (shapes_.col(r) * own.transpose()).real();
    if (result.velocity.size() > 0)
      result.velocity += (exponents_[r] * shapes_.col(r) * own.transpose()).real();
  }
}

ContactMotion PoleResponse::motion(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                                   const Eigen::VectorXd& times) const {
  const auto& [grid, nodes, cells, waves] = period;
  ContactMotion result{Eigen::MatrixXd::Zero(contacts(), times.size()),
                       Eigen::MatrixXd::Zero(contacts(), times.size())};
  if (grid.panels.empty() && grid.impulses.empty()) return result;
  const Eigen::MatrixXcd states = states_at_boundaries(period, coefficients);
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
    const ContactMotion part =
        cells[j].parts.empty() ? free_flight(states.col(Index(j)), own)
                               : forced_flight(period, j, states.col(Index(j)), coefficients,
                                               ((2.0 / cells[j].length) * own.array() - 1.0).min(1.0), true);
    result.displacement(Eigen::all, numbers[j]) = part.displacement;
    result.velocity(Eigen::all, numbers[j]) = part.velocity;
  }
  return result;
}

ForcedMotion PoleResponse::forced_motion(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                                         bool velocity) const {
  const auto& [grid, nodes, cells, waves] = period;
  const Index n = period.count(), m = period.marks();
  ForcedMotion result{Eigen::VectorXd(n + m), Eigen::VectorXd(velocity ? n : 0), Eigen::VectorXd(m)};
  const Eigen::MatrixXcd states = states_at_boundaries(period, coefficients);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (cells[j].parts.empty()) continue;
    const ContactMotion flight =
        forced_flight(period, j, states.col(Index(j)), coefficients,
                      cells[j].points ? *cells[j].points : nodes.points, velocity, &*waves[j]);
    for (const Part& part : cells[j].parts) {
      if (part.count == 0) continue;
      const int contact = grid.panels[part.panel].contact;
      const Index first = nodes.count() * Index(part.panel) + part.first;
      result.displacement.segment(first, part.count) =
          flight.displacement.row(contact).segment(part.row, part.count).transpose();
      if (velocity)
        result.node_velocity.segment(first, part.count) =
            flight.velocity.row(contact).segment(part.row, part.count).transpose();
    }
  }
  set_at_marks(period, coefficients, states, result);
  return result;
}

// By the states there and what acts at once; the contact's own force only where it goes on.
void PoleResponse::set_at_marks(const PeriodCells& period, const Eigen::MatrixXd& coefficients,
                                const Eigen::MatrixXcd& states, ForcedMotion& result) const {
  const CellGrid& grid = period.grid;
  for (Index i = 0; i < period.marks(); ++i) {
    const CellGrid::Mark& mark = grid.marks[static_cast<std::size_t>(i)];
    const Eigen::VectorXcd seen =
        shapes_.row(mark.contact).transpose().cwiseProduct(states.col(mark.boundary));
    double displacement = seen.sum().real(), velocity = seen.cwiseProduct(exponents_).sum().real();
    for (const Part& part : period.cells[static_cast<std::size_t>(grid.before(mark.boundary))].parts) {
      const int forced = grid.panels[part.panel].contact;
      if (forced == mark.contact && !mark.acts_after) continue;
      const double force = (part.restriction * coefficients.col(Index(part.panel))).sum();  // P_k(1) = 1
      displacement += constant_(mark.contact, forced) * force;
      velocity += jump_(mark.contact, forced) * force;
    }
    result.displacement[period.count() + i] = displacement;
    result.mark_velocity[i] = velocity;
  }
}

}  // namespace wavebalance::solvers::detail
