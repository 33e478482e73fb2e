#include "stability/stop_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/root.hpp"
#include "stability/smooth_pieces.hpp"

namespace wavebalance::solvers::detail {
namespace {

Waves waves_of(const NearMotion& start, const Eigen::VectorXd& gap) {
  Waves waves{{0.0}, start.contact_free.col(0).real() - gap, 1.0 / start.frequency};
  for (Index n = 1; n < start.contact_free.cols(); ++n) {
    if (start.contact_free.col(n).isZero(0.0)) continue;
    waves.orders.push_back(double(n));
    waves.amplitudes.conservativeResize(Eigen::NoChange, waves.amplitudes.cols() + 1);
    waves.amplitudes.rightCols(1) = start.contact_free.col(n);
  }
  return waves;
}

struct Instant {
  double time;  // periods
  int stop;
};

enum class Order { agrees, changed, lost };

class Search {
 public:
  Search(StopMotions& owner, const NearMotion& start)
      : owner_(owner), start_(start), stops_(owner.stops()), waves_(waves_of(start, stops_.gap)) {
    for (const ContactInterval& interval : start.intervals) {
      if (interval.always()) {
        before_.push_back(interval.contact);
        continue;
      }
      for (const double time : {interval.begin, interval.end})
        instants_.push_back({time - std::floor(time), interval.contact});
    }
    sort();
    if (instants_.empty()) return;
    const double last = 0.5 * (instants_.back().time + instants_.front().time + 1.0);
    for (const ContactInterval& interval : start.intervals)
      if (!interval.always() && lies_in(interval, last)) before_.push_back(interval.contact);
    std::sort(before_.begin(), before_.end());
  }

  std::optional<StopMotion> run() {
    constexpr int most = 12;
    for (int n = 0; n < most; ++n) {
      const std::vector<Instant> kept = instants_;
      if (!newton()) {
        instants_ = kept;
        if (!leave_out_shortest()) return std::nullopt;
        continue;
      }
      const Order order = insert_missed();
      if (order == Order::lost) return std::nullopt;
      if (order == Order::agrees) return result();
    }
    return std::nullopt;
  }

 private:
  void sort() {
    std::sort(instants_.begin(), instants_.end(),
              [](const Instant& a, const Instant& b) { return a.time < b.time; });
  }

  const Forced& forced(const HeldByStops* held) {
    return forced_.try_emplace(held, *held, waves_).first->second;
  }

  // Flights and their states; false where the motion is not determined.
  bool solve() {
    if (!set_flights()) return false;
    const Index states = flights_.front().held->modes.size();
    Eigen::MatrixXd passed = Eigen::MatrixXd::Zero(states, states + 1);
    passed.leftCols(states).setIdentity();
    for (const Flight& flight : flights_) {
      flight.held->advance(flight.seconds(), passed);
      passed.col(states) += flight.pushed();
    }
    map_ = passed.leftCols(states);
    left_.compute(Eigen::MatrixXd::Identity(states, states) - map_);
    Eigen::VectorXd state = left_.solve(Eigen::VectorXd(passed.col(states)));
    for (Flight& flight : flights_) {
      flight.start(state);
      state = flight.state_at(flight.end);
    }
    return state.allFinite();
  }

  bool set_flights() {
    flights_.clear();
    std::vector<int> closed = before_;
    const std::size_t count = instants_.size();
    for (std::size_t i = 0; i < std::max<std::size_t>(1, count); ++i) {
      if (count > 0) toggle(closed, instants_[i].stop);
      const HeldByStops* held = owner_.held(closed);
      if (held == nullptr) return false;
      const double begin = count > 0 ? instants_[i].time : 0.0,
                   end = i + 1 < count ? instants_[i + 1].time : (count > 0 ? instants_[0].time : 0.0) + 1.0;
      flights_.push_back({begin, end, closed, held, &forced(held), &waves_});
    }
    return true;
  }

  static void toggle(std::vector<int>& closed, int stop) {
    const auto at = std::lower_bound(closed.begin(), closed.end(), stop);
    if (at != closed.end() && *at == stop)
      closed.erase(at);
    else
      closed.insert(at, stop);
  }

  Eigen::VectorXd rate(const Flight& flight, const Eigen::VectorXd& state, double time) {
    const HeldByStops& open = *owner_.held({});
    const Eigen::VectorXcd modal = open.modal(state);
    const Eigen::VectorXd force = flight.held->force * state + flight.held->force_direct * waves_.at(time);
    return open.real((open.exponents.array() * modal.array()).matrix()) - owner_.struck() * force;
  }

  // Newton's method on the instants. One that shifts by dt leaves the rates before it longer than those
  // after it, which differ where its stop is not at its gap.
  bool newton() {
    constexpr int most = 25;
    constexpr double largest_step = 0.02, settled = 1e-9;
    for (int n = 0; n < most; ++n) {
      if (!solve()) return false;
      if (instants_.empty()) return true;
      const Eigen::VectorXd step = shift();
      const double largest = step.cwiseAbs().maxCoeff();
      if (!std::isfinite(largest)) return false;
      const double part = std::min(1.0, largest_step / largest);
      for (std::size_t i = 0; i < instants_.size(); ++i) instants_[i].time -= part * step[Index(i)];
      if (!is_in_order()) return false;
      if (largest <= settled) return solve();
    }
    return false;
  }

  bool is_in_order() const {
    constexpr double rounding = 1e-12;
    for (std::size_t i = 0; i + 1 < instants_.size(); ++i)
      if (instants_[i + 1].time < instants_[i].time - rounding) return false;
    return instants_.back().time < instants_.front().time + 1.0 + rounding;
  }

  // How far Newton's method shifts the instants, periods.
  Eigen::VectorXd shift() {
    const auto count = Index(instants_.size());
    Eigen::VectorXd apart(count);
    Eigen::MatrixXd slopes(count, count);
    for (Index i = 0; i < count; ++i) {
      const Flight &here = flights_[std::size_t(i)], &before = flights_[std::size_t((i + count - 1) % count)],
                   &open = open_beside(i);
      const int stop = instants_[std::size_t(i)].stop;
      const Eigen::RowVectorXd outputs = open.held->outputs.row(stop), direct = open.held->direct.row(stop);
      const Eigen::VectorXd jump = rate(before, here.state, here.begin) - rate(here, here.state, here.begin);
      slopes.col(i) = by_jump(i, waves_.period * jump);
      slopes(i, i) += waves_.period *
                      (outputs.dot(rate(open, here.state, here.begin)) + direct.dot(waves_.rate(here.begin)));
      apart[i] = outputs.dot(here.state) + direct.dot(waves_.at(here.begin));
    }
    return Lu<double>(slopes).solve(apart);
  }

  // The flight beside an instant in which its stop is open.
  const Flight& open_beside(Index i) const {
    const Flight& after = flights_[std::size_t(i)];
    const auto count = Index(flights_.size());
    return after.is_closed(instants_[std::size_t(i)].stop) ? flights_[std::size_t((i + count - 1) % count)]
                                                           : after;
  }

  // The distances at all instants by a jump of the state at one of them, once around.
  Eigen::VectorXd by_jump(Index at, const Eigen::VectorXd& jump) {
    const auto count = Index(instants_.size());
    Eigen::MatrixXd state = jump;
    for (Index i = at; i < count; ++i) pass(i, state);
    state = left_.solve(state);
    Eigen::VectorXd result(count);
    for (Index i = 0; i < count; ++i) {
      const Flight& open = open_beside(i);
      const Eigen::VectorXd before = state.col(0);
      if (i == at) state += jump;
      const bool is_after = &open == &flights_[std::size_t(i)];
      result[i] = open.held->outputs.row(instants_[std::size_t(i)].stop)
                      .dot(is_after ? Eigen::VectorXd(state.col(0)) : before);
      pass(i, state);
    }
    return result;
  }

  void pass(Index i, Eigen::MatrixXd& state) const {
    const Flight& flight = flights_[std::size_t(i)];
    flight.held->advance(flight.seconds(), state);
  }

  // Two neighbours of one stop that enclose the shortest flight.
  bool leave_out_shortest() {
    const std::size_t count = instants_.size();
    std::optional<std::size_t> shortest;
    double least = 1.0;
    for (std::size_t i = 0; i < count && count > 1; ++i) {
      const std::size_t next = (i + 1) % count;
      const double length = instants_[next].time - instants_[i].time + (next == 0 ? 1.0 : 0.0);
      if (instants_[i].stop != instants_[next].stop || length >= least) continue;
      least = length;
      shortest = i;
    }
    if (!shortest) return false;
    const std::size_t next = (*shortest + 1) % count;
    if (next == 0) toggle(before_, instants_[0].stop);
    instants_.erase(instants_.begin() + std::ptrdiff_t(std::max(*shortest, next)));
    instants_.erase(instants_.begin() + std::ptrdiff_t(std::min(*shortest, next)));
    return true;
  }

  // Adds the instants at which stops open or close within flights.
  Order insert_missed() {
    std::vector<Instant> missed;
    for (const Flight& flight : flights_)
      if (!look_within(flight, missed)) return Order::lost;
    if (missed.empty()) return Order::agrees;
    instants_.insert(instants_.end(), missed.begin(), missed.end());
    sort();
    return Order::changed;
  }

  // Times of a flight, s after its beginning, the closer to each other the less of it is past.
  std::vector<double> looks(const Flight& flight) const {
    constexpr double per_cycle = 16.0, growth = 0.04;
    constexpr int uniform = 512;
    const double length = flight.seconds(), coarse = length / uniform;
    double fastest = 0.0;
    for (const Flight& one : flights_) fastest = std::max(fastest, one.held->exponents.cwiseAbs().maxCoeff());
    double step = 2.0 * std::numbers::pi / (per_cycle * fastest);
    std::vector<double> times;
    for (double time = std::min(step, coarse); time < length - 0.5 * std::min(step, coarse);
         time += std::min(step, coarse)) {
      times.push_back(time);
      if (step < coarse && growth * time > 2.0 * step) step *= 2.0;
    }
    return times;
  }

  // False where the stops at the ends of the flight are not what they should be.
  bool look_within(const Flight& flight, std::vector<Instant>& missed) const {
    const std::vector<double> times = looks(flight);
    const Index stops = flight.held->direct.rows();
    std::vector<double> last(static_cast<std::size_t>(stops), 0.0);
    std::vector<bool> right(static_cast<std::size_t>(stops), true);
    Eigen::ArrayXcd own = flight.own.array(), factor;
    double step = -1.0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double since = k > 0 ? times[k] - times[k - 1] : times[k];
      if (std::abs(since - step) > 1e-9 * since) factor = (since * flight.held->exponents.array()).exp();
      step = since;
      own *= factor;
      const double time = flight.begin + times[k] / waves_.period;
      for (int stop = 0; stop < int(stops); ++stop) {
        const auto s = std::size_t(stop);
        const double apart = flight.apart(stop, time, own.matrix());
        const bool as_it_should = (apart > 0.0) == flight.is_closed(stop);
        if (as_it_should != right[s]) {
          if (k == 0) return false;
          const auto at = root([&](double t) { return flight.apart(stop, t); },
                               {flight.begin + times[k - 1] / waves_.period, last[s]}, {time, apart}, 1e-12);
          if (!at) return false;
          missed.push_back({*at, stop});
        }
        right[s] = as_it_should;
        last[s] = apart;
      }
    }
    return std::all_of(right.begin(), right.end(), [](bool one) { return one; });
  }

  StopMotion result() const {
    constexpr Index most = 128;  // samples, of which a distance needs no more
    StopMotion motion;
    for (const Instant& one : instants_) motion.instants.push_back(one.time);
    motion.map = map_;
    const Index count = start_.displacement.rows(), stride = std::max<Index>(1, count / most);
    double apart = 0.0, size = 0.0;
    for (Index l = 0; l < count; l += stride) {
      const double first = flights_.front().begin, at = start_.first + double(l) / double(count),
                   time = first + (at - first - std::floor(at - first));
      const auto flight = std::find_if(flights_.begin(), flights_.end() - 1,
                                       [&](const Flight& one) { return time < one.end; });
      for (int stop = 0; stop < int(stops_.gap.size()); ++stop) {
        const double exact = flight->apart(stop, time) + stops_.gap[stop];
        apart += std::pow(exact - start_.displacement(l, stop), 2);
        size += exact * exact;
      }
    }
    motion.distance = std::sqrt(apart / size);
    return motion;
  }

  StopMotions& owner_;
  const NearMotion& start_;
  const LinearStops& stops_;
  Waves waves_;
  std::map<const HeldByStops*, Forced> forced_;
  std::vector<Instant> instants_;
  std::vector<int> before_;  // stops that are closed before the first instant
  std::vector<Flight> flights_;
  Eigen::MatrixXd map_;
  Lu<double> left_;
};

}  // namespace

StopMotions::StopMotions(const ContactDynamics& dynamics, LinearStops stops)
    : dynamics_(dynamics),
      stops_(std::move(stops)),
      struck_(RealStates(exponents_of(dynamics)).real_of(inputs_of(dynamics))) {}

std::optional<StopMotion> StopMotions::near(const NearMotion& start) {
  constexpr std::size_t most_kept = 64;
  if (held_.size() > most_kept) held_.clear();
  return Search(*this, start).run();
}

const HeldByStops* StopMotions::held(const std::vector<int>& closed) {
  auto at = held_.find(closed);
  if (at == held_.end()) at = held_.emplace(closed, held_by_stops(dynamics_, stops_, closed)).first;
  return at->second ? &*at->second : nullptr;
}

}  // namespace wavebalance::solvers::detail
