#include "flow/closed_period.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "flow/panel.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers::detail {
namespace {

// A period from a state, and how perturbations come out of it, if they were carried along.
struct Period {
  Eigen::VectorXd begin, change;
  std::vector<int> contacts, last_contacts;
  Eigen::MatrixXd map;
  double length;         // s
  Eigen::VectorXd rate;  // of the state at its end
  double distance;

  bool returns() const { return contacts == last_contacts; }
};

// A step of the state and of an unknown period.
struct PeriodStep {
  Eigen::VectorXd state;
  double length = 0.0;
};

// The normal of the plane across the motion, in displacements.
Eigen::VectorXd across_motion(const Eigen::VectorXd& rate, const Eigen::VectorXd& weights) {
  const Eigen::VectorXd moved = weights.cwiseProduct(rate);
  return weights.cwiseProduct(moved) / std::max(moved.norm(), 1e-300);
}

class PeriodNewton {
 public:
  PeriodNewton(ContactFlow& flow, const Observer& observer, Eigen::MatrixXd map, bool free_period)
      : flow_(flow),
        observer_(observer),
        free_period_(free_period),
        weights_(flow.displacements_by_state()),
        map_(std::move(map)) {}

  ClosedPeriod run(int most) {
    auto now = period(flow_.state(), flow_.contact_states(), flow_.period(), map_.size() == 0);
    while (now && !stopped_ && !done(*now) && result_.iterations < most) {
      ++result_.iterations;
      auto next = now->returns() ? newton(*now) : std::nullopt;
      if (!next && !stopped_ && now->returns() && now->distance < small_) {  // no step leads nearer
        result_.found = period(now->begin, now->contacts, now->length, false)
                            .has_value();  // the flow is at this one again
        break;
      }
      if (!next && !stopped_) next = passed(*now);
      now = std::move(next);
    }
    if (!result_.found) return result_;
    result_.state = now->begin;
    result_.contacts = now->contacts;
    result_.period = now->length;
    result_.distance = now->distance;
    result_.map = now->map.size() > 0 ? now->map : map_;
    return result_;
  }

 private:
  std::optional<Period> period(const Eigen::VectorXd& state, const std::vector<int>& contacts, double length,
                               bool with_map) {
    if (free_period_) flow_.set_period(length);
    flow_.start(state, contacts);
    flow_.perturb(with_map ? Eigen::MatrixXd::Identity(state.size(), state.size())
                           : Eigen::MatrixXd(state.size(), 0));
    if (flow_.advance_period() != FlowStatus::converged) return std::nullopt;
    Period result{state,  flow_.state() - state, contacts, flow_.contact_states(), flow_.perturbation(),
                  length, flow_.rate(),          0.0};
    constexpr double least = 1e-7,
                     most = 1e3;  // where contacts hold the structure, and where it rests on them
    double size = std::max(state.cwiseProduct(weights_).norm(), least * flow_.length());
    if (flow_.rests_on_contacts()) size = std::min(size, most * flow_.length());
    result.distance = result.change.cwiseProduct(weights_).norm() / size;
    stopped_ = !goes_on(observer_,
                        {"exact motion", result_.iterations, result.distance, "relative change of a period"});
    return result;
  }

  // As far as rounding lets it.
  bool done(const Period& now) {
    constexpr double rounding = 1e-13;
    if (!now.returns()) return false;
    const bool stalls = now.distance < small_ && now.distance > 0.1 * last_distance_;
    result_.found = now.distance < rounding || stalls;
    last_distance_ = now.distance;
    return result_.found;
  }

  PeriodStep step(const Period& now, const Eigen::MatrixXd& map) const {
    constexpr double singular = 1e-9;
    const std::vector<Index> free = free_states(map);
    if (free_period_) return step_across(now, map, free);
    const Eigen::MatrixXd own = map(free, free),
                          left = Eigen::MatrixXd::Identity(own.rows(), own.cols()) - own;
    const Eigen::VectorXd right = now.change(free);
    const Lu<double> lu(left);
    const bool shortest = lu.is_singular(singular) && moves_freely(own);
    Eigen::VectorXd result = now.change;
    result(free) = shortest ? least_squares(left, right, singular) : Eigen::VectorXd(lu.solve(right));
    return {result};
  }

  // The state and the period at once, which changes by a fifth at most.
  PeriodStep step_across(const Period& now, const Eigen::MatrixXd& map,
                         const std::vector<Index>& free) const {
    constexpr double most = 0.2;
    const Index n = Index(free.size());
    Eigen::MatrixXd left(n + 1, n + 1);
    left.topLeftCorner(n, n) = Eigen::MatrixXd::Identity(n, n) - map(free, free);
    left.topRightCorner(n, 1) = -now.length * now.rate(free);
    left.bottomLeftCorner(1, n) = across_motion(now.rate, weights_)(free).transpose();
    left(n, n) = 0.0;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    right.head(n) = now.change(free);
    const Eigen::VectorXd found = Lu<double>(left).solve(right);
    PeriodStep result{now.change, now.length * found[n]};
    result.state(free) = found.head(n);
    const double part = std::min(1.0, most * now.length / std::abs(result.length));
    return {part * result.state, part * result.length};
  }

  // Whether a body may be elsewhere and still come back; a map of fast growth is nearly singular, too.
  static bool moves_freely(const Eigen::MatrixXd& map) {
    constexpr double rounding = 1e-9;
    return ((eigenvalues(map).array() - 1.0).abs() < rounding).any();
  }

  std::optional<Period> newton(const Period& now) {
    constexpr int halvings = 5;
    constexpr double helps = 0.1;
    if (now.map.size() == 0) {
      const PeriodStep change = step(now, map_);
      auto next = period(now.begin + change.state, now.contacts, now.length + change.length, false);
      if (next && next->returns() && next->distance < helps * now.distance) return next;
      if (stopped_) return std::nullopt;
      map_.resize(0, 0);
      return period(now.begin, now.contacts, now.length, true);
    }
    const PeriodStep change = step(now, now.map);
    double part = 1.0;
    for (int k = 0; k <= halvings && !stopped_; ++k, part *= 0.5) {
      auto next =
          period(now.begin + part * change.state, now.contacts, now.length + part * change.length, true);
      if (next && next->returns() && next->distance < std::max(0.9 * now.distance, 1e-10)) return next;
    }
    return std::nullopt;
  }

  // One period later; that may happen a few times.
  std::optional<Period> passed(const Period& now) {
    constexpr int most = 4;
    if (++passed_ > most) return std::nullopt;
    return period(now.begin + now.change, now.last_contacts, now.length, true);
  }

  ContactFlow& flow_;
  double small_ = std::max(1e-8, 0.1 * flow_.tolerance());  // where errors may keep it from coming nearer
  const Observer& observer_;
  bool free_period_;
  Eigen::VectorXd weights_;
  Eigen::MatrixXd map_;
  ClosedPeriod result_;
  double last_distance_ = 1e300;
  int passed_ = 0;
  bool stopped_ = false;
};

// Positions of contacts that stick all along are parameters: what moves them is no perturbation.
Eigen::MatrixXd without_moving(const Eigen::MatrixXd& held, const Eigen::MatrixXd& map) {
  if (held.rows() == 0) return map;
  const Lu<double> own(product_transposed(held, held));
  if (own.is_singular()) return map;
  return map - product(held.transpose(), own.solve(product(held, map)));
}

// Map of perturbations perpendicular to a motion without load, on a plane with the normal `across`, from
// the map of its period: perturbations along the motion return unchanged. The plane has the other columns
// of the reflection that turns the normal into the first axis.
Eigen::MatrixXd return_map(const Eigen::MatrixXd& map, const Eigen::VectorXd& rate,
                           const Eigen::VectorXd& across) {
  const Index n = map.rows();
  if (n < 2) return Eigen::MatrixXd(0, 0);
  Eigen::VectorXd mirror = across;
  mirror[0] += std::copysign(across.norm(), across[0]);
  const Eigen::MatrixXd plane =
      (Eigen::MatrixXd::Identity(n, n) - 2.0 / mirror.squaredNorm() * mirror * mirror.transpose())
          .rightCols(n - 1);
  const Eigen::MatrixXd moved = product(map, plane);
  const Eigen::RowVectorXd delay = transposed_product(across, moved) / across.dot(rate);
  return transposed_product(plane, moved - rate * delay);
}

}  // namespace

std::vector<Index> free_states(const Eigen::MatrixXd& map) {
  std::vector<Index> kept;
  for (Index i = 0; i < map.rows(); ++i) {
    Eigen::RowVectorXd own = map.row(i);
    own[i] -= 1.0;
    if (!own.isZero(0.0) && !map.row(i).isZero(0.0)) kept.push_back(i);
  }
  return kept;
}

double panel_operations(Index states, int rows, Index perturbations) {
  // States of the poles at the points of a panel, forces, and, if included, their effect on perturbations,
  // by products of large matrices.
  constexpr double least = 2e5, of_waves = 2e3, of_products = 0.2;
  const double forces = double(rows * panel_nodes), columns = std::max(1.0, double(perturbations)),
               products =
                   2.0 / 3.0 * forces * forces * forces + 2.0 * forces * columns * (forces + 2.0 * columns);
  return least + of_waves * double(states) * double(panel_nodes) + of_products * products;
}

double period_operations(const ContactFlow& flow, int rows) {
  return double(flow.panels().size()) *
         panel_operations(flow.state().size(), rows, flow.perturbation().cols());
}

ClosedPeriod close_period(ContactFlow& flow, int most_iterations, const Observer& observer,
                          Eigen::MatrixXd map, bool free_period) {
  return PeriodNewton(flow, observer, std::move(map), free_period).run(most_iterations);
}

Eigen::VectorXcd multipliers_of(const Eigen::MatrixXd& map) {
  const std::vector<Index> free = free_states(map);
  return free.empty() ? Eigen::VectorXcd() : map_multipliers(map(free, free));
}

Eigen::VectorXcd multipliers_of(ContactFlow& flow, const ClosedPeriod& closed, bool free_period) {
  flow.start(closed.state, closed.contacts);
  flow.perturb(Eigen::MatrixXd::Identity(closed.state.size(), closed.state.size()));
  if (flow.advance_period() != FlowStatus::converged) return {};
  const Eigen::MatrixXd map = without_moving(flow.held(), flow.perturbation());
  if (!free_period) return multipliers_of(map);
  const std::vector<Index> free = free_states(map);
  const Eigen::VectorXd rate = flow.rate(), across = across_motion(rate, flow.displacements_by_state());
  return map_multipliers(return_map(map(free, free), rate(free), across(free)));
}

}  // namespace wavebalance::solvers::detail
