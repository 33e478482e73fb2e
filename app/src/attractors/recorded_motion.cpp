#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/compose/outputs.hpp"

#include <numbers>
#include <numeric>

#include "attractors/flow_rows.hpp"
#include "wavebalance/solvers/attractors/long_motion.hpp"

namespace wavebalance::app {
namespace {

using solvers::batch_mean, solvers::Estimate, solvers::largest_of_record, solvers::LongMotion;
using solvers::root_of;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

Estimate negative_of(const Estimate& one) { return {-one.value, one.error}; }

/// Values of each period by their names.
using PeriodValues = std::map<std::string, std::vector<double>>;

/// Data of each recorded period.
class PeriodBook {
 public:
  PeriodBook(const Scene& scene, const FlowRows& rows, double frequency)
      : scene_(scene), places_(contacts_of(scene)), contacts_(rows.contacts()), frequency_(frequency) {
    constexpr std::size_t most_spectra = 16;
    constexpr int enough = 256;  // samples of a period for its 20th harmonic
    values_.resize(rows.places().size());
    series_.resize(std::min(most_spectra, values_.size()));
    const int points = scene.analysis.output_points;
    stride_ = points % enough == 0 ? points / enough : 1;
  }

  void add(const solvers::ContactFlow& flow, const solvers::Motion& period) {
    const solvers::Reach reach = solvers::reach_of(flow, period);
    for (std::size_t row = 0; row < values_.size(); ++row) add_row(row, period, reach);
    for (std::size_t row = 0; row < series_.size(); ++row)
      for (Eigen::Index k = 0; k < period.displacement.cols(); k += stride_)
        series_[row].push_back(period.displacement(Eigen::Index(row), k));
    add_impacts(flow);
    add_friction(flow);
  }

  const PeriodValues& of(std::size_t row) const { return values_[row]; }
  const std::vector<std::vector<double>>& series() const { return series_; }

 private:
  void add_row(std::size_t row, const solvers::Motion& period, const solvers::Reach& reach) {
    PeriodValues& values = values_[row];
    const Eigen::RowVectorXd u = period.displacement.row(Eigen::Index(row)),
                             v = period.velocity.row(Eigen::Index(row)),
                             f = period.force.row(Eigen::Index(row));
    const double points = double(u.size());
    values["u"].push_back(u.mean());
    values["uu"].push_back(u.squaredNorm() / points);
    values["vv"].push_back(v.squaredNorm() / points);
    values["top"].push_back(reach.highest[Eigen::Index(row)]);
    values["bottom"].push_back(-reach.lowest[Eigen::Index(row)]);
    if (int(row) >= contacts_) return;
    values["f"].push_back(f.mean());
    values["ff"].push_back(f.squaredNorm() / points);
    values["force"].push_back(f.maxCoeff());
    values["closed"].push_back(double((f.array() != 0.0).count()) / points);
  }

  void add_impacts(const solvers::ContactFlow& flow) {
    struct Struck {
      double count = 0.0, impulse = 0.0, largest = 0.0, speed = 0.0, energy = 0.0;
    };
    std::map<std::size_t, Struck> struck;
    for (const solvers::FlowEvent& event : flow.events()) {
      if (event.impulse == 0.0) continue;
      const auto row = std::size_t(flow.machines()[std::size_t(event.contact)].row);
      Struck& one = struck[row];
      one.count += 1.0;
      one.impulse += event.impulse;
      one.largest = std::max(one.largest, event.impulse);
      one.speed = std::max(one.speed, event.speed);
      one.energy += 0.5 * event.impulse * (event.speed + event.after);
    }
    for (std::size_t row = 0; row < places_.size(); ++row) {
      if (!has_impulses(places_[row])) continue;
      const Struck& one = struck[row];
      PeriodValues& values = values_[row];
      values["f"].back() += one.impulse * frequency_;
      values["impacts"].push_back(one.count);
      values["impulse"].push_back(one.largest);
      values["speed"].push_back(one.speed);
      values["energy"].push_back(one.energy);
    }
  }

  void add_friction(const solvers::ContactFlow& flow) {
    using enum solvers::ContactState;
    for (const solvers::FrictionCycle& cycle : flow.cycles()) {
      if (cycle.row >= contacts_) continue;  // of an output
      const SceneContact& place = places_[std::size_t(cycle.row)];
      if (!has_friction(place.law)) continue;
      PeriodValues& values = values_[std::size_t(cycle.row)];
      values["work"].push_back(cycle.work);
      values["slip"].push_back(cycle.slip);
      values["slipping"].push_back(cycle.share(solvers::ContactState::slip));
      values["sticking"].push_back(cycle.share(stick));
      const double coefficient = contact::number_or(place.values, "wear_coefficient", 0.0);
      if (coefficient > 0.0) values["wear"].push_back(coefficient * cycle.wear);
    }
  }

 public:
  static bool has_impulses(const SceneContact& place) {
    return is_rigid(place.law) && place.values.contains("restitution");
  }

 private:
  const Scene& scene_;
  std::vector<SceneContact> places_;
  int contacts_;
  double frequency_;
  int stride_ = 1;
  std::vector<PeriodValues> values_;
  std::vector<std::vector<double>> series_;
};

/// The measures of one place, in the order of the output.
class PlaceMeasures {
 public:
  PlaceMeasures(const MotionPlace& place, const PeriodValues& values, std::vector<MotionMeasure>& measures)
      : place_(place), values_(values), measures_(measures) {}

  void append(bool impulsive) {
    const std::string& unit = place_.unit;
    const std::vector<double>& u = values_.at("u");
    const double mean = mean_of(u);
    std::vector<double> about_mean = values_.at("uu");
    for (std::size_t k = 0; k < u.size(); ++k) about_mean[k] += mean * (mean - 2.0 * u[k]);
    add("mean", unit, batch_mean(u));
    add("rms", unit, root_of(batch_mean(values_.at("uu"))));
    add("vibration_rms", unit, root_of(batch_mean(about_mean)));
    add("velocity_rms", unit + "/s", root_of(batch_mean(values_.at("vv"))));
    add("max_in_a_period", unit, batch_mean(values_.at("top")));
    add("min_in_a_period", unit, negative_of(batch_mean(values_.at("bottom"))));
    add("max", unit, largest_of_record(values_.at("top")));
    add("min", unit, negative_of(largest_of_record(values_.at("bottom"))));
    mean_if("f", "mean_force", force_unit(unit));
    if (!impulsive) append_force();
    mean_if("closed", "contact_fraction", "");
    append_events();
  }

 private:
  void add(const char* quantity, const std::string& unit, const Estimate& estimate) {
    measures_.push_back({place_.name, quantity, unit, estimate});
  }
  void mean_if(const char* values, const char* quantity, const std::string& unit) {
    if (const auto found = values_.find(values); found != values_.end())
      add(quantity, unit, batch_mean(found->second));
  }
  void append_force() {
    if (!values_.contains("ff")) return;
    const std::string unit = force_unit(place_.unit);
    add("rms_force", unit, root_of(batch_mean(values_.at("ff"))));
    add("max_force_in_a_period", unit, batch_mean(values_.at("force")));
    add("max_force", unit, largest_of_record(values_.at("force")));
  }
  void append_events() {
    mean_if("impacts", "impacts_in_a_period", "");
    mean_if("energy", "impact_energy_in_a_period", "J");
    if (values_.contains("impulse")) {
      add("max_impulse", "N s", largest_of_record(values_.at("impulse")));
      add("max_impact_velocity", "m/s", largest_of_record(values_.at("speed")));
    }
    mean_if("work", "friction_work_in_a_period", "J");
    mean_if("slip", "slip_in_a_period", "m");
    mean_if("wear", "wear_in_a_period", "m3");
    mean_if("sticking", "stick_fraction", "");
    mean_if("slipping", "slip_fraction", "");
  }

  const MotionPlace& place_;
  const PeriodValues& values_;
  std::vector<MotionMeasure>& measures_;
};

/// A perturbation that grows in proportion to the time has the mean growth log(N) / N, too.
MotionKind verdict_on(const RecordedMotion& motion) {
  if (motion.repeats > 0) return MotionKind::periodic;
  const double n = motion.recorded, beside_zero = 2.0 * std::log(n) / n;
  const auto [value, error] = motion.exponent;
  if (!std::isfinite(value)) return MotionKind::not_known;
  if (value > std::max(error, beside_zero)) return MotionKind::chaotic;
  if (value < -std::max(error, beside_zero)) return MotionKind::settling;
  return motion.curve.residual <= largest_curve_residual ? MotionKind::quasi_periodic : MotionKind::not_known;
}

bool same_poles(const solvers::ContactDynamics& a, const solvers::ContactDynamics& b) {
  return std::equal(a.poles().begin(), a.poles().end(), b.poles().begin(), b.poles().end(),
                    [](const solvers::ContactPole& one, const solvers::ContactPole& other) {
                      return one.exponent == other.exponent;
                    });
}

/// Sets the flow where the motion was left, if that is known; returns whether it is.
bool goes_on_from(const Response& response, solvers::ContactFlow& flow) {
  if (!response.flow || response.flow->state.size() != flow.state().size()) return false;
  std::vector<int> states = flow.contact_states();
  std::copy(response.flow->states.begin(), response.flow->states.end(), states.begin());
  flow.start(response.flow->state, states);
  return true;
}

/// The sums over all contacts of their dissipation in a period.
void measure_sums(const PeriodBook& book, RecordedMotion& result) {
  struct Sum {
    const char *values, *quantity, *unit;
  };
  constexpr std::array sums{
      Sum{"impacts", "impacts_in_a_period", ""}, Sum{"energy", "impact_energy_in_a_period", "J"},
      Sum{"work", "friction_work_in_a_period", "J"}, Sum{"wear", "wear_in_a_period", "m3"}};
  for (const Sum& sum : sums) {
    std::vector<double> all;
    for (std::size_t row = 0; row < result.places.size(); ++row) {
      const auto found = book.of(row).find(sum.values);
      if (found == book.of(row).end()) continue;
      all.resize(found->second.size());
      for (std::size_t k = 0; k < all.size(); ++k) all[k] += found->second[k];
    }
    if (!all.empty()) result.measures.push_back({all_contacts, sum.quantity, sum.unit, batch_mean(all)});
  }
}

void measure_places(const Scene& scene, const PeriodBook& book, RecordedMotion& result) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  for (std::size_t row = 0; row < result.places.size(); ++row)
    PlaceMeasures(result.places[row], book.of(row), result.measures)
        .append(row < contacts.size() && PeriodBook::has_impulses(contacts[row]));
  measure_sums(book, result);
}

RecordedMotion recorded_by(solvers::ContactFlow& flow, const FlowRows& rows, const Scene& scene,
                           const solvers::LongMotionOptions& options) {
  constexpr double tolerance = 1e-4;  // of the section, to detect longer periods
  const double frequency = scene.forcing.frequency;
  PeriodBook book(scene, rows, frequency);
  const LongMotion motion = solvers::long_motion(
      flow, options,
      [&](const solvers::ContactFlow& now, const solvers::Motion& period) { book.add(now, period); });
  RecordedMotion result;
  result.transient = options.transient;
  result.recorded = motion.recorded();
  if (result.recorded < options.recorded) return result;
  result.places = rows.places();
  result.displacement = motion.displacement;
  result.velocity = motion.velocity;
  result.repeats = solvers::section_period(motion, result.recorded / 4, tolerance, flow.length(), frequency);
  result.curve = solvers::invariant_curve(solvers::section_points(motion, frequency), largest_curve_residual);
  if (result.curve.harmonics() > 0)
    result.curve.coefficients.rightCols(motion.velocity.rows()) *= 2.0 * std::numbers::pi * frequency;
  result.exponent =
      motion.growth.empty() ? Estimate{solvers::missing, solvers::missing} : batch_mean(motion.growth);
  result.kind = verdict_on(result);
  measure_places(scene, book, result);
  result.spectrum = solvers::power_spectrum(book.series(), result.recorded, frequency);
  if (rows.has_outputs())
    result.leading = rows.contacts();
  else
    motion.displacement.rowwise().squaredNorm().maxCoeff(&result.leading);
  result.correlation = solvers::batch_correlation(book.of(std::size_t(result.leading)).at("uu"));
  return result;
}

}  // namespace

std::string name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::chaotic:
      return "chaotic";
    case MotionKind::quasi_periodic:
      return "quasi_periodic";
    case MotionKind::periodic:
      return "periodic";
    case MotionKind::settling:
      return "settling";
    case MotionKind::not_known:
      break;
  }
  return "not_known";
}

solvers::Estimate RecordedMotion::of(const std::string& place, const std::string& quantity) const {
  for (const MotionMeasure& one : measures)
    if (one.place == place && one.quantity == quantity) return one.estimate;
  return {solvers::missing, solvers::missing};
}

std::optional<RecordedMotion> recorded_motion(const Scene& scene, const StructureModel& model,
                                              const Response& response, const Observer& observer) {
  constexpr int most_transient = 1000;
  const bool wanted = response.moves && response.attractor_periods == 0 && !response.converged &&
                      scene.analysis.recorded_periods > 0 && model.contact_dynamics() != nullptr;
  if (!wanted) return std::nullopt;
  FlowRows rows(scene, model);
  if (rows.dynamics() == nullptr) return std::nullopt;
  solvers::LongMotionOptions options;
  options.recorded = scene.analysis.recorded_periods;
  options.points = scene.analysis.output_points;
  options.growth = true;
  options.observer = observer;
  try {
    solvers::ContactFlow flow(rows.here());
    const bool known =
        same_poles(*rows.dynamics(), *model.contact_dynamics()) && goes_on_from(response, flow);
    options.transient = known ? 0 : std::min(response.iterations, most_transient);
    RecordedMotion motion = recorded_by(flow, rows, scene, options);
    if (motion.places.empty()) return std::nullopt;
    if (known) motion.transient = response.iterations;
    return motion;
  } catch (const std::invalid_argument&) {  // laws that no flow supports
    return std::nullopt;
  }
}

}  // namespace wavebalance::app
