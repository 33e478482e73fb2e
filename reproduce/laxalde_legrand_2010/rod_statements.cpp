#include "rod_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "modes/rayleigh_quotient.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
namespace {

using report::number;
using report::percent;
using report::Reading;
using report::Statement;
using report::Verdict;

constexpr double compared[] = {1.2, 1.8, 3.0, 5.0, 10.0};  // energy ratios

/// Exact increase of ω over the linear frequency from the linear mode to the last energy compared.
double frequency_range(const RodCurves& curves) {
  return exact_mode(curves.study.scene(), *std::rbegin(compared)).frequency_ratio() - 1.0;
}

std::string ratio_text(double energy, double first, double second) {
  return fmt::format("{} against {} at {}", number(second, 5), number(first, 5), number(energy));
}

void linear(report::Artefact& artefact, const RodCurves& curves) {
  const double frequency = curves.study.linear_frequency();
  Statement s{
      "section 5.1",
      "The natural frequency of its linear counterpart with clamped-free boundary conditions is 1297.5 "
      "Hz.",
      "the first frequency of 20 elements with the mass matrix of eq. (28) rounds to 1297.5 Hz",
      fmt::format("{} Hz; with the half-lumped mass matrix {} Hz", number(frequency, 7),
                  number(curves.remedy.linear_frequency(), 7)),
      report::plain(std::abs(frequency - 1297.5) < 0.05)};
  const std::string because = "The frequency does not round to that of the paper.";
  judge(artefact, s, because);
}

/// The least energy of a motion with contact, on an internal resonance or not; infinite if none is found.
double first_contact(const app::Backbone& curve) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& point : curve.points)
    if (point.accepted() || point.status == solvers::ModeStatus::internal_resonance)
      least = std::min(least, point.energy_ratio);
  return least;
}

/// The energy 1 and the energy of the first contact tie.
Verdict at_unity(double energy) {
  return report::plain(std::max(energy, 1.0 / energy) <= 1.0 + report::tie_share);
}

void onset(report::Artefact& artefact, const RodCurves& curves) {
  std::vector<Reading> readings;
  for (const int harmonics : {1, 2, 3, 5, 8, 10}) {
    const app::ModeStudy study(
        artefact.scene("rod.toml", {"analysis.harmonics=" + std::to_string(harmonics),
                                    "analysis.last_frequency_ratio=1.06", "analysis.points=60"}));
    const double energy = first_contact(study.backbone());
    readings.push_back(
        {fmt::format("N = {}", harmonics), at_unity(energy), "from " + number(energy, 4) + " on"});
  }
  const double exact = ExactBarMode::onset_energy(1, EnergyMeasure::modal);
  const double remedy = first_contact(curves.remedy_backbone);
  readings.push_back(
      {"the rod itself, not discretised", at_unity(exact), "from " + number(exact, 4) + " on", false});
  readings.push_back({fmt::format("half-lumped mass, N = {}", curves.remedy.scene().analysis.harmonics),
                      at_unity(remedy), "from " + number(remedy, 4) + " on", false});
  Statement s{
      "section 5.1", "Contact occurs as soon as the modal energy reaches unity.",
      fmt::format("the least energy of a motion with contact, eq. (28), ties with 1 (within {}); the paper "
                  "does not state N",
                  percent(report::tie_share)),
      fmt::format(
          "by eq. (28) it does with {} of {} numbers of harmonics. The exact motions of the rod begin at {}, "
          "before the linear mode reaches the obstacle",
          report::agreeing(readings), report::of_text(readings).size(), number(exact, 4)),
      report::over(readings)};
  const std::string because = "The least energy with contact is not near 1 with every number of harmonics.";
  s.readings = readings;
  s.panel = "(b)";
  judge(artefact, s, because);
}

void hardening(report::Artefact& artefact, const RodCurves& curves) {
  bool rising = true;
  std::string measured;
  double before = 1.0;
  for (const double energy : compared) {
    const double ratio =
        accepted_at(curves.study, curves.backbone, energy).omega / curves.study.mode().linear_omega();
    rising = rising && ratio > before;
    before = ratio;
    measured += (measured.empty() ? "" : ", ") + number(ratio, 5) + " at " + number(energy);
  }
  Statement s{
      "section 5.1", "Then, the natural frequency increases which denotes a hardening effect.",
      "ω over the linear frequency rises from one to the next of the energies 1.2, 1.8, 3, 5, 10, eq. (28)",
      measured, report::plain(rising)};
  const std::string because = "The frequency falls between two of these energies.";
  s.claim = "The rod hardens";
  s.headline = fmt::format("its frequency rises to {} times the linear one at energy {}; exact {} times.",
                           number(before, 4), number(*std::rbegin(compared)),
                           number(1.0 + frequency_range(curves), 4));
  s.panel = "(a)";
  judge(artefact, s, because);
}

/// The relative error of √r against ω at the energies compared.
struct QuotientError {
  double largest = 0.0;
  double exact = 0.0;      ///< the same of the exact motions
  double virial = 0.0;     ///< of ω² - r - <force> gap / m̂, relative
  double displaced = 0.0;  ///< <force u> over mean force times largest displacement, least of all
  double power = 0.0;      ///< <force u̇>, largest of all, likewise
  double range = 0.0;      ///< of ω, over the linear frequency
  std::string text;
};

QuotientError quotient_error(const RodCurves& curves) {
  QuotientError error;
  error.displaced = std::numeric_limits<double>::infinity();
  error.range = frequency_range(curves);
  const double linear = curves.study.mode().linear_omega();
  for (const double energy : compared) {
    const auto point = accepted_at(curves.study, curves.backbone, energy);
    const auto exact = exact_mode(curves.study.scene(), energy);
    const double ratio = point.omega / linear, root = std::sqrt(point.rayleigh) / linear;
    error.largest = std::max(error.largest, std::abs(ratio - root));
    error.exact = std::max(error.exact, exact.frequency_ratio() - exact.rayleigh_frequency_ratio());
    error.virial = std::max(error.virial, point.virial_residual);
    error.text += (error.text.empty() ? "" : ", ") + ratio_text(energy, ratio, root);
    const auto motion = curves.study.contact_motion(point, curves.study.scene().analysis.samples);
    const auto mean = [&](const Eigen::MatrixXd& values) {
      return motion.force.cwiseProduct(values).mean() / (motion.force.mean() * values.cwiseAbs().maxCoeff());
    };
    error.power = std::max(error.power, std::abs(mean(motion.velocity)));
    error.displaced = std::min(error.displaced, mean(motion.displacement));
  }
  return error;
}

void quotient(report::Artefact& artefact, const QuotientError& error) {
  Statement s{
      "section 3.1",
      "Nonlinear eigenvectors $\\hat u$ are defined as critical points of this Rayleigh quotient and the associated "
      "eigenvalues are such that $\\omega^2 = r(\\hat u)$.",
      fmt::format(
          "√r is ω at the energies 1.2, 1.8, 3, 5, 10 to {} of what ω rises by, {} of the linear frequency",
          percent(report::visible_share), number(error.range)),
      fmt::format("√r against ω: {}; exact motions differ by up to {}", error.text, number(error.exact, 3)),
      report::invisible(error.largest, error.range)};
  const std::string because = fmt::format(
      "The obstacle stands at a gap, so the contact force enters the balance of energies. Stationarity gives "
      "$\\omega^2 = r + \\langle f \\rangle g_0 / \\hat m$ with the mean force $\\langle f \\rangle$, which these motions meet to {}.",
      number(error.virial, 2));
  s.panel = "(a) and (c)";
  s.claim = "ω² is the Rayleigh quotient r";
  s.headline = fmt::format(
      "ω and √r differ by up to {} of the linear frequency; $\\omega^2 = r + \\langle f \\rangle g_0 / \\hat m$ holds to {}.",
      number(error.largest, 2), number(error.virial, 1));
  judge(artefact, s, because);
}

void work(report::Artefact& artefact, const QuotientError& error) {
  const char* quote =
      "since nonlinear forces arise from contact boundary conditions, their work is identically zero; hence the "
      "use of an unmodified Rayleigh quotient to define the respective eigenvalues";
  Statement s{"section 3.2", quote,
              fmt::format("the unmodified quotient defines ω: √r is ω to {} of what ω rises by",
                          percent(report::visible_share)),
              fmt::format("they differ by up to {} of the linear frequency", number(error.largest, 3)),
              report::invisible(error.largest, error.range)};
  const std::string because = fmt::format(
      "The force does no work over a period. The quotient requires that the mean of force times displacement "
      "vanishes, but it is $g_0$ times the mean force, at least {} of mean force times largest displacement.",
      number(error.displaced, 3));
  s.panel = "(a) and (c)";
  judge(artefact, s, because);
  artefact.check(
      {"section 3.2", "their work is identically zero",
       "the mean power of the contact force is below 1e-9 of mean force times largest velocity; so it "
       "must be, since the force is even in time and the velocity odd",
       number(error.power, 2), error.power < 1e-9});
}

void printed_norm(report::Artefact& artefact, const RodCurves& curves) {
  const auto& last = curves.published.back();
  double defect = 0.0;
  for (const auto& point : curves.published)
    if (point.accepted()) defect = std::max(defect, point.equation_residual);
  const double error = std::abs(last.energy_ratio / last.prescribed_ratio - 1.0);
  const double corrected = accepted_at(curves.study, curves.backbone, compared[4]).energy_ratio;
  const double corrected_error = std::abs(corrected / compared[4] - 1.0);
  Statement s{
      "section 5.1",
      "the mode normalization of Eq. (24c) through a prescribed kinetic energy controls the amplitude of the "
      "nonlinear mode",
      fmt::format(
          "with h as printed in (24c), without n², the energy of (12) is that prescribed, to {}; it is a misprint if it "
          "is not, and is with the factor n² of (11) and (12)",
          percent(report::visible_share)),
      fmt::format(
          "prescribed {}, found {} ({}); the equation of motion is met to {} of the elastic forces only",
          number(last.prescribed_ratio), number(last.energy_ratio, 4), to_string(last.status),
          percent(defect, 2)),
      report::misprint(report::invisible(error, 1.0), report::invisible(corrected_error, 1.0))};
  const std::string because = fmt::format(
      "Equations (11) and (12) have the factor n² that (24c) and (24d) lack. With it the energy found is that "
      "prescribed: {} for {}.",
      number(corrected, 6), number(compared[4]));
  judge(artefact, s, because);
}

/// The mode against a free motion of the same energy that is all in harmonic N of the linear mode.
void minimum(report::Artefact& artefact, const RodCurves& curves) {
  const double energy = compared[1];
  const auto point = accepted_at(curves.study, curves.backbone, energy);
  const auto& model = curves.study.mode().model();
  const int harmonics = curves.study.scene().analysis.harmonics;
  const Eigen::Index modes = model.omega_squared.size();
  const RayleighQuotient quotient(model.omega_squared.asDiagonal(), Eigen::MatrixXd::Identity(modes, modes),
                                  {harmonics, true});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(quotient.unknowns());
  x[harmonics * modes] = 1.0;  // of cos(N omega t) in mode 1
  const double root = std::sqrt(quotient.value(x)) / curves.study.mode().linear_omega();
  const double mode = std::sqrt(point.rayleigh) / curves.study.mode().linear_omega();
  Statement s{
      "section 3.1",
      "Accordingly, the eigenproblem of interest becomes $\\min r(\\hat u)$ subject to $h(\\hat u) = 0$",
      fmt::format("no motion without contact and of the energy {} has a smaller r than the mode",
                  number(energy)),
      fmt::format("√r is {} of the linear frequency for the mode, and {} for the linear mode at {} times its "
                  "frequency, whose amplitude is {} of the gap",
                  number(mode, 5), number(root, 3), harmonics, number(std::sqrt(energy) / harmonics, 3)),
      report::plain(root >= mode)};
  const std::string because = fmt::format(
      "Modes are critical points of r, which section 3.1 says too, but the abstract, the title of section 3.1, (13), (15) "
      "and the conclusions say minimisation. The linear mode at {} times its frequency has the same energy, does not "
      "touch, and its √r is {} of the linear frequency.",
      harmonics, number(root, 3));
  judge(artefact, s, because);
}

/// The equations scale with the gap, so that nothing but the code could fail.
void check_gap(report::Artefact& artefact) {
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  std::string measured;
  for (const char* gap : {"1e-4", "1e-3", "1e-2"}) {
    const app::ModeStudy study(artefact.scene("rod.toml", {std::string("contact.gap=") + gap}));
    const double ratio =
        accepted_at(study, study.backbone(2.0), compared[1]).omega / study.mode().linear_omega();
    least = std::min(least, ratio);
    largest = std::max(largest, ratio);
    measured += (measured.empty() ? "" : ", ") + number(ratio, 12) + " with " + gap + " m";
  }
  artefact.check(
      {"section 5.1",
       "Since the system is assumed to be hyper-elastic, results are not sensitive to the initial gap amplitude.",
       fmt::format(
           "ω over the linear frequency at energy ratio {} with gaps of 0.1, 1 and 10 mm is the same to {}",
           number(compared[1]), number(report::rounding)),
       measured, largest - least <= report::rounding});
}

}  // namespace

void rod_statements(report::Artefact& artefact, const RodCurves& curves) {
  const auto error = quotient_error(curves);
  linear(artefact, curves);
  check_gap(artefact);
  onset(artefact, curves);
  hardening(artefact, curves);
  quotient(artefact, error);
  work(artefact, error);
  minimum(artefact, curves);
  printed_norm(artefact, curves);
}

}  // namespace wavebalance::ll10
