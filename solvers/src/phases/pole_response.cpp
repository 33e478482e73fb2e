#include "phases/pole_response.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

// The time from `begin` to `time` on a circle of length 1, in [0, 1). Rounding below zero is zero.
double time_after(double begin, double time) {
  constexpr double rounding = 1e-13;
  const double after = time - begin - std::floor(time - begin);
  return after > 1.0 - rounding ? 0.0 : after;
}

Eigen::MatrixXd real_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return product(a.real(), b.real()) - product(a.imag(), b.imag());
}

// exp(rate t) at times of which most follow each other by equal steps. O(times).
void decay(Complex rate, const Eigen::VectorXd& times, Eigen::Ref<Eigen::VectorXcd> values) {
  constexpr double rounding = 1e-14;
  const double step = times.size() > 1 ? times[1] - times[0] : 0.0;
  const Complex factor = std::exp(rate * step);
  for (Index i = 0; i < times.size(); ++i) {
    const bool follows = i > 0 && std::abs(times[i] - times[i - 1] - step) < rounding;
    values[i] = follows ? values[i - 1] * factor : std::exp(rate * times[i]);
  }
}

}  // namespace

// The instants within a panel, which its polynomial reaches, and those after it, seen from the panel.
struct PoleResponse::View {
  View(const Panel& panel, const std::vector<Instant>& instants);

  Index within() const { return Index(inside.size()); }

  std::vector<Index> inside, outside;  // numbers of instants
  std::vector<int> inside_contact, outside_contact;
  Eigen::VectorXd since_end;  // outside: periods
  Eigen::VectorXd points;     // inside, then 1: on [-1, 1]
};

PoleResponse::View::View(const Panel& panel, const std::vector<Instant>& instants) {
  constexpr double rounding = 1e-12;
  std::vector<double> reached, ends;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double after = time_after(panel.begin, instants[i].time);
    const bool in = after <= panel.length() * (1.0 + rounding);
    (in ? inside : outside).push_back(Index(i));
    (in ? inside_contact : outside_contact).push_back(instants[i].contact);
    if (in)
      reached.push_back(std::min(1.0, 2.0 * after / panel.length() - 1.0));
    else
      ends.push_back(after - panel.length());
  }
  reached.push_back(1.0);
  points = Eigen::VectorXd::Map(reached.data(), Index(reached.size()));
  since_end = Eigen::VectorXd::Map(ends.data(), Index(ends.size()));
}

// One panel's integrals for all poles, with the sum of what is local and the factors of what decays.
struct PoleResponse::Waves {
  Eigen::MatrixXcd at_end, at_begin;  // poles x q: states at the ends of the panel in the periodic motion
  Eigen::MatrixXcd outer, inner;      // instants x poles: shape times decay
  Eigen::MatrixXcd local, rate;       // inside x q: sums over the poles
};

PoleResponse::PoleResponse(const ContactDynamics& dynamics, double period) : constant_(dynamics.constant()) {
  const Index contacts = constant_.rows();
  const auto poles = Index(dynamics.poles().size());
  exponents_.resize(poles);
  shapes_.resize(contacts, poles);
  left_.resize(contacts, poles);
  for (Index r = 0; r < poles; ++r) {
    const ContactPole& pole = dynamics.poles()[static_cast<std::size_t>(r)];
    const double weight = pole.exponent.imag() > 0.0 ? 2.0 : 1.0;
    exponents_[r] = period * pole.exponent;
    shapes_.col(r) = weight * period * pole.residue * pole.shape;
    left_.col(r) = pole.left;
  }
  jump_ = (shapes_ * left_.transpose()).real();
}

PoleResponse::Waves PoleResponse::waves(const Panel& panel, const View& view, Index count,
                                        bool velocity) const {
  const Index poles = exponents_.size(), within = view.within();
  const double half = 0.5 * panel.length();
  Waves result;
  result.at_end.setZero(poles, count);
  result.at_begin.setZero(poles, count);
  result.outer.setZero(view.since_end.size(), poles);
  result.inner.setZero(within, poles);
  result.local.setZero(within, count);
  if (velocity) result.rate.setZero(within, count);
  ExponentialIntegrals integrals(view.points, count);
  for (Index r = 0; r < poles; ++r) {
    const Complex rate = exponents_[r];
    const Complex source = half * left_(panel.contact, r);
    if (source == 0.0) continue;
    integrals.compute(half * rate);
    const auto own = integrals.values();
    result.at_end.row(r) = (source / (1.0 - std::exp(rate))) * own.row(within);
    result.at_begin.row(r) = std::exp(rate * (1.0 - panel.length())) * result.at_end.row(r);
    decay(rate, view.since_end, result.outer.col(r));
    for (Index i = 0; i < result.outer.rows(); ++i)
      result.outer(i, r) *= shapes_(view.outside_contact[static_cast<std::size_t>(i)], r);
    for (Index i = 0; i < within; ++i) {
      const Complex shape = shapes_(view.inside_contact[static_cast<std::size_t>(i)], r);
      result.inner(i, r) = shape * integrals.decay()[i];
      result.local.row(i) += (shape * source) * own.row(i);
      if (velocity) result.rate.row(i) += (rate * shape * source) * own.row(i);
    }
  }
  return result;
}

Influence PoleResponse::influence(const std::vector<Panel>& panels, const LegendreNodes& nodes,
                                  const std::vector<Instant>& instants, bool velocity) const {
  const Index count = nodes.count(), size = Index(instants.size());
  Influence result;
  result.displacement.resize(size, count * Index(panels.size()));
  if (velocity) result.velocity.resizeLike(result.displacement);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const View view(panels[p], instants);
    const Waves at = waves(panels[p], view, count, velocity);
    const Eigen::MatrixXd values = legendre_values(view.points.head(view.within()), count);
    const auto fill = [&](Eigen::MatrixXd& matrix, const Waves& wave, const Eigen::MatrixXcd& local,
                          const Eigen::MatrixXd& at_once) {
      Eigen::MatrixXd inner = real_product(wave.inner, wave.at_begin) + local.real();
      for (Index i = 0; i < view.within(); ++i)
        inner.row(i) +=
            at_once(view.inside_contact[static_cast<std::size_t>(i)], panels[p].contact) * values.row(i);
      auto columns = matrix.middleCols(Index(p) * count, count);
      columns(view.inside, Eigen::all) = product(inner, nodes.coefficients);
      columns(view.outside, Eigen::all) = product(real_product(wave.outer, wave.at_end), nodes.coefficients);
    };
    fill(result.displacement, at, at.local, constant_);
    if (!velocity) continue;
    Waves rates = at;
    rates.at_end = exponents_.asDiagonal() * at.at_end;
    rates.at_begin = exponents_.asDiagonal() * at.at_begin;
    fill(result.velocity, rates, at.rate, jump_);
  }
  return result;
}

Influence PoleResponse::motion(const std::vector<Panel>& panels, const Eigen::MatrixXd& coefficients,
                               const Eigen::VectorXd& times) const {
  const Index poles = exponents_.size();
  Eigen::MatrixXcd states = Eigen::MatrixXcd::Zero(times.size(), poles);
  Influence result{Eigen::MatrixXd::Zero(contacts(), times.size()),
                   Eigen::MatrixXd::Zero(contacts(), times.size())};
  std::vector<Instant> instants;
  for (const double time : times) instants.push_back({0, time});
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    const Eigen::VectorXd force = coefficients.col(Index(p));
    const View view(panel, instants);
    const Index within = view.within();
    ExponentialIntegrals integrals(view.points, force.size());
    Eigen::VectorXcd outer(view.since_end.size());
    for (Index r = 0; r < poles; ++r) {
      const Complex rate = exponents_[r], source = 0.5 * panel.length() * left_(panel.contact, r);
      integrals.compute(0.5 * panel.length() * rate);
      const Eigen::VectorXcd own = source * (integrals.values() * force);
      const Complex at_end = own[within] / (1.0 - std::exp(rate));
      const Complex at_begin = std::exp(rate * (1.0 - panel.length())) * at_end;
      decay(rate, view.since_end, outer);
      states.col(r)(view.outside) += at_end * outer;
      states.col(r)(view.inside) += own.head(within) + at_begin * integrals.decay().head(within);
    }
    const Eigen::VectorXd values = legendre_values(view.points.head(within), force.size()) * force;
    result.displacement(Eigen::all, view.inside) += constant_.col(panel.contact) * values.transpose();
    result.velocity(Eigen::all, view.inside) += jump_.col(panel.contact) * values.transpose();
  }
  const Eigen::MatrixXcd turned = states.transpose();
  result.displacement += real_product(shapes_, turned);
  result.velocity += real_product(shapes_ * exponents_.asDiagonal(), turned);
  return result;
}

Influence PoleResponse::impulses(const std::vector<Instant>& impulses, const std::vector<Instant>& instants,
                                 bool velocity) const {
  const auto size = Index(instants.size()), count = Index(impulses.size());
  Influence result;
  result.displacement.setZero(size, count);
  if (velocity) result.velocity.setZero(size, count);
  const Eigen::ArrayXcd periodic = 1.0 / (1.0 - exponents_.array().exp());
  for (Index j = 0; j < count; ++j)
    for (Index i = 0; i < size; ++i) {
      const Instant &from = impulses[static_cast<std::size_t>(j)],
                    &to = instants[static_cast<std::size_t>(i)];
      const double after = time_after(from.time, to.time);
      const Eigen::ArrayXcd parts = shapes_.row(to.contact).transpose().array() *
                                    left_.row(from.contact).transpose().array() *
                                    (after * exponents_.array()).exp() * periodic;
      result.displacement(i, j) = parts.real().sum();
      if (velocity) result.velocity(i, j) = (exponents_.array() * parts).real().sum();
    }
  return result;
}

}  // namespace wavebalance::solvers::detail
