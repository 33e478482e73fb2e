#pragma once
#include <map>
#include <memory>
#include <optional>

#include "flow/panel_equations.hpp"
#include "flow/variation.hpp"
#include "linalg/root.hpp"
#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers {

/// Data of ContactFlow.
class ContactFlow::Engine {
 public:
  Engine(const ExactProblem& problem, const FlowOptions& options);

  void start();
  void start(const Eigen::VectorXd& state, const std::vector<int>& contacts);
  void start(const Engine& before);
  void start_near(const Eigen::MatrixXcd& harmonics, const Eigen::VectorXd& displacement,
                  const Eigen::VectorXd& force);
  FlowStatus advance_period(int points, const std::function<void(const FlowSample&)>& sample, double first);
  FlowStatus advance_to(double time);
  Eigen::VectorXd off_center() const;
  Eigen::MatrixXd held() const;

 private:
  friend class ContactFlow;
  /// An exit of a contact's state.
  struct Guard {
    Index contact;
    int exit;
  };
  /// Where a guard vanishes on a panel.
  struct Hit {
    double at;  ///< -1..1
    Guard guard;
  };
  /// How far an event may leave a guard below zero by rounding, in multiples of `clear`.
  static constexpr double left_over = 1e4;
  /// A guard and its rate by x.
  struct GuardValue {
    double value, rate;
  };
  /// Points of a panel at which guards are looked at: Chebyshev's with their barycentric weights, and some
  /// with none.
  struct DensePoints {
    DensePoints();
    double interpolated(const std::vector<double>& values, double x) const;
    Eigen::VectorXd at, weight;
  };
  /// A panel whose values are known.
  struct Solved {
    const detail::PanelShape* shape;
    detail::NodeValues values;
    std::optional<Guard> end = {};                       ///< that vanishes at its end
    std::shared_ptr<const detail::PanelShape> own = {};  ///< where its length is
  };
  enum class Fit { fits, too_long, no_digits };

  /// A guard and its rate by x at the dense points; below `clear` its values are rounding.
  struct GuardSamples {
    std::vector<double> value, rate;
    double clear = 0.0, by_memory = 0.0;
  };

  detail::PanelMotion motion(const detail::PanelShape& shape) const {
    return {poles_, shape, time_, states_, now_.memory, factor_};
  }
  void set_small_force(const ExactProblem& problem);
  const detail::PanelShape& shape(int level);
  /// Whether memories change at once with the forces, and the rate at which others decay, 1/s.
  struct Moving {
    bool turn = false;
    double settling_rate = 0.0;
  };
  Moving moving() const;
  Fit fit_of(const detail::PanelShape& panel, const detail::SolvedPanel& found) const;
  std::optional<Solved> solve_next();
  detail::NodeValues no_values() const {
    return {Eigen::MatrixXd::Zero(poles_.rows(), nodes_.count()),
            Eigen::MatrixXd::Zero(contacts_.memories(), nodes_.count())};
  }
  std::optional<Solved> solve_to_end(const Solved& too_long);
  std::optional<Solved> solve_to_end_of(const Guard& guard, double length);
  FlowStatus step(int points, const std::function<void(const FlowSample&)>& sample);
  /// `dense`: signals at the nodes, the end and the dense points of a panel.
  std::optional<Hit> first_hit(const Solved& panel, const detail::Signals& dense, double until);
  /// `local`: of the guard's contact.
  GuardSamples sample_guard(const Solved& panel, const detail::Signals& dense, detail::LocalValues& local,
                            const Guard& guard);
  std::optional<double> root_of(const Solved& panel, const Guard& guard, const GuardSamples& samples,
                                detail::Sample a, detail::Sample b) const;
  std::optional<double> touch(const Solved& panel, const Guard& guard, const GuardSamples& samples,
                              std::size_t k) const;
  std::optional<double> hit_of(const Solved& panel, const detail::Signals& dense, detail::LocalValues& local,
                               const Guard& guard, double until);
  void measure(const detail::Signals& dense, const Solved& panel, double end);
  double scale_of(const Dual& guard, int rows) const;
  double clear_of(const Guard& guard) const;
  bool changed(Index c) const;  // its state, in the last period
  GuardValue guard_at(const Solved& panel, const Guard& guard, double at) const;
  void keep(const Solved& panel, double end);
  void keep_margins(double end);
  void take_samples(const Solved& panel, double end, int points,
                    const std::function<void(const FlowSample&)>& sample);
  void follow_impulse(Index struck, const detail::Signals& before, const detail::Signals& after,
                      double speed);
  void change(const Hit& hit, const detail::Signals& signals, const Eigen::VectorXcd& before);

  Eigen::VectorXd least_states(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const;

  FlowOptions options_;
  detail::ContactPoles poles_;
  std::vector<ContactMachine> machines_;
  detail::Contacts contacts_;
  detail::LegendreNodes nodes_;
  DensePoints dense_;
  Eigen::VectorXd rest_position_;
  mutable detail::KeptFactor factor_;  // of the last panel
  std::map<int, std::unique_ptr<detail::PanelShape>> shapes_;

  double span_ = 0.0;  // s, of the period
  double length_ = 0.0, moving_ = 0.0, time_ = 0.0, until_ = 0.0, first_sample_ = 0.0, force_size_ = 0.0,
         small_force_ = 0.0, unresolved_ = 0.0;
  /// The least value of a guard in the last period, and its slope by the memory.
  struct Margin {
    double least, by_memory;
  };
  std::map<std::pair<Index, int>, GuardSamples> at_rest_;  // of the present panel, where sliders rest
  std::map<std::pair<Index, int>, Margin>
      margins_;  // by contact and exit, while it does not change its state
  int level_ = 0, coarsest_ = 0, idle_ = 0, rests_ = 0, sampled_ = 0, steps_ = 0;
  Eigen::VectorXcd states_;
  // At the end of the last panel: its forces without the holding springs, and rates of memories.
  Eigen::VectorXd end_force_, end_memory_rate_;
  detail::ContactStates now_;
  detail::Variation variation_;
  std::vector<FlowEvent> events_;
  std::vector<FlowPanel> panels_;
  std::vector<FrictionCycle> cycles_;             // of the contacts, in the last period
  std::vector<double> fastest_;                   // impact of each contact, m/s
  std::map<std::pair<Index, int>, double> size_;  // of guards, by contact and state with exit
};

}  // namespace wavebalance::solvers
