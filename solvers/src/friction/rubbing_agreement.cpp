#include "friction/rubbing_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wavebalance::solvers::detail {
namespace {

// Chebyshev's points of an interval, which come near to its ends.
void append_points(std::vector<double>& times, double begin, double end, int count) {
  for (int j = 0; j < count; ++j)
    times.push_back(begin + 0.5 * (end - begin) * (1.0 - std::cos(std::numbers::pi * (j + 0.5) / count)));
}

// The largest value of a function at ascending places, by the parabola through the largest sample and those
// beside it.
double largest_of(const std::vector<double>& times, const Eigen::VectorXd& values) {
  Index at = 0;
  const double largest = values.maxCoeff(&at);
  if (at == 0 || at + 1 == values.size()) return largest;
  const double h0 = times[std::size_t(at)] - times[std::size_t(at - 1)],
               h1 = times[std::size_t(at + 1)] - times[std::size_t(at)],
               d0 = (values[at] - values[at - 1]) / h0, d1 = (values[at + 1] - values[at]) / h1,
               bend = (d1 - d0) / (h0 + h1), slope = d0 + bend * h0;
  return bend < 0.0 ? largest - 0.25 * slope * slope / bend : largest;
}

class Checker {
 public:
  Checker(const RubbingModel& model, const RubbingIterate& solved, const LegendreNodes& nodes, double allowed)
      : model_(model), solved_(solved), nodes_(nodes.count()), allowed_(allowed) {
    for (const RubbingPhase& phase : solved.layout.phases) {
      begins_.push_back(times_.size());
      append_times(phase);
    }
    begins_.push_back(times_.size());
    motion_ =
        model.poles.motion(solved.forces, nodes, Eigen::VectorXd::Map(times_.data(), Index(times_.size())));
    force_size_ = std::max(1e-300, largest_force());
  }

  RubbingAgreement run() const {
    RubbingAgreement result;
    for (std::size_t i = 0; i < solved_.layout.phases.size(); ++i) {
      const RubbingPhase& phase = solved_.layout.phases[i];
      result.moved.push_back(0.0);
      if (phase.state == RubbingState::open)
        result.agrees &= is_open(i);
      else
        result.agrees &= is_closed(i);
      if (phase.state == RubbingState::slip && contact(i).constants.friction > 0.0) result.agrees &= slips(i);
      if (phase.state == RubbingState::stick && phase.slider >= 0) result.agrees &= sticks(i);
      if (phase.state != RubbingState::stick || phase.slider >= 0) continue;
      const double move = move_of(i);
      result.agrees &= !std::isnan(move);
      result.moved.back() = std::isnan(move) ? 0.0 : move;
      result.largest_move = std::max(result.largest_move, std::abs(result.moved.back()) / force_size_);
    }
    return result;
  }

 private:
  void append_times(const RubbingPhase& phase) {
    constexpr int of_phase = 32, of_period = 512, of_node = 2;
    const double begin = solved_.layout.begin(phase), end = solved_.layout.end(phase);
    append_points(times_, begin, end, std::max(of_phase, static_cast<int>(of_period * (end - begin))));
    if (phase.tangent < 0) return;
    for (const Panel& panel : solved_.forces.panels())
      if (panel.phase == phase.tangent || panel.phase == phase.normal)
        append_points(times_, panel.begin, panel.end, of_node * static_cast<int>(nodes_));
    std::sort(times_.begin() + std::ptrdiff_t(begins_.back()), times_.end());
  }

  double largest_force() const {
    double largest = 0.0;
    for (const RubbingContact& contact : model_.contacts)
      for (Index k = 0; k < motion_.displacement.cols(); ++k)
        largest = std::max(largest, contact.normal_force(motion_.displacement.col(k)) *
                                        std::max(1.0, contact.constants.friction));
    return largest;
  }

  const RubbingContact& contact(std::size_t phase) const {
    return model_.contacts[std::size_t(solved_.layout.phases[phase].contact)];
  }

  // The values of a function of instants, at those of a phase.
  template <class Function>
  Eigen::VectorXd along(std::size_t phase, const Function& function) const {
    Eigen::VectorXd values(Index(begins_[phase + 1] - begins_[phase]));
    for (Index k = 0; k < values.size(); ++k) values[k] = function(Index(begins_[phase]) + k);
    return values;
  }
  Eigen::VectorXd normal(std::size_t phase) const {
    return along(phase, [&](Index k) { return contact(phase).normal_force(motion_.displacement.col(k)); });
  }
  // k_t u_t.
  Eigen::VectorXd stretched(std::size_t phase) const {
    return along(phase, [&](Index k) {
      return contact(phase).constants.tangential_stiffness * motion_.displacement(contact(phase).tangent, k);
    });
  }

  bool is_open(std::size_t phase) const { return normal(phase).maxCoeff() <= allowed_ * force_size_; }
  bool is_closed(std::size_t phase) const { return normal(phase).minCoeff() >= -allowed_ * force_size_; }

  bool sticks(std::size_t phase) const {
    const double held = solved_.sliders[solved_.layout.phases[phase].slider],
                 mu = contact(phase).constants.friction;
    const Eigen::ArrayXd force = stretched(phase).array() - held;
    return (force.abs() - mu * normal(phase).array()).maxCoeff() <= allowed_ * force_size_;
  }

  // By displacements, since velocities of contacts without mass jump.
  bool slips(std::size_t phase) const {
    const double sign = solved_.layout.phases[phase].sign;
    const Eigen::VectorXd slider =
        sign * stretched(phase) - contact(phase).constants.friction * normal(phase);
    double farthest = slider[0];
    return std::all_of(slider.begin(), slider.end(), [&](double now) {
      farthest = std::max(farthest, now);
      return farthest - now <= allowed_ * force_size_;
    });
  }

  // Not a number where the contact cannot stick all the time.
  double move_of(std::size_t phase) const {
    const std::vector<double> times(times_.begin() + std::ptrdiff_t(begins_[phase]),
                                    times_.begin() + std::ptrdiff_t(begins_[phase + 1]));
    const Eigen::VectorXd force = stretched(phase), limit = contact(phase).constants.friction * normal(phase);
    const double least = largest_of(times, force - limit), most = -largest_of(times, -force - limit),
                 held = solved_.layout.phases[phase].held;
    if (least > most + allowed_ * force_size_) return std::numeric_limits<double>::quiet_NaN();
    return held < least ? least - held : std::min(0.0, most - held);
  }

  const RubbingModel& model_;
  const RubbingIterate& solved_;
  Index nodes_;  // of a panel
  double allowed_;
  std::vector<double> times_;  // of all phases, ascending in each
  std::vector<std::size_t> begins_;
  ContactMotion motion_;
  double force_size_;
};

}  // namespace

RubbingAgreement agreement_of(const RubbingModel& model, const RubbingIterate& solved,
                              const LegendreNodes& nodes, double allowed) {
  return Checker(model, solved, nodes, allowed).run();
}

}  // namespace wavebalance::solvers::detail
