#include "flow/closed_period.hpp"

#include <algorithm>
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
  double distance;

  bool returns() const { return contacts == last_contacts; }
};

class PeriodNewton {
 public:
  PeriodNewton(ContactFlow& flow, const Observer& observer, Eigen::MatrixXd map)
      : flow_(flow), observer_(observer), weights_(flow.displacements_by_state()), map_(std::move(map)) {}

  ClosedPeriod run(int most) {
    auto now = period(flow_.state(), flow_.contact_states(), map_.size() == 0);
    while (now && !stopped_ && !done(*now) && result_.iterations < most) {
      ++result_.iterations;
      auto next = now->returns() ? newton(*now) : std::nullopt;
      if (!next && !stopped_ && now->returns() && now->distance < small_) {  // no step leads nearer
        result_.found =
            period(now->begin, now->contacts, false).has_value();  // the flow is at this one again
        break;
      }
      if (!next && !stopped_) next = passed(*now);
      now = std::move(next);
    }
    if (!result_.found) return result_;
    result_.state = now->begin;
    result_.contacts = now->contacts;
    result_.distance = now->distance;
    result_.map = now->map.size() > 0 ? now->map : map_;
    return result_;
  }

 private:
  std::optional<Period> period(const Eigen::VectorXd& state, const std::vector<int>& contacts,
                               bool with_map) {
    flow_.start(state, contacts);
    flow_.perturb(with_map ? Eigen::MatrixXd::Identity(state.size(), state.size())
                           : Eigen::MatrixXd(state.size(), 0));
    if (flow_.advance_period() != FlowStatus::converged) return std::nullopt;
    Period result{state, flow_.state() - state, contacts, flow_.contact_states(), flow_.perturbation(), 0.0};
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

  Eigen::VectorXd step(const Period& now, const Eigen::MatrixXd& map) const {
    constexpr double singular = 1e-9;
    const std::vector<Index> free = free_states(map);
    const Eigen::MatrixXd own = map(free, free),
                          left = Eigen::MatrixXd::Identity(own.rows(), own.cols()) - own;
    const Eigen::VectorXd right = now.change(free);
    const Lu<double> lu(left);
    const bool shortest = lu.is_singular(singular) && moves_freely(own);
    Eigen::VectorXd result = now.change;
    result(free) = shortest ? least_squares(left, right, singular) : Eigen::VectorXd(lu.solve(right));
    return result;
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
      auto next = period(now.begin + step(now, map_), now.contacts, false);
      if (next && next->returns() && next->distance < helps * now.distance) return next;
      if (stopped_) return std::nullopt;
      map_.resize(0, 0);
      return period(now.begin, now.contacts, true);
    }
    Eigen::VectorXd change = step(now, now.map);
    for (int k = 0; k <= halvings && !stopped_; ++k, change *= 0.5) {
      auto next = period(now.begin + change, now.contacts, true);
      if (next && next->returns() && next->distance < std::max(0.9 * now.distance, 1e-10)) return next;
    }
    return std::nullopt;
  }

  // One period later; that may happen a few times.
  std::optional<Period> passed(const Period& now) {
    constexpr int most = 4;
    if (++passed_ > most) return std::nullopt;
    return period(now.begin + now.change, now.last_contacts, true);
  }

  ContactFlow& flow_;
  double small_ = std::max(1e-8, 0.1 * flow_.tolerance());  // where errors may keep it from coming nearer
  const Observer& observer_;
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

double period_operations(const ContactFlow& flow, int rows) {
  // What forces make of the poles at the points of a panel, the forces, and what they do to perturbations of
  // all states, where these are carried along, by products of large matrices.
  constexpr double of_waves = 2e3, of_products = 0.2;
  const double forces = double(rows * panel_nodes), states = double(flow.state().size()),
               columns = std::max(1.0, double(flow.perturbation().cols())),
               products =
                   2.0 / 3.0 * forces * forces * forces + 2.0 * forces * columns * (forces + 2.0 * columns);
  return double(flow.panels().size()) *
         (operations_of_panel + of_waves * states * double(panel_nodes) + of_products * products);
}

ClosedPeriod close_period(ContactFlow& flow, int most_iterations, const Observer& observer,
                          Eigen::MatrixXd map) {
  return PeriodNewton(flow, observer, std::move(map)).run(most_iterations);
}

Eigen::VectorXcd multipliers_of(const Eigen::MatrixXd& map) {
  const std::vector<Index> free = free_states(map);
  return free.empty() ? Eigen::VectorXcd() : map_multipliers(map(free, free));
}

Eigen::VectorXcd multipliers_of(ContactFlow& flow, const ClosedPeriod& closed) {
  flow.start(closed.state, closed.contacts);
  flow.perturb(Eigen::MatrixXd::Identity(closed.state.size(), closed.state.size()));
  if (flow.advance_period() != FlowStatus::converged) return {};
  return multipliers_of(without_moving(flow.held(), flow.perturbation()));
}

}  // namespace wavebalance::solvers::detail
