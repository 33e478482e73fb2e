#include "wavebalance/solvers/flow/contact_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "flow/flow_engine.hpp"
#include "linalg/dense.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

using detail::force_kind;

// The level of panels on which the fastest pole of weight turns by a limited angle.
int coarsest_level(const detail::ContactPoles& poles, int panels) {
  constexpr double angle = 10.0;  // rad in half a panel, for 33 even points
  double half = 0.5 * poles.period() / panels;
  int level = 0;
  for (; half * poles.fastest() > angle && level < 20; half *= 0.5) ++level;
  return level;
}

// Size of the linear response about its mean, or a gap.
double moving_length(const ExactProblem& problem) {
  const Eigen::MatrixXcd& free = problem.linear_motion;
  if (free.size() == 0) return std::max(problem.laws.largest_gap(), 1e-300);
  const double whole = free.rowwise().norm().maxCoeff(),
               moving = free.cols() > 1 ? free.rightCols(free.cols() - 1).rowwise().norm().maxCoeff() : 0.0;
  return std::max({moving > 0.0 ? moving : whole, problem.laws.largest_gap(), 1e-300});
}

// Where almost nothing holds a structure it rests on its contacts, and its static deflection without them
// is only rounding.
double length_of(const ExactProblem& problem, const FlowOptions& options) {
  constexpr double rounding = 1e-4;
  if (options.length > 0.0) return options.length;
  const Eigen::MatrixXcd& free = problem.linear_motion;
  const double whole = free.size() == 0 ? 0.0 : free.rowwise().norm().maxCoeff();
  return std::max(moving_length(problem), rounding * whole);
}

}  // namespace

std::string_view to_string(FlowStatus status) {
  using enum FlowStatus;
  return detail::name_in<FlowStatus>({{converged, "converged"},
                                      {step_failure, "step_failure"},
                                      {endless_events, "endless_events"},
                                      {grows, "grows"}},
                                     status);
}

void FlowOptions::validate() const {
  constexpr const char* who = "FlowOptions";
  detail::require_at_least(who, "panels", panels, 1);
  detail::require_at_least(who, "max_panels", max_panels, panels);
  detail::require_positive(who, "tolerance", tolerance);
  if (!(length >= 0.0)) detail::reject(who, "length", length, "0 for none or positive");
}

ContactFlow::Engine::Engine(const ExactProblem& problem, const FlowOptions& options)
    : options_(options),
      poles_(problem.dynamics, problem.linear_motion, problem.frequency),
      machines_(machines_of(problem.laws, problem.dynamics, length_of(problem, options), problem.frequency)),
      contacts_(machines_),
      nodes_(detail::panel_nodes),
      rest_position_(Eigen::VectorXd::Zero(poles_.rows())),
      span_(poles_.period()),
      length_(length_of(problem, options)),
      moving_(options.length > 0.0 ? options.length : moving_length(problem)),
      coarsest_(coarsest_level(poles_, options.panels)),
      cycles_(machines_.size()),
      fastest_(machines_.size(), 0.0) {
  for (const int row : problem.laws.rigid(int(poles_.rows())))
    if (!problem.laws[row].friction()) rest_position_[row] = std::min(0.0, problem.laws[row].gap());
  set_small_force(problem);
  end_force_.setZero(poles_.rows());
  end_memory_rate_.setZero(contacts_.memories());
  start();
}

const detail::PanelShape& ContactFlow::Engine::shape(int level) {
  auto& kept = shapes_[level];
  if (!kept) {
    const double half = std::ldexp(0.5 * poles_.period() / options_.panels, -level);
    kept = std::make_unique<detail::PanelShape>(poles_, nodes_, half, dense_.at);
  }
  return *kept;
}

// The smallest real states of the poles that give the contacts this motion relative to the linear response.
Eigen::VectorXd ContactFlow::Engine::least_states(const Eigen::VectorXd& displacement,
                                                  const Eigen::VectorXd& velocity) const {
  const Index rows = poles_.rows();
  const double rate = 2.0 * std::numbers::pi / poles_.period();
  Eigen::MatrixXd held(2 * rows, poles_.states());
  held << poles_.real_outputs(0), poles_.real_outputs(1) / rate;
  Eigen::VectorXd wanted(2 * rows);
  wanted << displacement, velocity / rate;
  return detail::least_squares(held, wanted);
}

void ContactFlow::Engine::start() {
  const auto free = poles_.linear_motion(Eigen::VectorXd::Zero(1));
  states_ = poles_.complex_of(least_states(rest_position_ - free[0].col(0), -free[1].col(0))).col(0);
  now_.state.clear();
  now_.memory.assign(std::size_t(contacts_.memories()), 0.0);
  for (Index c = 0; c < contacts_.count(); ++c) {
    const LawMachine& law = contacts_.law(c);
    const std::span<const double> at(rest_position_.data() + contacts_.row(c), std::size_t(law.rows()));
    now_.state.push_back(
        law.start(at, std::span<double>(now_.memory)
                          .subspan(std::size_t(contacts_.memory_begin(c)), std::size_t(law.memories()))));
  }
  time_ = 0.0;
  level_ = coarsest_;
}

void ContactFlow::Engine::start(const Eigen::VectorXd& state, const std::vector<int>& contacts) {
  states_ = poles_.complex_of(state.head(poles_.states())).col(0);
  for (Index m = 0; m < contacts_.memories(); ++m) now_.memory[std::size_t(m)] = state[poles_.states() + m];
  now_.state = contacts;
  time_ = 0.0;
  idle_ = 0;
}

void ContactFlow::Engine::start(const Engine& before) {
  const Eigen::VectorXd now = Eigen::VectorXd::Zero(1);
  const auto there = before.poles_.linear_motion(now), here = poles_.linear_motion(now);
  states_ =
      before.states_ +
      poles_.complex_of(least_states(there[0].col(0) - here[0].col(0), there[1].col(0) - here[1].col(0)))
          .col(0);
  now_ = before.now_;
  time_ = 0.0;
  idle_ = 0;
}

void ContactFlow::Engine::start_near(const Eigen::MatrixXcd& harmonics, const Eigen::VectorXd& displacement,
                                     const Eigen::VectorXd& force) {
  const double rate = 2.0 * std::numbers::pi / poles_.period();
  states_.setZero(poles_.poles());
  for (Index n = 0; n < harmonics.cols(); ++n)
    for (Index j = 0; j < states_.size(); ++j)
      for (const double turn : {1.0, -1.0}) {
        std::complex<double> input = 0.0;
        for (Index b = 0; b < harmonics.rows(); ++b)
          input += poles_.inputs()(j, b) * (turn > 0.0 ? harmonics(b, n) : std::conj(harmonics(b, n)));
        states_[j] -=
            0.5 * input / (std::complex<double>(0.0, turn * rate * double(n)) - poles_.exponents()[j]);
      }
  now_.memory.assign(std::size_t(contacts_.memories()), 0.0);
  for (Index c = 0; c < contacts_.count(); ++c) {
    const LawMachine& law = contacts_.law(c);
    const auto rows = std::size_t(law.rows());
    now_.state[std::size_t(c)] =
        law.at({displacement.data() + contacts_.row(c), rows}, {force.data() + contacts_.row(c), rows},
               std::span<double>(now_.memory)
                   .subspan(std::size_t(contacts_.memory_begin(c)), std::size_t(law.memories())));
  }
  time_ = 0.0;
  idle_ = 0;
}

void ContactFlow::Engine::keep(const Solved& panel, double end) {
  constexpr double nothing = 1e-13;  // periods
  const double half = panel.shape->half(), until = std::min(time_ + half * (end + 1.0), until_);
  if (until - time_ < nothing * poles_.period()) return;
  const Eigen::VectorXd within = 0.5 * (end + 1.0) * (nodes_.points.array() + 1.0) - 1.0;
  const Eigen::MatrixXd restriction =
      detail::product(detail::legendre_values(within, detail::panel_nodes), nodes_.coefficients);
  panels_.push_back({time_, until, detail::product_transposed(panel.values.force, restriction), now_.state});
}

void ContactFlow::Engine::take_samples(const Solved& panel, double end, int points,
                                       const std::function<void(const FlowSample&)>& sample) {
  const double step = span_ / points, until = time_ + panel.shape->half() * (end + 1.0);
  std::vector<double> at;
  const auto next = [&] { return (sampled_ + first_sample_) * step; };
  for (; sampled_ < points && next() < until; ++sampled_)
    at.push_back(std::clamp((next() - time_) / panel.shape->half() - 1.0, -1.0, 1.0));
  if (at.empty()) return;
  const Eigen::VectorXd points_here = Eigen::Map<const Eigen::VectorXd>(at.data(), Index(at.size()));
  const detail::PoleWaves waves(poles_, nodes_, panel.shape->half(), points_here);
  detail::Signals signals = motion(*panel.shape).at(waves, panel.values);
  // Without the holding springs' forces, the force of an open contact would be rounding.
  for (std::size_t c = 0; c < machines_.size(); ++c)
    if (machines_[c].law->kind(now_.state[c]) == ContactState::open)
      signals[force_kind].middleRows(machines_[c].row, machines_[c].law->rows()).setZero();
  for (Index k = 0; k < points_here.size(); ++k)
    sample({time_ + panel.shape->half() * (at[std::size_t(k)] + 1.0), signals[0].col(k), signals[1].col(k),
            signals[force_kind].col(k), now_.state});
}

void ContactFlow::Engine::change(const Hit& hit, const detail::Signals& signals,
                                 const Eigen::VectorXcd& before) {
  const Index c = hit.guard.contact;
  const LawMachine& law = contacts_.law(c);
  const int state = now_.state[std::size_t(c)];
  const StateExit exit = law.exits(state)[std::size_t(hit.guard.exit)];
  const detail::LocalValues local(contacts_, c, signals, 0);
  FlowEvent event{.time = time_, .contact = int(c), .from = state};
  std::optional<Dual> impulse;
  detail::Signals after = signals;
  if (exit.impulse) {
    const int row = event.row = int(contacts_.row(c) + exit.impulse->row);
    const Dual& speed = local.signals().velocity[std::size_t(exit.impulse->row)];
    double& fastest = fastest_[std::size_t(c)];
    fastest = std::max(fastest, speed.value);
    const bool rests = exit.impulse->restitution > 0.0 && speed.value < options_.rest_velocity * fastest;
    const double rebound = rests ? 0.0 : exit.impulse->restitution;
    rests_ += rests;
    impulse = (1.0 + rebound) / poles_.inverse_mass()(row, row) * speed;
    event.impulse = impulse->value;
    event.speed = speed.value;
    event.after = -rebound * speed.value;
    event.displacement = signals[0](row, 0);
    const Eigen::VectorXcd left = poles_.inputs().col(row) * impulse->value;
    states_ -= left;
    for (int d = 0; d < detail::levels; ++d) after[std::size_t(d)] -= (poles_.outputs(d) * left).real();
    if (rebound == 0.0) after[1](row, 0) = 0.0;
  }
  int to = exit.targets.front();
  if (exit.targets.size() > 1) {
    const detail::LocalValues behind(contacts_, c, after, 0);
    to = law.choose(state, hit.guard.exit, local.signals(), behind.signals());
  }
  std::vector<Dual> memory;
  if (law.remembers(to)) {
    memory.resize(std::size_t(law.memories()));
    law.remember(state, hit.guard.exit, local.signals(), memory);
  }
  if (!variation_.empty()) {
    const Dual guard = law.guard(state, hit.guard.exit, local.signals());
    const bool forced = guard.value < -left_over * clear_of({c, hit.guard.exit});
    variation_.through(contacts_, poles_, {c, guard, memory, impulse, event.row, forced}, signals, before);
  }
  for (Index m = 0; m < law.memories(); ++m)
    now_.memory[std::size_t(contacts_.memory_begin(c) + m)] =
        memory.empty() ? 0.0 : memory[std::size_t(m)].value;
  now_.state[std::size_t(c)] = event.to = to;
  events_.push_back(event);
  const Sliding sudden = law.sudden(state, hit.guard.exit, local.signals());
  cycles_[std::size_t(c)].slip += sudden.speed;
  cycles_[std::size_t(c)].wear += sudden.wear;
  if (exit.impulse) follow_impulse(c, signals, after, event.speed);
}

void ContactFlow::Engine::follow_impulse(Index struck, const detail::Signals& before,
                                         const detail::Signals& after, double speed) {
  constexpr double rounding = 1e-9;
  for (Index c = 0; c < contacts_.count(); ++c) {
    const Index row = contacts_.row(c), rows = contacts_.law(c).rows();
    const double jump = (after[1] - before[1]).middleRows(row, rows).cwiseAbs().maxCoeff();
    if (c == struck || jump <= rounding * std::abs(speed)) continue;
    const detail::LocalValues local(contacts_, c, after, 0);
    int& state = now_.state[std::size_t(c)];
    const int next = contacts_.law(c).after_impulse(state, local.signals());
    if (next != state) events_.push_back({.time = time_, .contact = int(c), .from = state, .to = next});
    state = next;
  }
}

FlowStatus ContactFlow::Engine::step(int points, const std::function<void(const FlowSample&)>& sample) {
  constexpr int most_idle = 16;
  const auto panel = steps_++ < options_.max_panels ? solve_next() : std::nullopt;
  if (!panel) return FlowStatus::step_failure;
  const double half = panel->shape->half(), until = (until_ - time_) / half - 1.0;
  const detail::Signals dense = motion(*panel->shape).at(panel->shape->waves(), panel->values);
  auto hit = options_.keeps_states ? std::nullopt : first_hit(*panel, dense, until);
  constexpr double rounding = 1e-9;
  if (panel->end && !options_.keeps_states && (!hit || hit->at > 1.0 - rounding)) hit = Hit{1.0, *panel->end};
  const bool ends_state = hit && hit->at < until;
  const double end = ends_state ? hit->at : std::min(1.0, until);
  if (points > 0) take_samples(*panel, end, points, sample);
  keep(*panel, end);
  measure(dense, *panel, end);
  if (options_.margins) keep_margins(end);
  idle_ = end > -1.0 + 1e-12 ? 0 : idle_ + 1;
  if (idle_ > most_idle) return FlowStatus::endless_events;
  const detail::PoleWaves waves(poles_, nodes_, half, Eigen::VectorXd::Constant(1, end));
  const detail::PanelMotion here = motion(*panel->shape);
  const Eigen::VectorXcd next = here.state_at(waves, 0, panel->values.force);
  if (!variation_.empty()) variation_.over(contacts_, now_, here, panel->values, waves, 0);
  const Eigen::VectorXd at_end = waves.forces[0].row(0).transpose();
  end_force_ = panel->values.force * at_end;
  end_memory_rate_ = panel->values.memory_rate * at_end;
  const bool moves = !panel->values.memory_rate.isZero(0.0);
  const detail::Signals signals = ends_state || moves ? here.at(waves, panel->values) : detail::Signals{};
  states_ = next;
  if (moves) now_.memory.assign(signals.memory.data(), signals.memory.data() + signals.memory.size());
  time_ = end == until ? until_ : time_ + half * (end + 1.0);
  if (ends_state) change(*hit, signals, next);
  return FlowStatus::converged;
}

FlowStatus ContactFlow::Engine::advance_period(int points,
                                               const std::function<void(const FlowSample&)>& sample,
                                               double first) {
  first_sample_ = first;
  events_.clear();
  panels_.clear();
  margins_.clear();
  for (std::size_t c = 0; c < machines_.size(); ++c) cycles_[c] = {.row = machines_[c].row};
  rests_ = sampled_ = steps_ = 0;
  unresolved_ = 0.0;
  until_ = span_;
  while (time_ < until_)
    if (const FlowStatus status = step(points, sample); status != FlowStatus::converged) return status;
  time_ = 0.0;
  for (FrictionCycle& cycle : cycles_) {
    const double whole = std::accumulate(cycle.shares.begin(), cycle.shares.end(), 0.0);
    for (double& share : cycle.shares) share /= whole;
  }
  return FlowStatus::converged;
}

FlowStatus ContactFlow::Engine::advance_to(double time) {
  steps_ = 0;
  until_ = time;
  while (time_ < until_)
    if (const FlowStatus status = step(0, {}); status != FlowStatus::converged) return status;
  return FlowStatus::converged;
}

ContactFlow::ContactFlow(const ExactProblem& problem, const FlowOptions& options) {
  options.validate();
  engine_ = std::make_unique<Engine>(problem, options);
}
ContactFlow::~ContactFlow() = default;
ContactFlow::ContactFlow(ContactFlow&&) noexcept = default;
ContactFlow& ContactFlow::operator=(ContactFlow&&) noexcept = default;
void ContactFlow::start() { engine_->start(); }
void ContactFlow::start(const Eigen::VectorXcd& poles) {
  engine_->start();
  engine_->states_ = poles;
}
void ContactFlow::start(const Eigen::VectorXd& state, const std::vector<int>& contacts) {
  engine_->start(state, contacts);
}
void ContactFlow::start(const ContactFlow& before) { engine_->start(*before.engine_); }
void ContactFlow::start_near(const Eigen::MatrixXcd& harmonics, const Eigen::VectorXd& displacement,
                             const Eigen::VectorXd& force) {
  engine_->start_near(harmonics, displacement, force);
}
const std::vector<FlowPanel>& ContactFlow::panels() const { return engine_->panels_; }

FlowStatus ContactFlow::advance_period(int points, const std::function<void(const FlowSample&)>& sample,
                                       double first) {
  constexpr double far = 1e9, without_step = 1e6;
  const FlowStatus status = engine_->advance_period(points, sample, first);
  if (status == FlowStatus::endless_events) return status;
  const double most = status == FlowStatus::converged ? far : without_step;
  const bool grows = displacements_by_state().cwiseProduct(state()).norm() > most * length();
  return grows ? FlowStatus::grows : status;
}
FlowStatus ContactFlow::advance_to(double time) { return engine_->advance_to(time); }
Eigen::VectorXd ContactFlow::off_center() const { return engine_->off_center(); }
Eigen::MatrixXd ContactFlow::held() const { return engine_->held(); }

Eigen::VectorXd ContactFlow::state() const {
  const detail::ContactStates& now = engine_->now_;
  Eigen::VectorXd result(engine_->poles_.states() + Index(now.memory.size()));
  result << engine_->poles_.real_of(engine_->states_),
      Eigen::Map<const Eigen::VectorXd>(now.memory.data(), Index(now.memory.size()));
  return result;
}

Eigen::VectorXd ContactFlow::rate() const {
  const detail::ContactPoles& poles = engine_->poles_;
  Eigen::VectorXd result(poles.states() + engine_->end_memory_rate_.size());
  const Eigen::VectorXcd of_poles = poles.exponents().cwiseProduct(engine_->states_) -
                                    poles.inputs() * engine_->end_force_.cast<std::complex<double>>();
  result << poles.real_of(of_poles), engine_->end_memory_rate_;
  return result;
}

void ContactFlow::set_period(double seconds) {
  detail::require_positive("ContactFlow", "period", seconds);
  engine_->span_ = seconds;
}

const std::vector<int>& ContactFlow::contact_states() const { return engine_->now_.state; }
const std::vector<ContactMachine>& ContactFlow::machines() const { return engine_->machines_; }
const std::vector<FlowEvent>& ContactFlow::events() const { return engine_->events_; }
const std::vector<FrictionCycle>& ContactFlow::cycles() const { return engine_->cycles_; }
int ContactFlow::rests() const { return engine_->rests_; }
double ContactFlow::period() const { return engine_->span_; }
double ContactFlow::tolerance() const { return engine_->options_.tolerance; }
double ContactFlow::unresolved() const { return engine_->unresolved_; }
double ContactFlow::length() const { return engine_->moving_; }
bool ContactFlow::rests_on_contacts() const { return engine_->length_ > engine_->moving_; }

}  // namespace wavebalance::solvers
