#include "stability/floquet_determinant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/gauss_rule.hpp"
#include "linalg/index.hpp"
#include "stability/smooth_segments.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2.0 * std::numbers::pi;

int gauss_nodes(int harmonics, double length) { return int(std::ceil(1.8 * harmonics * length)) + 7; }
int periodic_nodes(int harmonics) { return 3 * harmonics + 8; }

// The intervals of contact in pieces whose rules resolve the stiffness; nothing where 64 pieces of an
// interval between cuts do not.
std::optional<std::vector<ContactInterval>> resolved_pieces(const PeriodicStiffness& stiffness,
                                                            int harmonics) {
  constexpr int most = 64;
  const std::vector<double> allowed = allowed_errors(stiffness);
  const auto nodes = [harmonics](double length) { return gauss_nodes(harmonics, length); };
  std::vector<ContactInterval> pieces;
  for (const ContactInterval& interval : cut_intervals(stiffness)) {
    if (interval.always() && is_resolved_periodically(stiffness, interval.contact, periodic_nodes(harmonics),
                                                      allowed[std::size_t(interval.contact)])) {
      pieces.push_back(interval);
      continue;
    }
    const Piece whole{interval.begin, interval.end, {interval.contact}, 1};
    const auto halves = resolved_halves(stiffness, whole, nodes, allowed, most);
    if (!halves) return std::nullopt;
    for (const Piece& half : *halves) pieces.push_back({interval.contact, half.begin, half.end});
  }
  return pieces;
}

// Equal weights where contact lasts the whole period, since the integrand is then periodic.
QuadratureRule rule_for(const ContactInterval& interval, int harmonics) {
  if (!interval.always()) return gauss_rule(gauss_nodes(harmonics, interval.length()));
  const int count = periodic_nodes(harmonics);
  return {Eigen::VectorXd::LinSpaced(count, 0.0, 1.0 - 1.0 / count),
          Eigen::VectorXd::Constant(count, 1.0 / count)};
}

}  // namespace

FloquetDeterminant::FloquetDeterminant(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                       double frequency, const Truncation& truncation)
    : dynamics_(dynamics),
      omega_(two_pi * frequency),
      harmonics_(truncation.harmonics),
      at_once_(truncation.at_once) {
  if (at_once_.size() == 0) at_once_ = Eigen::VectorXd::Zero(dynamics.contacts());
  if (const auto pieces = resolved_pieces(stiffness, harmonics_))
    place_nodes(stiffness, *pieces);
  else
    resolved_ = false;
  const Index count = harmonics_ + 2;
  waves_.resize(nodes(), 2 * count);
  for (Index i = 0; i < waves_.rows(); ++i) {
    const Complex turn = std::polar(1.0, two_pi * time_[i]);
    Complex phase = 1.0;
    for (Index n = 0; n < count; ++n, phase *= turn) {
      waves_(i, n) = phase.real();
      waves_(i, count + n) = phase.imag();
    }
  }
}

double quiet_instant(const std::vector<ContactInterval>& intervals) {
  std::vector<std::pair<double, int>> changes{{0.0, 0}, {1.0, 0}};
  int closed = 0;
  for (const ContactInterval& interval : intervals) {
    if (interval.always()) continue;
    if (interval.end > 1.0) ++closed;
    changes.push_back({interval.begin, 1});
    changes.push_back({interval.end - std::floor(interval.end), -1});
  }
  std::sort(changes.begin(), changes.end());
  int fewest = std::numeric_limits<int>::max();
  double longest = 0.0, instant = 0.0;
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
    closed += changes[i].second;
    const double length = changes[i + 1].first - changes[i].first;
    if (length <= 0.0 || closed > fewest || (closed == fewest && length <= longest)) continue;
    fewest = closed;
    longest = length;
    instant = 0.5 * (changes[i].first + changes[i + 1].first);
  }
  return instant;
}

void FloquetDeterminant::place_nodes(const PeriodicStiffness& stiffness,
                                     const std::vector<ContactInterval>& pieces) {
  std::vector<double> times, weights;
  origin_ = quiet_instant(stiffness.intervals);
  for (const ContactInterval& interval : pieces) {
    const QuadratureRule rule = rule_for(interval, harmonics_);
    const auto begin = Index(times.size());
    if (ranges_.empty() || ranges_.back().contact != interval.contact)
      ranges_.push_back({interval.contact, begin, 0});
    ranges_.back().count += rule.points.size();
    const double yielding =
        dynamics_.constant()(interval.contact, interval.contact) + at_once_[interval.contact];
    for (Index i = 0; i < rule.points.size(); ++i) {
      const double time = interval.begin + interval.length() * rule.points[i];
      const double tangent = stiffness.tangent(interval.contact, time);
      times.push_back(time - std::floor(time - origin_));
      contact_.push_back(interval.contact);
      weights.push_back(interval.length() * rule.weights[i] * tangent / (1.0 + yielding * tangent));
    }
  }
  const auto count = Index(times.size());
  time_ = Eigen::Map<const Eigen::VectorXd>(times.data(), count);
  weighted_ = Eigen::Map<const Eigen::VectorXd>(weights.data(), count);
}

// At the harmonics n = -H - 1..H, the first with its weight.
ContactDynamics::Values FloquetDeterminant::weighted_compliance(Complex sigma, double weight,
                                                                bool with_slope) const {
  const Eigen::VectorXd orders = Eigen::VectorXd::LinSpaced(2 * harmonics_ + 2, -harmonics_ - 1, harmonics_);
  ContactDynamics::Values values =
      dynamics_.compliance(sigma.real(), (sigma.imag() + omega_ * orders.array()).matrix(), with_slope);
  values.compliance = decaying(std::move(values.compliance));
  values.compliance.row(0) *= weight;
  if (with_slope) values.slope.row(0) *= weight;
  return values;
}

ContactDynamics::Values FloquetDeterminant::compliance(Complex sigma, bool with_slope) const {
  return weighted_compliance(sigma, 2.0 * sigma.imag() / omega_, with_slope);
}

// Compliances without what is taken at once.
Eigen::MatrixXcd FloquetDeterminant::decaying(Eigen::MatrixXcd compliance) const {
  for (int c = 0; c < dynamics_.contacts(); ++c)
    compliance.col(c * (dynamics_.contacts() + 1)).array() -= at_once_[c];
  return compliance;
}

// sum_n g_n exp(2 pi i n (t_i - t_j)) w_j D(t_j) for each g, as from compliance(). With p_n = g_n + g_-n and
// q_n = i (g_n - g_-n) it is sum_n p_n cos + q_n sin of 2 pi n (t_i - t_j), one real product per contact j.
std::vector<Eigen::MatrixXcd> FloquetDeterminant::kernels(
    const std::vector<const Eigen::MatrixXcd*>& compliances) const {
  const Index size = nodes(), parts = 2 * size;
  const Eigen::MatrixXd waves = waves_.transpose();
  std::vector<Eigen::MatrixXcd> results(compliances.size(), Eigen::MatrixXcd(size, size));
  Eigen::MatrixXd left(waves.rows(), parts * Index(compliances.size()));
  for (const Range& column : ranges_) {
    for (std::size_t k = 0; k < compliances.size(); ++k)
      for (const Range& row : ranges_)
        set_weighted_waves(waves, row, compliances[k]->col(pair(row, column)),
                           left.middleCols(parts * Index(k) + 2 * row.begin, 2 * row.count));
    const Eigen::MatrixXd products =
        detail::transposed_product(left, waves.middleCols(column.begin, column.count));
    for (std::size_t k = 0; k < compliances.size(); ++k)
      for (Index j = 0; j < column.count; ++j) {
        const double* from = &products(parts * Index(k), j);
        Complex* to = &results[k](0, column.begin + j);
        const double weight = weighted_[column.begin + j];
        for (Index i = 0; i < size; ++i) to[i] = {weight * from[2 * i], weight * from[2 * i + 1]};
      }
  }
  return results;
}

// Two columns for each node of `row`, for the real and the imaginary part of what kernels() sums there.
void FloquetDeterminant::set_weighted_waves(const Eigen::MatrixXd& waves, const Range& row,
                                            const Eigen::Ref<const Eigen::VectorXcd>& g,
                                            Eigen::Ref<Eigen::MatrixXd> columns) const {
  const Index count = harmonics_ + 2;
  Eigen::ArrayXcd p(count), q(count);
  p << g[harmonics_ + 1], g.tail(harmonics_) + g.segment(1, harmonics_).reverse(), g[0];
  q << 0.0, Complex(0.0, 1.0) * (g.tail(harmonics_) - g.segment(1, harmonics_).reverse()),
      Complex(0.0, -1.0) * g[0];
  const Eigen::ArrayXd p_re = p.real(), p_im = p.imag(), q_re = q.real(), q_im = q.imag();
  for (Index i = 0; i < row.count; ++i) {
    const auto cosines = waves.col(row.begin + i).array().head(count);
    const auto sines = waves.col(row.begin + i).array().tail(count);
    columns.col(2 * i).array().head(count) = cosines * p_re + sines * q_re;
    columns.col(2 * i).array().tail(count) = sines * p_re - cosines * q_re;
    columns.col(2 * i + 1).array().head(count) = cosines * p_im + sines * q_im;
    columns.col(2 * i + 1).array().tail(count) = sines * p_im - cosines * q_im;
  }
}

FloquetDeterminant::Value FloquetDeterminant::operator()(Complex sigma) {
  if (sigma.imag() < 0.0) {
    const Value mirrored = (*this)(std::conj(sigma));
    return {std::conj(mirrored.log), std::conj(mirrored.derivative)};
  }
  ++evaluations_;
  if (nodes() == 0) return {};
  const ContactDynamics::Values values = compliance(sigma, true);
  auto matrices = kernels({&values.compliance, &values.slope});
  matrices[0].diagonal().array() += 1.0;
  const detail::Lu<Complex> lu(matrices[0]);
  return {lu.log_determinant(), lu.solve(matrices[1]).trace()};
}

Complex FloquetDeterminant::smooth_log(double nu) {
  const double x = 2.0 * nu / omega_;
  const double weight = x * x * x * x * (35.0 - x * (84.0 - x * (70.0 - 20.0 * x)));
  ++evaluations_;
  if (nodes() == 0) return 0.0;
  const Eigen::MatrixXcd compliance = weighted_compliance({0.0, nu}, weight, false).compliance;
  Eigen::MatrixXcd matrix = kernels({&compliance}).front();
  matrix.diagonal().array() += 1.0;
  return detail::Lu<Complex>(matrix).log_determinant();
}

// The harmonics n and -n, or at omega / 2 n and -n - 1, are conjugates of each other: with the order r = n +
// nu / omega their sum is p cos 2 pi r t + q sin 2 pi r t, p = 2 Re g and q = -2 Im g.
Eigen::MatrixXd FloquetDeterminant::real_matrix(double nu) const {
  const Index size = nodes(), count = harmonics_ + 1;
  const Eigen::VectorXd orders = Eigen::VectorXd::LinSpaced(count, 0.0, harmonics_).array() + nu / omega_;
  Eigen::MatrixXcd g = 2.0 * decaying(dynamics_.compliance(0.0, omega_ * orders, false).compliance);
  if (nu == 0.0) g.row(0) = 0.5 * g.row(0).real().cast<Complex>();
  Eigen::MatrixXd waves(2 * count, size), left(2 * count, size), result(size, size);
  for (Index i = 0; i < size; ++i) {
    const Eigen::ArrayXd angles = two_pi * time_[i] * orders.array();
    waves.col(i) << angles.cos(), angles.sin();
  }
  for (const Range& column : ranges_) {
    for (const Range& row : ranges_) {
      const Eigen::ArrayXd p = g.col(pair(row, column)).real(), q = -g.col(pair(row, column)).imag();
      for (Index i = row.begin; i < row.begin + row.count; ++i) {
        const auto cosines = waves.col(i).array().head(count), sines = waves.col(i).array().tail(count);
        left.col(i).array().head(count) = cosines * p + sines * q;
        left.col(i).array().tail(count) = sines * p - cosines * q;
      }
    }
    result.middleCols(column.begin, column.count) =
        detail::transposed_product(left, waves.middleCols(column.begin, column.count)) *
        weighted_.segment(column.begin, column.count).asDiagonal();
  }
  result.diagonal().array() += 1.0;
  return result;
}

FloquetDeterminant::Mode FloquetDeterminant::mode(Complex sigma) const {
  const Index count = 2 * harmonics_ + 1;
  Mode mode{Eigen::MatrixXcd::Zero(dynamics_.contacts(), count), {}};
  mode.force = mode.displacement;
  if (nodes() == 0) return mode;
  const ContactDynamics::Values values = compliance(sigma, false);
  Eigen::MatrixXcd singular = kernels({&values.compliance}).front();
  singular.diagonal().array() += 1.0;
  const detail::Lu<Complex> lu(singular);
  Eigen::VectorXcd vector = Eigen::VectorXcd::Ones(nodes());
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXcd next = lu.solve(vector);
    if (!next.allFinite()) break;
    vector = next / next.norm();
  }
  if (!((singular * vector).norm() < 1e-4 * singular.cwiseAbs().maxCoeff())) return mode;
  const Eigen::MatrixXcd responses = values.compliance.bottomRows(count);
  for (const Range& range : ranges_)
    for (Index j = range.begin; j < range.begin + range.count; ++j)
      for (Index n = 0; n < count; ++n)
        mode.force(range.contact, n) +=
            weighted_[j] * vector[j] * std::polar(1.0, -two_pi * double(n - harmonics_) * time_[j]);
  for (int c = 0; c < dynamics_.contacts(); ++c)
    for (int d = 0; d < dynamics_.contacts(); ++d)
      mode.displacement.row(c) -=
          responses.col(c + dynamics_.contacts() * d).transpose().cwiseProduct(mode.force.row(d)) +
          dynamics_.constant()(c, d) * mode.force.row(d);
  mode.displacement -= at_once_.asDiagonal() * mode.force;
  Index row = 0, column = 0;
  const double largest = mode.displacement.cwiseAbs().maxCoeff(&row, &column);
  if (!(largest > 0.0)) return mode;
  const Complex scale = 1.0 / mode.displacement(row, column);
  mode.displacement *= scale;
  mode.force *= scale;
  return mode;
}

namespace {

// The largest values of each contact over the period.
struct Contacts {
  Eigen::VectorXd stiffness;  // the largest, N/m
  Eigen::VectorXd longest;    // the longest interval, in periods
};

Contacts extremes(const PeriodicStiffness& stiffness, int contacts) {
  Contacts result{Eigen::VectorXd::Zero(contacts), Eigen::VectorXd::Zero(contacts)};
  for (const ContactInterval& interval : cut_intervals(stiffness)) {
    double& longest = result.longest[interval.contact];
    longest = std::max(longest, interval.length());
    double& largest = result.stiffness[interval.contact];
    largest = std::max(largest, largest_slope(stiffness.tangent, interval));
  }
  return result;
}

double median(Eigen::VectorXd values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Effect of the contacts beyond the harmonics H: |G(i n omega) - g| D / (1 + g D), g the compliance at
// once, times the cycles of the neighbouring mass on the contact's stiffness in the longest contact, since
// errors of its frequency add up. The median over H < n <= 2 H leaves out resonances of single harmonics;
// it is reduced to n = H as for a mass, but not where high modes yield like springs.
double omitted(const Contacts& contacts, const Eigen::MatrixXcd& beyond, const Eigen::VectorXd& at_once,
               const Eigen::VectorXd& constant, int harmonics) {
  const Index count = contacts.stiffness.size();
  double worst = 0.0;
  for (Index c = 0; c < count; ++c) {
    const double typical = median((beyond.col(c * (count + 1)).array() - at_once[c]).abs().matrix());
    const double yielding = 1.0 + contacts.stiffness[c] * (constant[c] + at_once[c]);
    const double relative = (at_once.isZero(0.0) ? 2.25 : 1.0) * typical * contacts.stiffness[c] / yielding;
    const double cycles = std::sqrt(relative) * (harmonics + 1) * contacts.longest[c];
    worst = std::max(worst, relative * std::max(1.0, cycles));
  }
  return worst;
}

// The least number of harmonics, `harmonics` or more by steps of a half up to `most`, beyond which contact
// hardly matters, see StabilityOptions::max_omitted. Where high modes yield to contact like springs, the
// compliance beyond H does not decay; its mean there is then taken as a compliance at once. It does not
// replace nearly all of what contact needs: a stiff crack then had multipliers that its motion does not have.
Truncation resolving_truncation(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                double angular_frequency, int harmonics, int most, double max_omitted) {
  constexpr int samples = 9;
  constexpr double most_at_once = 50.0;
  const int count = dynamics.contacts();
  const Contacts contacts = extremes(stiffness, count);
  const Eigen::VectorXd constant = dynamics.constant().diagonal(), none = Eigen::VectorXd::Zero(count);
  for (; harmonics <= most; harmonics += (harmonics + 1) / 2) {
    const Eigen::VectorXd orders = Eigen::VectorXd::LinSpaced(samples, harmonics + 1, 2.0 * harmonics);
    const Eigen::MatrixXcd beyond = dynamics.compliance(0.0, angular_frequency * orders).compliance;
    const double whole = omitted(contacts, beyond, none, constant, harmonics);
    if (whole <= max_omitted) return {harmonics, {}, whole};
    if (whole > most_at_once * max_omitted) continue;
    Eigen::VectorXd at_once(count);
    for (int c = 0; c < count; ++c) at_once[c] = std::max(0.0, median(beyond.col(c * (count + 1)).real()));
    if (omitted(contacts, beyond, at_once, constant, harmonics) <= max_omitted)
      return {harmonics, at_once, whole};
  }
  return {};
}

}  // namespace

std::optional<FloquetDeterminant> resolving_determinant(const ContactDynamics& dynamics,
                                                        const PeriodicStiffness& stiffness, double frequency,
                                                        int harmonics, int most, double max_omitted) {
  const Truncation truncation =
      resolving_truncation(dynamics, stiffness, two_pi * frequency, harmonics, most, max_omitted);
  if (truncation.harmonics == 0) return std::nullopt;
  FloquetDeterminant determinant(dynamics, stiffness, frequency, truncation);
  return determinant.resolved() ? std::optional(std::move(determinant)) : std::nullopt;
}

bool harmonics_resolve(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double frequency,
                       int harmonics, double max_omitted) {
  const Truncation truncation =
      resolving_truncation(dynamics, stiffness, two_pi * frequency, harmonics, harmonics, max_omitted);
  constexpr double most_at_once = 10.0;
  return truncation.harmonics > 0 && truncation.omitted <= most_at_once * max_omitted;
}

StabilityStatus require_stiffness(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness) {
  if (stiffness.status != StabilityStatus::converged) return stiffness.status;
  if (dynamics.structurally_damped()) return StabilityStatus::structural_damping;
  Eigen::MatrixXd coupling = dynamics.constant();
  const double own = coupling.diagonal().cwiseAbs().maxCoeff();
  coupling.diagonal().setZero();
  const bool coupled = coupling.cwiseAbs().maxCoeff() > 1e-9 * own;
  return coupled ? StabilityStatus::coupled_massless : StabilityStatus::converged;
}

bool has_undamped_pole(const ContactDynamics& dynamics, double angular_frequency) {
  constexpr double least = 1e-10;
  return std::ranges::any_of(dynamics.poles(), [&](const ContactPole& pole) {
    return std::abs(pole.exponent.real()) <= least * std::max(std::abs(pole.exponent), angular_frequency);
  });
}

StabilityStatus require_countable(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                  double angular_frequency) {
  if (dynamics.structurally_damped()) return StabilityStatus::structural_damping;
  if (has_undamped_pole(dynamics, angular_frequency)) return StabilityStatus::undamped;
  return require_stiffness(dynamics, stiffness);
}

}  // namespace wavebalance::solvers
