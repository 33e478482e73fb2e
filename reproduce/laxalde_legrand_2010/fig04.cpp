#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "figures.hpp"
#include "ll10.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using app::Dash;

namespace {

constexpr int times = 512;

std::vector<double> row(const Eigen::MatrixXd& values, Eigen::Index index) {
  const Eigen::VectorXd one = values.row(index);
  return {one.begin(), one.end()};
}

Eigen::Index middle(const Motion& motion) { return (motion.position.size() - 1) / 2; }

app::Series orbit(const std::string& label, const Motion& motion, Eigen::Index node, Colour colour,
                  Dash dash) {
  app::Series series(label, row(motion.displacement, middle(motion)), row(motion.velocity, middle(motion)));
  series.z = row(motion.displacement, node);
  series.colour = colour;
  series.dash = dash;
  return series;
}

void add_columns(Table& table, const std::string& name, const Motion& motion) {
  table.add_column("middle_displacement_" + name, row(motion.displacement, middle(motion)));
  table.add_column("middle_velocity_" + name, row(motion.velocity, middle(motion)));
  table.add_column("first_node_" + name, row(motion.displacement, 1));
  table.add_column("last_node_" + name, row(motion.displacement, motion.displacement.rows() - 1));
}

/// Relative rms distance of the middle node's orbit from the ellipse of its first harmonic.
double beyond_ellipse(const Motion& motion) {
  const Eigen::Index count = motion.time.size() - 1;
  const Eigen::VectorXd u = motion.displacement.row(middle(motion)).head(count);
  const Eigen::ArrayXd phase = 2.0 * std::numbers::pi * motion.time.head(count).array();
  const double mean = u.mean(), c = 2.0 * (u.array() * phase.cos()).mean(),
               s = 2.0 * (u.array() * phase.sin()).mean();
  const Eigen::ArrayXd ellipse = mean + c * phase.cos() + s * phase.sin();
  return (u.array() - ellipse).matrix().norm() / (u.array() - mean).matrix().norm();
}

double steepest(const Motion& motion) {
  const Eigen::VectorXd v = motion.velocity.row(middle(motion));
  const Eigen::Index steps = times / 64;
  return (v.tail(v.size() - steps) - v.head(v.size() - steps)).cwiseAbs().maxCoeff() /
         (v.maxCoeff() - v.minCoeff());
}

/// The motions that are drawn, over one period.
struct Motions {
  Motion low;    ///< energy 0.7, without contact
  Motion high;   ///< energy 1.8
  Motion exact;  ///< energy 1.8, closed form
};

app::Figure drawn(const Motions& motions) {
  app::Figure figure;
  figure.title = "Energy 0.7 (blue) and 1.8 (orange), exact at 1.8 (dashed)";
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 420;
  for (const bool last : {true, false}) {
    auto& panel = figure.add_panel(last ? "last node" : "first node");
    panel.x.label = "Middle node, u / g_0";
    panel.y.label = "Middle node, u̇ / (g_0 ω_1)";
    panel.z.emplace().label = last ? "Last node, u / g_0" : "First node, u / g_0";
    panel.x.ticks = {-0.8, -0.4, 0.0, 0.4, 0.8};
    panel.y.ticks = {-1.0, 0.0, 1.0};
    panel.z->ticks = last ? std::vector<double>{-1.0, 0.0, 1.0} : std::vector<double>{-0.1, 0.0, 0.1};
    panel.legend = app::Legend::none;
    const Eigen::Index node = last ? motions.low.position.size() - 1 : 1;
    panel.add(orbit("energy 1.8, exact", motions.exact, node, Colour::black, Dash::dashed));
    panel.add(orbit("energy 0.7", motions.low, node, Colour::sky_blue, Dash::solid));
    panel.add(orbit("energy 1.8", motions.high, node, Colour::vermillion, Dash::solid));
  }
  return figure;
}

Table motions_table(const Motions& motions) {
  Table table;
  table.add_column("time_fraction", motions.low.time);
  add_columns(table, "energy_0.7", motions.low);
  add_columns(table, "energy_1.8", motions.high);
  add_columns(table, "energy_1.8_exact", motions.exact);
  return table;
}

void claims(report::Artefact& artefact, const Motions& motions) {
  const double below = beyond_ellipse(motions.low), above = beyond_ellipse(motions.high);
  artefact.check(
      {"section 5.1",
       "While the former typically features elliptic trajectories in the phase space, the latter is much "
       "more complex",
       "relative rms distance of the middle node's motion from one harmonic: below 1e-9 without contact, "
       "above 5 % with",
       report::number(below, 2) + " and " + report::percent(above), below < 1e-9 && above > 0.05});
  artefact.check(
      {"section 5.1", "with velocity singularities and quick changes in displacements",
       "the middle node's velocity changes by more of its range within 1/64 of a period with contact than "
       "without",
       fmt::format("{} against {} (exact: {}, a jump)", report::percent(steepest(motions.high)),
                   report::percent(steepest(motions.low)), report::percent(steepest(motions.exact))),
       steepest(motions.high) > steepest(motions.low)});
}

}  // namespace

void fig04(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("rod.toml"));
  const Motions motions{computed_motion(study, 0.7, times), computed_motion(study, 1.8, times),
                        exact_motion(study.scene(), 1.8, times)};
  artefact.picture(drawn(motions));
  artefact.data(motions_table(motions),
                "displacement over the gap, velocity over gap times linear frequency (rad/s)",
                {discretisation(study.scene())});
  artefact.caption(fmt::format(
      "Displacements of the last (a) and of the first (b) node over displacement and velocity of the middle "
      "one, {}. The paper does not state its energies.",
      discretisation(study.scene())));
  claims(artefact, motions);
}

}  // namespace wavebalance::ll10
