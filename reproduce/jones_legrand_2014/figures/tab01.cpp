#include <cmath>

#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
using report::number;

namespace {

double largest_free_displacement(const app::Scene& scene) {
  return app::make_problem(scene).linear_response().cwiseAbs().maxCoeff();
}

/// Whether `found` is the figure that the paper states, to the decimals that it gives.
bool reads(double found, double stated, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  return std::abs(found - stated) <= 0.5 * unit * (1.0 + 1e-12);
}

Table printed(const app::Scene& one, const app::Scene& two, double free_one, double free_two) {
  Table table({"", "Case 1", "Case 2"});
  const auto row = [&](const std::string& name, double a, double b, const std::string& unit) {
    table.append_row({name, number(a, 6) + " " + unit, number(b, 6) + " " + unit});
  };
  row("forcing frequency", one.forcing.frequency, two.forcing.frequency, "Hz");
  row("penalty constant $a_c$", one.contact.number("constant"), two.contact.number("constant"), "N");
  row("penalty exponent $\\alpha$", one.contact.number("exponent"), two.contact.number("exponent"), "1/m");
  row("damping factor $\\beta$", one.structure.stiffness_damping, two.structure.stiffness_damping, "s");
  row("initial gap $g_0$", 1e3 * one.contact.gap, 1e3 * two.contact.gap, "mm");
  row("largest tip displacement without contact (computed)", 1e3 * free_one, 1e3 * free_two, "mm");
  return table;
}

void leave_unjudged(report::Artefact& artefact) {
  artefact.unjudged(
      {"section 4",
       "The values of $a_c$ and $\\alpha$ in Eq. (5) were selected to simulate a reasonably rigid penalty "
       "function while maintaining good conditioning of the system of nonlinear equations.",
       "The paper gives no measure of conditioning, and no value that it calls good."});
  artefact.unjudged(
      {"section 1",
       "Unlike the shooting method which can become numerically sensitive to possible jumps in the "
       "velocity field, weighted residual techniques directly enforce the periodicity conditions",
       "It says what can happen and names no system. With the exponential law of the cases the velocity "
       "has no jumps."});
}

void list_slips(report::Artefact& artefact) {
  artefact.slip({"eq. (1)", "the sign of $E S u_{xx}$", "the one that makes it a wave equation",
                 "Eq. (7) has M and K with one sign, both positive."});
  artefact.slip(
      {"section 1",
       "“five sections: Section 2 introduces the system of interest; ... and Section 6 presents and compares "
       "results”",
       "Section 1 introduces the system, Section 2 the weighted residuals, Section 3 the bases, Section 4 the "
       "model, Section 5 presents results, and Section 6 concludes.",
       "The headings of the sections."});
}

}  // namespace

void tab01(report::Artefact& artefact) {
  const auto one = artefact.scene("case1.toml"), two = artefact.scene("case2.toml");
  const auto structure = app::make_structure(one);
  const double fundamental = fem::eigenmodes(structure.stiffness, structure.mass, 1).frequencies_hz[0];
  const double free_one = largest_free_displacement(one), free_two = largest_free_displacement(two);
  Table table({"case", "forcing_frequency_Hz", "penalty_constant_N", "penalty_exponent_per_m",
               "damping_factor_s", "initial_gap_m", "free_max_displacement_m"});
  for (const auto* scene : {&one, &two})
    table.append_row({scene == &one ? std::int64_t{1} : std::int64_t{2}, scene->forcing.frequency,
                      scene->contact.number("constant"), scene->contact.number("exponent"),
                      scene->structure.stiffness_damping, scene->contact.gap,
                      scene == &one ? free_one : free_two});
  artefact.data(table, "SI; a column's name ends in its unit");
  artefact.printed(printed(one, two, free_one, free_two));
  artefact.caption("From the scene files; the last row is computed with the 250 kN at the tip.");
  report::Statement frequency{"section 4", "The fundamental frequency of this rod is approximately 1273 Hz.",
                              "the lowest natural frequency of the 25 elements, rounded to 1 Hz",
                              number(fundamental, 7) + " Hz", report::plain(reads(fundamental, 1273.0, 0))};
  frequency.because = "It is " + frequency.measured + ".";
  artefact.statement(frequency);
  report::Statement free{
      "section 4",
      "The maximum tip displacements without contact for this system are approximately 1.4 mm "
      "at 150 Hz and 29 mm at 1275 Hz.",
      "with the force at the tip, which the paper does not say, rounded to 0.1 and 1 mm",
      number(1e3 * free_one, 5) + " mm and " + number(1e3 * free_two, 5) + " mm",
      report::together(
          {report::plain(reads(1e3 * free_one, 1.4, 1)), report::plain(reads(1e3 * free_two, 29.0, 0))})};
  free.because = "They are " + free.measured + ".";
  artefact.statement(free);
  leave_unjudged(artefact);
  list_slips(artefact);
}

}  // namespace wavebalance::jl14
