#include "results/recorded_record.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "drawing/diagram_figure.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/summary_parts.hpp"
#include "wavebalance/app/compose/outputs.hpp"

namespace wavebalance::app {
namespace {

void replace(Summary& summary, const Quantity& quantity, SummaryValue value) {
  const auto found = std::find_if(summary.begin(), summary.end(),
                                  [&](const Entry& entry) { return entry.name == quantity.name; });
  if (found != summary.end()) found->value = std::move(value);
}

/// The value in the place of that of the last period, where the record has one, and its error behind it.
void replace_with_error(Record& record, const Quantity& value, const Quantity& error,
                        const solvers::Estimate& known) {
  if (find_entry(record.summary, value.name) == nullptr) return;
  replace(record.summary, value, known.value);
  record.add(error, known.error);
}

void replace_values(Record& record, const RecordedMotion& motion, const std::string& contact) {
  const auto of = [&](const char* quantity) { return motion.of(contact, quantity); };
  const double max = of("max").value, min = of("min").value;
  replace(record.summary, quantities::max_displacement, max);
  replace(record.summary, quantities::min_displacement, min);
  replace(record.summary, quantities::vibration, 0.5 * (max - min));
  replace(record.summary, quantities::max_contact_force, of("max_force").value);
  replace(record.summary, quantities::contact_fraction, of("contact_fraction").value);
  replace(record.summary, quantities::max_impulse, of("max_impulse").value);
  replace(record.summary, quantities::max_impact_velocity, of("max_impact_velocity").value);
  replace_with_error(record, quantities::rms_displacement, quantities::rms_displacement_error, of("rms"));
  replace_with_error(record, quantities::rms_vibration, quantities::rms_vibration_error, of("vibration_rms"));
  record.add(quantities::mean_contact_force, of("mean_force").value);
  record.add(quantities::mean_contact_force_error, of("mean_force").error);
  const auto sum = [&](const char* quantity) { return motion.of(all_contacts, quantity); };
  replace_with_error(record, quantities::friction_work, quantities::friction_work_error,
                     sum("friction_work_in_a_period"));
  replace_with_error(record, quantities::wear, quantities::wear_error, sum("wear_in_a_period"));
  replace_with_error(record, quantities::impacts, quantities::impacts_error, sum("impacts_in_a_period"));
  replace_with_error(record, quantities::impact_energy, quantities::impact_energy_error,
                     sum("impact_energy_in_a_period"));
}

Table statistics_table(const RecordedMotion& motion) {
  Table table({"place", "quantity", "unit", "value", "error"});
  for (const MotionMeasure& one : motion.measures)
    table.append_row(row_of(one.place, one.quantity, one.unit, one.estimate.value, one.estimate.error));
  return table;
}

Table section_table(const RecordedMotion& motion) {
  Table table;
  table.add_column("period", Eigen::VectorXd(Eigen::VectorXd::LinSpaced(
                                 motion.recorded, motion.transient, motion.transient + motion.recorded - 1)));
  for (std::size_t i = 0; i < motion.places.size(); ++i) {
    const std::string name = column_of(motion.places[i].name), &unit = motion.places[i].unit;
    const auto row = Eigen::Index(i);
    table.add_column(name + "_displacement_" + unit,
                     Eigen::VectorXd(motion.displacement.row(row).transpose()));
    table.add_column(name + "_velocity_" + unit + "_per_s",
                     Eigen::VectorXd(motion.velocity.row(row).transpose()));
  }
  return table;
}

Table spectrum_table(const RecordedMotion& motion) {
  Table table;
  table.add_column("frequency_Hz", motion.spectrum.frequency);
  for (Eigen::Index i = 0; i < motion.spectrum.density.rows(); ++i)
    table.add_column(column_of(motion.places[std::size_t(i)].name) + "_density_" +
                         motion.places[std::size_t(i)].unit + "2_per_Hz",
                     Eigen::VectorXd(motion.spectrum.density.row(i).transpose()));
  return table;
}

void warn_of_kind(Record& record, const RecordedMotion& motion) {
  const std::string statistics =
      fmt::format("The statistics are those of the {} periods recorded.", motion.recorded);
  if (motion.kind == MotionKind::settling)
    warn(record,
         "Perturbations of the motion decay, so that it has not settled yet, or repeats after more than {} "
         "periods of the load. {}",
         motion.recorded / 4, statistics);
  if (motion.kind == MotionKind::periodic)
    warn(record, "The motion repeats after {} of the load. {}",
         motion.repeats == 1 ? "one period" : fmt::format("{} periods", motion.repeats), statistics);
  if (motion.kind == MotionKind::not_known)
    warn(record,
         "Whether the motion is aperiodic or has not settled yet is not known: its largest Lyapunov exponent "
         "cannot be told from zero, or was not found. {} More analysis.recorded_periods may tell it.",
         statistics);
  constexpr double independent = 0.45;  // twice the standard deviation with 20 batches
  if (motion.correlation > independent)
    warn(record,
         "Statistics of neighbouring batches of {} periods depend on each other, with a correlation of "
         "{:.2g}: their errors are too small. More analysis.recorded_periods make batches longer.",
         motion.recorded / 20, motion.correlation);
}

void add_files(Record& record, const RecordedMotion& motion) {
  record.section = section_table(motion);
  record.files.push_back({"statistics.csv", csv_text(statistics_table(motion)),
                          "statistics of the recorded periods, with half the width of 95 % confidence "
                          "intervals by 20 batch means"});
  record.files.push_back(
      {"spectrum.csv", csv_text(spectrum_table(motion)),
       fmt::format("one-sided power spectral density by {} half-overlapping segments of {:.0f} periods under "
                   "the window of Hann",
                   motion.spectrum.segments, motion.spectrum.segment_periods)});
  for (Panel& panel : recorded_panels(motion)) record.figure.panels.push_back(std::move(panel));
}

}  // namespace

void append_recorded(Record& record, const RecordedMotion& motion, int contact) {
  if (motion.is_aperiodic()) record.status = quantities::aperiodic;
  replace(record.summary, quantities::status, record.status);
  replace_values(record, motion, motion.places[std::size_t(contact)].name);
  record.add(quantities::motion_kind, name_of(motion.kind));
  record.add(quantities::lyapunov_exponent, motion.exponent.value);
  record.add(quantities::lyapunov_exponent_error, motion.exponent.error);
  if (motion.repeats > 0) record.add(quantities::section_period, motion.repeats);
  record.add(quantities::transient_periods, motion.transient);
  record.add(quantities::recorded_periods, motion.recorded);
  record.add(quantities::batch_correlation, motion.correlation);
  record.add(quantities::statistics, statistics_table(motion));
  warn_of_kind(record, motion);
  add_files(record, motion);
}

}  // namespace wavebalance::app
