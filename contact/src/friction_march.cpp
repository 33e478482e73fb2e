#include "friction_march.hpp"

#include <algorithm>
#include <cmath>

#include "slip_return.hpp"

namespace wavebalance::contact::detail {
namespace {

constexpr Matrix identity{{{1.0, 0.0}, {0.0, 1.0}}};

Pair product(const Matrix& a, const Pair& x) {
  return {a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]};
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return result;
}

// (I - a)^-1, with the part along which a is the identity left at zero.
Matrix closed(const Matrix& a) {
  const Matrix m{{{1.0 - a[0][0], -a[0][1]}, {-a[1][0], 1.0 - a[1][1]}}};
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double size = std::abs(m[0][0]) + std::abs(m[0][1]) + std::abs(m[1][0]) + std::abs(m[1][1]);
  if (std::abs(determinant) > 1e-12 * size * size)
    return {
        {{m[1][1] / determinant, -m[0][1] / determinant}, {-m[1][0] / determinant, m[0][0] / determinant}}};
  const double square = m[0][0] * m[0][0] + m[0][1] * m[0][1] + m[1][0] * m[1][0] + m[1][1] * m[1][1];
  if (!(square > 0.0)) return {};
  return {{{m[0][0] / square, m[1][0] / square}, {m[0][1] / square, m[1][1] / square}}};  // of rank one
}

void slip_of_one(const ReturnStep& step, double trial, bool with_slopes, ReturnResult& result) {
  const double sign = trial < 0.0 ? -1.0 : 1.0;
  result.force[0] = sign * step.last_limit;
  const double rise = step.last_limit - step.first_limit, speed = sign * step.increment[0] - rise;
  const double stick = speed > 0.0 ? (step.first_limit - sign * step.force[0]) / speed : 0.0;
  result.mean_limit = step.first_limit + 0.5 * rise * (1.0 + std::clamp(stick, 0.0, 1.0));
  if (with_slopes) result.by_last_limit[0] = sign;
}

void slip_of_two(const ReturnStep& step, bool with_slopes, ReturnResult& result) {
  if (!with_slopes) {
    const auto end = slip_return<double>(step.force, step.increment, step.first_limit, step.last_limit);
    result.force = end.force;
    result.mean_limit = end.mean_limit;
    return;
  }
  using Duals = std::array<Dual, 2>;
  const auto end =
      slip_return<Dual>(Duals{Dual::variable(step.force[0], 0), Dual::variable(step.force[1], 1)},
                        Duals{Dual::variable(step.increment[0], 2), Dual::variable(step.increment[1], 3)},
                        Dual::variable(step.first_limit, 4), Dual::variable(step.last_limit, 5));
  result.mean_limit = end.mean_limit.value;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& slope = end.force[i].slope;
    result.force[i] = end.force[i].value;
    result.by_force[i] = {slope[0], slope[1]};
    result.by_increment[i] = {slope[2], slope[3]};
    result.by_first_limit[i] = slope[4];
    result.by_last_limit[i] = slope[5];
  }
}

}  // namespace

ReturnResult return_mapping(const ReturnStep& step, int tangents, bool with_slopes) {
  ReturnResult result;
  if (!(step.last_limit > 0.0)) return result;
  const Pair trial{step.force[0] + step.increment[0], step.force[1] + step.increment[1]};
  if (std::hypot(trial[0], trial[1]) <= step.last_limit) {
    result.state = FrictionState::stick;
    result.force = trial;
    result.by_force = result.by_increment = identity;
    return result;
  }
  result.state = FrictionState::slip;
  if (tangents == 1) {
    slip_of_one(step, trial[0], with_slopes, result);
  } else if (std::hypot(step.increment[0], step.increment[1]) > 0.0) {
    slip_of_two(step, with_slopes, result);
  } else {  // the limit falls on a contact at rest: the force shrinks with it
    const double share = step.last_limit / std::hypot(trial[0], trial[1]);
    result.force = {share * trial[0], share * trial[1]};
    result.mean_limit = 0.5 * (step.first_limit + step.last_limit);
    const Pair along{result.force[0] / step.last_limit, result.force[1] / step.last_limit};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        result.by_force[i][j] = share * ((i == j ? 1.0 : 0.0) - along[i] * along[j]);
    result.by_increment = result.by_force;
    result.by_last_limit = along;
  }
  return result;
}

void Memory::turn(const Matrix& by) {
  for (Entry& entry : entries_) entry.slope = product(by, entry.slope);
}

void Memory::add(int displacement, const Pair& slope) {
  const auto found = std::find_if(entries_.rbegin(), entries_.rend(),
                                  [&](const Entry& one) { return one.displacement == displacement; });
  if (found == entries_.rend()) {
    entries_.push_back({displacement, slope});
  } else {
    found->slope[0] += slope[0];
    found->slope[1] += slope[1];
  }
}

void Memory::drop_small() {
  std::erase_if(entries_, [&](const Entry& one) {
    return std::abs(one.slope[0]) <= negligible_ && std::abs(one.slope[1]) <= negligible_;
  });
}

FrictionMarch::FrictionMarch(const CoulombLaw& law, int points, std::span<const double> displacement,
                             bool with_slopes)
    : law_(law),
      points_(points),
      u_(displacement),
      with_slopes_(with_slopes),
      memory_(1e-15 * law.tangential_stiffness()) {
  for (std::size_t j = 0; j < static_cast<std::size_t>(points); ++j)
    raw_.push_back(law.raw_normal_force(law.normal_rows() > 0 ? u_[j] : 0.0));
}

double FrictionMarch::limit_slope(int sample) const {
  return raw(sample) > 0.0 ? law_.friction() * law_.normal_stiffness() : 0.0;
}

Pair FrictionMarch::within_limit(const Pair& force) const {
  const double norm = std::hypot(force[0], force[1]), most = limit(points_ - 1);
  if (norm <= most) return force;
  return {force[0] * most / norm, force[1] * most / norm};
}

void FrictionMarch::begin(const Pair& slider) {
  const int last = points_ - 1;
  Pair trial{};
  for (std::size_t i = 0; i < tangents(); ++i)
    trial[i] = law_.tangential_stiffness() * (along(i, last) - slider[i]);
  force_ = within_limit(trial);
  memory_.clear();
  if (!with_slopes_) return;
  const double norm = std::hypot(trial[0], trial[1]), most = limit(last);
  const double share = norm > most ? most / norm : 1.0;
  for (std::size_t i = 0; i < tangents(); ++i) {
    Pair slope{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double radial = share < 1.0 ? trial[k] * trial[i] / (norm * norm) : 0.0;
      slope[k] = law_.tangential_stiffness() * share * (identity[k][i] - radial);
    }
    memory_.add(tangent_at(i, last), slope);
  }
  if (share < 1.0 && limit_slope(last) > 0.0)
    memory_.add(last, {limit_slope(last) * trial[0] / norm, limit_slope(last) * trial[1] / norm});
  memory_.drop_small();
}

FrictionMarch::Closing FrictionMarch::closing(int sample) const {
  if (law_.normal_rows() == 0) return {};
  const double now = raw(sample), was = raw(before(sample));
  if (!(now > 0.0 && was <= 0.0)) return {};
  const double rise = now - was, stiffness = law_.normal_stiffness();
  return {now / rise, -was / (rise * rise) * stiffness, now / (rise * rise) * stiffness};
}

ReturnStep FrictionMarch::step_to(int sample, const Closing& closing, Pair& travel) const {
  ReturnStep step{force_, {}, limit(before(sample)), limit(sample)};
  for (std::size_t i = 0; i < tangents(); ++i) {
    travel[i] = along(i, sample) - along(i, before(sample));
    step.increment[i] = law_.tangential_stiffness() * closing.share * travel[i];
  }
  return step;
}

void FrictionMarch::follow(int sample, const ReturnResult& result, const Closing& closing,
                           const Pair& travel) {
  if (result.state == FrictionState::open) return memory_.clear();
  memory_.turn(result.by_force);
  const double stiffness = law_.tangential_stiffness();
  const double slope = stiffness * closing.share;
  for (std::size_t i = 0; i < tangents(); ++i) {
    const Pair by{slope * result.by_increment[0][i], slope * result.by_increment[1][i]};
    memory_.add(tangent_at(i, sample), by);
    memory_.add(tangent_at(i, before(sample)), {-by[0], -by[1]});
  }
  if (law_.normal_rows() > 0) {
    const Pair by_share = product(result.by_increment, Pair{stiffness * travel[0], stiffness * travel[1]});
    const double first = limit_slope(before(sample)), last = limit_slope(sample);
    memory_.add(sample, {closing.by_now * by_share[0] + last * result.by_last_limit[0],
                         closing.by_now * by_share[1] + last * result.by_last_limit[1]});
    memory_.add(before(sample), {closing.by_before * by_share[0] + first * result.by_first_limit[0],
                                 closing.by_before * by_share[1] + first * result.by_first_limit[1]});
  }
  memory_.drop_small();
}

// The distance that the slider moves in a step, m, and the mean force meanwhile. In a step that opens the
// force falls to zero until the instant of opening.
std::pair<double, double> FrictionMarch::slip_in(int sample, const ReturnStep& step,
                                                 const ReturnResult& result) const {
  const double stiffness = law_.tangential_stiffness();
  if (result.state == FrictionState::slip)
    return {std::hypot(step.increment[0] - result.force[0] + step.force[0],
                       step.increment[1] - result.force[1] + step.force[1]) /
                stiffness,
            result.mean_limit};
  const double was = raw(before(sample)), now = raw(sample);
  if (result.state == FrictionState::stick || !(was > 0.0)) return {0.0, 0.0};
  const double share = was / (was - now);
  return {std::hypot(share * step.increment[0] + step.force[0], share * step.increment[1] + step.force[1]) /
              stiffness,
          0.5 * std::hypot(step.force[0], step.force[1])};
}

void FrictionMarch::note(int sample, const ReturnStep& step, const ReturnResult& result,
                         FrictionPeriod& record) const {
  record.state.push_back(result.state);
  const auto [slip, limit] = slip_in(sample, step, result);
  record.slip.push_back(slip);
  record.work += limit * slip;
  if (law_.friction() > 0.0) record.normal_work += limit / law_.friction() * slip;
  for (std::size_t i = 0; i < tangents(); ++i)
    record.force[static_cast<std::size_t>(tangent_at(i, sample))] = result.force[i];
  for (const Memory::Entry& entry : memory_.entries())
    for (std::size_t i = 0; i < tangents(); ++i)
      if (const double slope = entry.slope[i]; slope != 0.0)
        record.slopes.push_back({tangent_at(i, sample), entry.displacement, slope});
  if (law_.normal_rows() == 0) return;
  record.force[static_cast<std::size_t>(sample)] = std::max(0.0, raw(sample));
  if (with_slopes_ && raw(sample) > 0.0) record.slopes.push_back({sample, sample, law_.normal_stiffness()});
}

void FrictionMarch::period(FrictionPeriod* record) {
  carried_ = identity;
  stuck_ = true;
  if (record) record->force.assign(static_cast<std::size_t>(law_.rows() * points_), 0.0);
  for (int sample = 0; sample < points_; ++sample) {
    const Closing closing = this->closing(sample);
    Pair travel{};
    const ReturnStep step = step_to(sample, closing, travel);
    const ReturnResult result = return_mapping(step, law_.tangents(), with_slopes_ || law_.tangents() == 2);
    stuck_ = stuck_ && result.state == FrictionState::stick;
    carried_ = product(result.by_force, carried_);
    if (with_slopes_) follow(sample, result, closing, travel);
    force_ = result.force;
    if (record) note(sample, step, result, *record);
  }
}

Pair FrictionMarch::closed_change(const Pair& defect) const { return product(closed(carried_), defect); }

void FrictionMarch::close_memory() { memory_.turn(closed(carried_)); }

}  // namespace wavebalance::contact::detail
