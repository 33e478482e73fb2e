#include "results/record_parts.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

void replace(Summary& summary, const Quantity& quantity, SummaryValue value) {
  if (Entry* found = find_entry(summary, quantity.name)) found->value = std::move(value);
}

/// Replaces the value of the last period, if the record has one, and appends its error.
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
      fmt::format("The statistics are taken over the {} recorded periods.", motion.recorded);
  if (motion.kind == MotionKind::settling)
    warn(record,
         "Perturbations decay: the transient has not decayed yet, or the motion repeats after "
         "more than {} forcing periods. {}",
         motion.recorded / 4, statistics);
  if (motion.kind == MotionKind::periodic)
    warn(record, "The motion repeats after {} of the load. {}",
         motion.repeats == 1 ? "one period" : fmt::format("{} periods", motion.repeats), statistics);
  if (motion.kind == MotionKind::not_known)
    warn(record,
         "Whether the motion is aperiodic or still transient is not known: its Lyapunov exponent "
         "is zero within its error or unknown, and its section is not a closed curve. {} More "
         "analysis.recorded_periods may decide it.",
         statistics);
  constexpr double independent = 0.45;  // twice the standard deviation with 20 batches
  if (motion.correlation > independent)
    warn(record,
         "Neighbouring batches of {} periods are correlated ({}): the stated errors are too "
         "small. More analysis.recorded_periods make batches longer.",
         motion.recorded / 20, short_number(motion.correlation, 2));
}

/// "1.680 ± 0.004 mm": the error with two digits, and the value with as many decimals.
std::string with_error(const solvers::Estimate& known, const std::string& unit) {
  const Scale scale = axis_scale(std::abs(known.value));
  const double shown = scale.factor * known.error;
  const int decimals = shown > 0.0 ? std::clamp(1 - int(std::floor(std::log10(shown))), 0, 6) : 6;
  return fmt::format("{:.{}f} ± {:.{}f} {}{}", scale.factor * known.value, decimals, shown, decimals,
                     scale.prefix, unit);
}

std::string kind_sentence(const RecordedMotion& motion, double frequency) {
  const std::string before =
      fmt::format("The motion did not repeat within {} forcing periods. ", motion.transient);
  const std::string measured =
      std::isfinite(motion.exponent.value)
          ? fmt::format("the largest Lyapunov exponent is {} ± {} per forcing period",
                        short_number(motion.exponent.value, 3), short_number(motion.exponent.error, 2))
          : std::string("the largest Lyapunov exponent was not found");
  switch (motion.kind) {
    case MotionKind::chaotic:
      return before + "It is chaotic: " + measured + ".";
    case MotionKind::quasi_periodic:
      return before + fmt::format(
                          "It is quasi-periodic with a second frequency of {} (plus multiples of the forcing "
                          "frequency). Its section is a closed curve within {} of its size. As expected, {}, "
                          "zero within its error.",
                          quantity(motion.curve.rotation * frequency, "Hz"),
                          percentage(motion.curve.residual, 1), measured);
    case MotionKind::periodic:
      return before + fmt::format("In the recorded part it repeats after {} of them.", motion.repeats);
    case MotionKind::settling:
      return before + "Perturbations decay, so it is still transient or has a long period: " + measured + ".";
    case MotionKind::not_known:
      break;
  }
  return before + "Whether it is aperiodic or still transient is not known: " + measured + ".";
}

/// Results of the contact with the largest force and of the summary, limited to the quantities of the
/// scene's laws.
std::vector<std::string> sentences_of(const RecordedMotion& motion, double frequency,
                                      const MotionPlace& contact, const Summary& summary) {
  const auto of = [&](const char* quantity) { return motion.of(contact.name, quantity); };
  const auto sum = [&](const char* quantity) { return motion.of(all_contacts, quantity); };
  const auto has = [&](const Quantity& one) { return std::isfinite(number_in(summary, one)); };
  std::vector<std::string> sentences{
      kind_sentence(motion, frequency),
      fmt::format("Over the next {} periods {} vibrates by {} (rms about its mean), between {} and {}.",
                  motion.recorded, contact.name, with_error(of("vibration_rms"), contact.unit),
                  quantity(of("min").value, contact.unit), quantity(of("max").value, contact.unit))};
  if (has(quantities::mean_contact_force))
    sentences.push_back(
        "Its contact force has a mean of " + with_error(of("mean_force"), force_unit(contact.unit)) +
        (has(quantities::max_contact_force)
             ? " and a largest value of " + quantity(of("max_force").value, force_unit(contact.unit)) + "."
             : "."));
  if (has(quantities::impacts))
    sentences.push_back(fmt::format(
        "There are {} ± {} impacts per forcing period, at up to {}. They dissipate {}.",
        short_number(sum("impacts_in_a_period").value), short_number(sum("impacts_in_a_period").error, 2),
        quantity(of("max_impact_velocity").value, contact.unit + "/s"),
        with_error(sum("impact_energy_in_a_period"), "J")));
  if (has(quantities::friction_work))
    sentences.push_back(fmt::format("Friction dissipates {} per forcing period.",
                                    with_error(sum("friction_work_in_a_period"), "J")));
  if (has(quantities::wear))
    sentences.push_back(fmt::format("It wears off {} ± {} m^3 per forcing period.",
                                    short_number(sum("wear_in_a_period").value),
                                    short_number(sum("wear_in_a_period").error, 2)));
  sentences.emplace_back("Errors are half widths of 95 % confidence intervals from 20 batch means.");
  return sentences;
}

void add_files(Record& record, const RecordedMotion& motion) {
  record.section = section_table(motion);
  record.files.push_back({"statistics.csv", csv_text(statistics_table(motion)),
                          "statistics of the recorded periods, with half the width of 95 % confidence "
                          "intervals by 20 batch means"});
  record.files.push_back(
      {"spectrum.csv", csv_text(spectrum_table(motion)),
       fmt::format("one-sided power spectral density from {} half-overlapping segments of {:.0f} periods "
                   "with a Hann window",
                   motion.spectrum.segments, motion.spectrum.segment_periods)});
  for (Panel& panel : recorded_panels(motion)) record.figure.panels.push_back(std::move(panel));
}

}  // namespace

void append_recorded(Record& record, const RecordedMotion& motion, const Scene& scene, int contact) {
  const double frequency = scene.forcing.frequency;
  if (motion.is_aperiodic()) record.status = quantities::aperiodic;
  replace(record.summary, quantities::status, record.status);
  const MotionPlace& leading = motion.places[std::size_t(contact)];
  replace_values(record, motion, leading.name);
  append_outputs(record, scene, motion);
  record.sentences = sentences_of(motion, frequency, leading, record.summary);
  record.add("motion_kind", name_of(motion.kind));
  record.add(quantities::lyapunov_exponent, motion.exponent.value);
  record.add(quantities::lyapunov_exponent_error, motion.exponent.error);
  if (motion.repeats > 0) record.add("section_period", motion.repeats);
  record.add(quantities::curve_residual, motion.curve.residual);
  if (motion.kind == MotionKind::quasi_periodic) {
    record.add(quantities::second_frequency, motion.curve.rotation * frequency);
    record.add(quantities::rotation_number, motion.curve.rotation);
    record.add("curve_harmonics", motion.curve.harmonics());
  }
  record.add("transient_periods", motion.transient);
  record.add("recorded_periods", motion.recorded);
  record.add("batch_correlation", motion.correlation);
  record.add("statistics", statistics_table(motion));
  warn_of_kind(record, motion);
  add_files(record, motion);
}

}  // namespace wavebalance::app
