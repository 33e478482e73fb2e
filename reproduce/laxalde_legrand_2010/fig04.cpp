#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using app::Dash;

namespace {

constexpr int orbit_times = 512;

Eigen::VectorXd row(const Eigen::MatrixXd& values, Eigen::Index index) { return values.row(index); }

Eigen::Index middle(const Motion& motion) { return (motion.position.size() - 1) / 2; }

app::Series orbit(const std::string& label, const Motion& motion, Eigen::Index node, Colour colour, Dash dash,
                  double width) {
  auto series =
      report::styled({label, row(motion.displacement, middle(motion)), row(motion.velocity, middle(motion))},
                     colour, {.dash = dash, .width = width});
  const Eigen::VectorXd z = row(motion.displacement, node);
  series.z.assign(z.begin(), z.end());
  return series;
}

void add_columns(Table& table, const std::string& name, const Motion& motion) {
  table.add_column("middle_displacement_" + name, row(motion.displacement, middle(motion)));
  table.add_column("middle_velocity_" + name, row(motion.velocity, middle(motion)));
  table.add_column("first_node_" + name, row(motion.displacement, 1));
  table.add_column("last_node_" + name, row(motion.displacement, motion.displacement.rows() - 1));
}

/// The largest quick change, over the range.
double steepest(const Eigen::VectorXd& v) {
  const Eigen::Index steps = orbit_times / report::parts_of_period;
  return (v.tail(v.size() - steps) - v.head(v.size() - steps)).cwiseAbs().maxCoeff() /
         (v.maxCoeff() - v.minCoeff());
}

/// The histories that the picture shows: middle node's displacement and velocity, last and first node's
/// displacement.
std::vector<Eigen::VectorXd> drawn_histories(const Motion& motion) {
  return {row(motion.displacement, middle(motion)), row(motion.velocity, middle(motion)),
          row(motion.displacement, motion.displacement.rows() - 1), row(motion.displacement, 1)};
}

/// The motions that are drawn, over one period.
struct Motions {
  Motion low;     ///< energy 0.7, without contact
  Motion high;    ///< energy 1.8
  Motion remedy;  ///< energy 1.8, half-lumped mass
  Motion exact;   ///< energy 1.8, closed form
};

/// The orbit's projection on the floor of the panel.
app::Series shadow(const app::Series& orbit, double floor) {
  auto series = report::styled({"", orbit.x, orbit.y}, Colour::grey, {.width = 0.6});
  series.z.assign(orbit.x.size(), floor);
  return series;
}

app::Figure drawn(const Motions& motions) {
  app::Figure figure;
  figure.panel_width = 560;
  figure.panel_height = 470;
  for (const bool last : {true, false}) {
    auto& panel = figure.add_panel(last ? "last node" : "first node");
    panel.x.label = "Middle, u / g_0";
    panel.y.label = "Middle, u̇ / g_0 ω_1";
    panel.z.emplace().label = last ? "Last, u / g_0" : "First, u / g_0";
    panel.x.ticks = {-0.8, -0.4, 0.0, 0.4, 0.8};
    panel.y.ticks = {-1.0, 0.0, 1.0};
    panel.z->ticks = last ? std::vector<double>{-1.0, 0.0, 1.0} : std::vector<double>{-0.1, 0.0, 0.1};
    panel.z->lower = last ? -2.0 : -0.2;
    panel.z->upper = last ? 1.2 : 0.2;
    const Eigen::Index node = last ? motions.low.position.size() - 1 : 1;
    const auto add = [&](const char* name, const Motion& motion, Colour colour, Dash dash, double width) {
      const auto series = orbit(name, motion, node, colour, dash, width);
      panel.add(shadow(series, *panel.z->lower)).add(series);
    };
    add("exact", motions.exact, Colour::black, Dash::dashed, 1.6);
    add("half-lumped", motions.remedy, Colour::orange, Dash::solid, 0.8);
    add("eq. (28)", motions.high, Colour::vermillion, Dash::solid, 2.0);
    add("0.7", motions.low, Colour::sky_blue, Dash::solid, 2.0);
  }
  return figure;
}

Table motions_table(const Motions& motions) {
  Table table;
  table.add_column("time_fraction", motions.low.time);
  add_columns(table, "energy_0.7", motions.low);
  add_columns(table, "energy_1.8", motions.high);
  add_columns(table, "energy_1.8_half_lumped", motions.remedy);
  add_columns(table, "energy_1.8_exact", motions.exact);
  return table;
}

/// Whether the motion with contact changes faster than that without, by at least one of the histories.
report::Verdict faster(const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  return report::lower({steepest(low)}, {steepest(high)});
}

void claims(report::Artefact& artefact, const Motions& motions) {
  const auto low = drawn_histories(motions.low), high = drawn_histories(motions.high),
             exact = drawn_histories(motions.exact);
  double below = 0.0, above = 1.0;
  for (std::size_t i = 0; i < low.size(); ++i) {
    below = std::max(below, beyond_ellipse(low[i]));
    above = std::min(above, beyond_ellipse(high[i]));
  }
  const auto text = [&](std::size_t history) {
    return fmt::format("{} against {} (exact {})", report::percent(steepest(high[history])),
                       report::percent(steepest(low[history])), report::percent(steepest(exact[history])));
  };
  const auto displacements = report::lower({steepest(low[0]), steepest(low[2]), steepest(low[3])},
                                           {steepest(high[0]), steepest(high[2]), steepest(high[3])});
  artefact.check(
      {"section 5.1", "While the former typically features elliptic trajectories in the phase space",
       fmt::format("without contact, and so the linear mode by construction: the histories drawn differ from "
                   "one harmonic by at most {} of their range",
                   report::number(report::rounding)),
       report::number(below, 2), below <= report::rounding});
  judge(
      artefact,
      {.place = "section 5.1",
       .quote = "the latter is much "
                "more complex with velocity singularities and quick changes in displacements.",
       .criterion = fmt::format(
           "with contact every history drawn differs from one harmonic by more than {0} of its range; the middle node's "
           "velocity, and the three displacements, change by more of their ranges within 1/{1} of a period with contact "
           "than without",
           report::percent(report::visible_share), report::parts_of_period),
       .measured = fmt::format(
           "from one harmonic by {} or more; velocity {}; displacement of the middle, last and first node {}, {}, {}",
           report::percent(above), text(1), text(0), text(2), text(3)),
       .verdict = report::together(
           {report::plain(above > report::visible_share), faster(low[1], high[1]), displacements})},
      "One of the parts does not hold: see the figures.");
}

/// Share of the period in which the middle node of the exact motion rests.
double rest(const Motion& exact) {
  const auto velocity = row(exact.velocity, middle(exact));
  const auto still =
      std::count_if(velocity.begin(), velocity.end() - 1, [](double v) { return std::abs(v) < 1e-9; });
  return static_cast<double>(still) / static_cast<double>(velocity.size() - 1);
}

}  // namespace

void fig04(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("rod.toml")), remedy(artefact.scene("rod_half_lumped.toml"));
  const Motions motions{computed_motion(study, 0.7, orbit_times), computed_motion(study, 1.8, orbit_times),
                        computed_motion(remedy, 1.8, orbit_times),
                        exact_motion(study.scene(), 1.8, orbit_times)};
  artefact.picture(drawn(motions));
  artefact.data(
      motions_table(motions), "displacement over the gap, velocity over gap times linear frequency (rad/s)",
      {discretisation(study.scene()) + ", eq. (28); energy_1.8_half_lumped: half-lumped mass matrix"});
  artefact.caption(fmt::format(
      "Displacements of the last (a) and of the first (b) node over displacement and velocity of the middle one, at "
      "energies 0.7 and 1.8, {}. Eq. (28) is the paper's mass matrix. In the exact motion the middle node rests for {} of "
      "the period: the upright lines of (a).",
      discretisation(study.scene()), report::percent(rest(motions.exact))));
  claims(artefact, motions);
}

}  // namespace wavebalance::ll10
