#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::ll10 {
namespace {

constexpr int map_times = 128;

app::HeatMap map_of(const Motion& motion, const Eigen::MatrixXd& values, double largest) {
  app::HeatMap map;
  map.x.assign(motion.time.begin(), motion.time.end());
  map.y.assign(motion.position.begin(), motion.position.end());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index l = 0; l < values.cols(); ++l) map.values.push_back(values(i, l));
  map.largest = largest;
  return map;
}

/// Marks the contact at the tip, by a line or by the samples that bear a force.
void mark_contact(app::Panel& panel, const Motion& motion, bool exact) {
  if (motion.contact.empty()) return;
  if (exact)
    panel.segments.push_back(
        {motion.contact[0], 1.0, motion.contact[1], 1.0, false, app::Dash::solid, app::Colour::black, 5.0});
  app::Series samples("", motion.contact, std::vector<double>(motion.contact.size(), 1.0),
                      app::SeriesStyle::points);
  samples.colour = app::Colour::black;
  samples.marker = 5;
  if (!exact) panel.add(samples);
}

void add_pair(app::Figure& figure, const std::string& title, const Motion& motion, double u, double v,
              bool exact) {
  for (const bool velocity : {false, true}) {
    auto& panel = figure.add_panel((velocity ? "velocity, " : "displacement, ") + title);
    panel.x = axis("Time (fraction of a period)", 0.0, 1.0);
    panel.y = axis("Position x/L", 0.0, 1.0);
    panel.x.ticks = panel.y.ticks = {0.0, 0.5, 1.0};
    panel.heat_map = map_of(motion, velocity ? motion.velocity : motion.displacement, velocity ? v : u);
    panel.heat_map->label = velocity ? "u̇ / g_0 ω_1" : "u / g_0";
    panel.legend = false;
    mark_contact(panel, motion, exact);
  }
}

Table motion_table(const std::vector<std::pair<std::string, Motion>>& motions) {
  Table table;
  const auto& first = motions.front().second;
  const Eigen::Index nodes = first.position.size(), count = first.time.size();
  const auto column = [&](auto value) {
    Eigen::VectorXd result(nodes * count);
    for (Eigen::Index i = 0; i < nodes; ++i)
      for (Eigen::Index l = 0; l < count; ++l) result[i * count + l] = value(i, l);
    return result;
  };
  table.add_column("position", column([&](auto i, auto) { return first.position[i]; }));
  table.add_column("time_fraction", column([&](auto, auto l) { return first.time[l]; }));
  for (const auto& [name, one] : motions) {
    const Motion& motion = one;
    table.add_column("displacement_" + name,
                     column([&](auto i, auto l) { return motion.displacement(i, l); }));
    table.add_column("velocity_" + name, column([&](auto i, auto l) { return motion.velocity(i, l); }));
  }
  return table;
}

/// Share of the motion's squares that the best product of a function of x and one of t leaves out: 0 for a
/// standing wave in one shape.
double beyond_one_shape(const Eigen::MatrixXd& values) {
  constexpr int iterations = 200;  // of the power method for the first singular vector
  Eigen::Index largest = 0;
  values.colwise().squaredNorm().maxCoeff(&largest);
  Eigen::VectorXd shape = values.col(largest);
  for (int i = 0; i < iterations; ++i) {
    const Eigen::VectorXd history = values.transpose() * shape;
    shape = (values * history).normalized();
  }
  return 1.0 - (values.transpose() * shape).squaredNorm() / values.squaredNorm();
}

/// The spread of the times at which the nodes of the outer three quarters have their largest velocity, in
/// periods.
double spread_of_maxima(const Motion& motion) {
  double least = 1.0, largest = 0.0;
  for (Eigen::Index i = motion.position.size() / 4; i < motion.position.size(); ++i) {
    Eigen::Index place = 0;
    motion.velocity.row(i).head(map_times / 2).maxCoeff(&place);
    least = std::min(least, motion.time[place]);
    largest = std::max(largest, motion.time[place]);
  }
  return largest - least;
}

/// Speeds over c of the fronts at which the velocity rises to `level` and falls from it in the first half of
/// the period, by least squares over the nodes at 0.25 to 0.75 of the length; infinite for a standing wave.
struct FrontSpeeds {
  double backward, forward;
};

FrontSpeeds front_speeds(const Motion& motion, double level) {
  std::vector<double> x, rise, fall;
  for (Eigen::Index i = 0; i < motion.position.size(); ++i) {
    if (motion.position[i] < 0.249 || motion.position[i] > 0.751) continue;
    double first = -1.0, last = -1.0;
    for (Eigen::Index l = 0; l < map_times / 2; ++l) {
      const double before = motion.velocity(i, l), after = motion.velocity(i, l + 1);
      if ((before < level) == (after < level)) continue;
      const double time = (static_cast<double>(l) + (level - before) / (after - before)) / map_times;
      if (after > before && first < 0.0) first = time;
      if (after < before) last = time;
    }
    if (first < 0.0 || last < 0.0) throw report::NotConverged("a node's velocity does not rise and fall");
    x.push_back(motion.position[i]);
    rise.push_back(first);
    fall.push_back(last);
  }
  const auto slope = [&](const std::vector<double>& times) {
    const Eigen::Map<const Eigen::ArrayXd> place(x.data(), static_cast<Eigen::Index>(x.size())),
        time(times.data(), static_cast<Eigen::Index>(times.size()));
    const Eigen::ArrayXd offset = place - place.mean();
    return std::abs((offset * time).sum() / offset.square().sum());
  };
  // A wave of speed c passes the length in a quarter of the linear period.
  const double passage = 0.25 * motion.frequency_ratio;
  return {passage / slope(rise), passage / slope(fall)};
}

/// The largest beyond_ellipse() of all nodes.
double beyond_ellipse(const Motion& motion) {
  double largest = 0.0;
  for (Eigen::Index i = 1; i < motion.position.size(); ++i)
    largest = std::max(largest, ll10::beyond_ellipse(motion.displacement.row(i)));
  return largest;
}

/// Relative rms distance from u(x, t) = u(x, -t) about the middle of the contact.
double asymmetry(const Eigen::MatrixXd& u) { return (u - u.rowwise().reverse()).norm() / u.norm(); }

double distance(const Eigen::MatrixXd& computed, const Eigen::MatrixXd& exact) {
  return (computed - exact).norm() / exact.norm();
}

using report::number;
using report::percent;

void check_standing(report::Artefact& artefact, const Motion& linear) {
  const double spread = spread_of_maxima(linear), rest = std::max(0.0, beyond_one_shape(linear.displacement));
  artefact.check(
      {"section 5.1",
       "the mode is a standing wave for which displacement and velocity fields are algebraically related through a "
       "phase-shift and an amplitude ratio, as expected. Maximum displacement and (respectively) velocity nodal "
       "amplitudes are simultaneously reached.",
       "energy 0.7, without contact and so the linear mode by construction: all nodes reach their largest velocity "
       "at one time, and one shape holds all but 1e-9 of the squared displacement",
       fmt::format("{}; a single shape to {}",
                   spread == 0.0 ? std::string("all nodes at the same instant")
                                 : "within " + percent(spread) + " of the period",
                   number(rest, 2)),
       spread == 0.0 && rest < 1e-9});
}

void claim_duration(report::Artefact& artefact, const Motion& exact) {
  const double duration = exact.contact[1] - exact.contact[0];
  std::vector<report::Reading> readings;
  for (const auto& [harmonics, samples] : {std::pair{5, 10}, {5, 20}, {10, 20}, {10, 40}, {10, 80}}) {
    const app::ModeStudy study(artefact.scene("rod.toml", {"analysis.harmonics=" + std::to_string(harmonics),
                                                           "analysis.samples=" + std::to_string(samples)}));
    const auto point = study.at_energy(1.8);
    if (!point.accepted()) throw report::NotConverged("contact duration");
    readings.push_back(
        {fmt::format("N = {}, m = {}", harmonics, samples),
         report::plain(point.active.size() > 1 && static_cast<int>(point.active.size()) < samples),
         fmt::format("{} of {} samples, {}", point.active.size(), samples, percent(point.contact_fraction))});
  }
  judge(
      artefact,
      {.place = "section 5.1",
       .quote = "contact occurs over a fraction of the period of the respective nonlinear mode",
       .criterion =
           "energy 1.8, eq. (28): more than one of the samples is in contact, and not all; the paper states neither N "
           "nor m",
       .measured =
           fmt::format("so with {} of {} numbers of harmonics and samples; exact contact lasts for {} of the "
                       "period",
                       report::agreeing(readings), readings.size(), percent(duration)),
       .verdict = report::over(readings),
       .readings = readings,
       .panel = "(c) and (d)"},
      "Few harmonics touch the obstacle at a single sample, however short, so that the computed fraction is that "
      "sample's share of the period and not a duration.");
}

void claim_travelling(report::Artefact& artefact, const Motion& contact, const Motion& exact) {
  const double level = 0.5 * exact.velocity.maxCoeff();
  const auto found = front_speeds(contact, level), closed = front_speeds(exact, level);
  judge(artefact,
        {.place = "section 5.1",
         .quote = "which becomes a traveling wave, as displayed in Fig. 5(c)-(d)",
         .criterion = fmt::format(
             "energy 1.8: between x/L = 0.25 and 0.75 the fronts at which the velocity rises and "
             "falls move at the speed of sound, to a tie ({}); a standing wave has them everywhere at "
             "once",
             percent(report::tie_share)),
         .measured = fmt::format(
             "{} c towards the clamp and {} c back (exact motion, by the same measure: {} and {})",
             number(found.backward), number(found.forward), number(closed.backward), number(closed.forward)),
         .verdict = report::plain(std::max({found.backward, found.forward, 1.0 / found.backward,
                                            1.0 / found.forward}) <= 1.0 + report::tie_share),
         .panel = "(d)"},
        "The fronts do not move at the speed of sound.");
}

void claim_maxima(report::Artefact& artefact, const Motion& contact) {
  const double spread = spread_of_maxima(contact);
  judge(
      artefact,
      {.place = "section 5.1",
       .quote =
           "these are highlighted by the velocity map histories in Fig. 5d for which the condition of simultaneous "
           "maximum nodal amplitudes does not hold anymore",
       .criterion = fmt::format(
           "energy 1.8: the largest velocities of the nodes at x/L > 1/4 are further apart than {} of the period",
           percent(report::visible_share)),
       .measured = fmt::format("{} of a period apart", percent(spread)),
       .verdict = report::plain(spread > report::visible_share),
       .panel = "(d)"},
      "All nodes are fastest at one time.");
}

/// A motion with contact is no single harmonic, and its force is even in time: neither could be otherwise.
void check_form(report::Artefact& artefact, const Motion& linear, const Motion& contact) {
  const double below = beyond_ellipse(linear), above = beyond_ellipse(contact);
  artefact.check(
      {"section 5.1", "Displacement and velocity fields are no more algebraically related to each other.",
       fmt::format("energy 1.8: a node's displacement differs from one harmonic, for which the relation is "
                   "an ellipse, by more than {} of its range",
                   percent(report::visible_share)),
       fmt::format("by up to {}; without contact {}", percent(above), number(below, 2)),
       above > report::visible_share});
  const auto& u = contact.displacement;
  const double difference = (u - u.rowwise().reverse()).cwiseAbs().maxCoeff(),
               range = u.maxCoeff() - u.minCoeff();
  artefact.check(
      {"section 5.1",
       "the expected symmetry in time and space of generic travelling waves is also retrieved by the algorithm as "
       "pictured in Fig. 5c while no assumptions were made on the displacement field",
       fmt::format(
           "energy 1.8, full Fourier series: the displacement is even in time about the middle of the contact, "
           "to {} of its range",
           number(report::rounding)),
       fmt::format("{} of the gap at most, rms {} of the displacement", number(difference, 2),
                   number(asymmetry(u), 2)),
       difference <= report::rounding * range});
}

/// The least multiple of 0.2 that is no less.
double rounded_up(double value) { return std::ceil(value / 0.2 - 1e-9) * 0.2; }

}  // namespace

void fig05(report::Artefact& artefact) {
  const app::ModeStudy study(artefact.scene("rod.toml")), remedy(artefact.scene("rod_half_lumped.toml"));
  const auto& scene = study.scene();
  const auto low = computed_motion(study, 0.7, map_times), high = computed_motion(study, 1.8, map_times),
             mixed = computed_motion(remedy, 1.8, map_times);
  const auto exact_low = exact_motion(scene, 0.7, map_times),
             exact_high = exact_motion(scene, 1.8, map_times);
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 370;
  figure.panel_height = 235;
  double u = 0.0, v = 0.0;
  for (const Motion* motion : {&high, &mixed, &exact_high}) {
    u = std::max(u, rounded_up(motion->displacement.cwiseAbs().maxCoeff()));
    v = std::max(v, rounded_up(motion->velocity.cwiseAbs().maxCoeff()));
  }
  add_pair(figure, "0.7, eq. (28)", low, u, v, false);
  add_pair(figure, "1.8, eq. (28)", high, u, v, false);
  add_pair(figure, "1.8, half-lumped", mixed, u, v, false);
  add_pair(figure, "1.8, exact", exact_high, u, v, true);
  artefact.picture(figure);
  artefact.data(
      motion_table({{"energy_0.7", low},
                    {"energy_0.7_exact", exact_low},
                    {"energy_1.8", high},
                    {"energy_1.8_half_lumped", mixed},
                    {"energy_1.8_exact", exact_high}}),
      "position over length, time over period with the middle of the contact at 1/2, displacement over the "
      "gap, velocity over gap times the linear frequency of the continuous rod (rad/s)",
      {discretisation(scene)});
  artefact.caption(fmt::format(
      "One period at energies 0.7 and 1.8: with the paper's mass matrix, eq. (28) (a to d), with a half-lumped one (e, f), "
      "{}; and exact (g, h). Triangles at x/L = 1 are the samples in contact, the bar is the exact contact.",
      discretisation(scene)));
  artefact.note(fmt::format(
      "Relative rms distance from the exact motion, displacement and velocity: {} and {} at energy 0.7; {} and {} at "
      "1.8, {} and {} with half-lumped mass. The exact velocity jumps at fronts that {} harmonics round off.",
      percent(distance(low.displacement, exact_low.displacement), 2),
      percent(distance(low.velocity, exact_low.velocity), 2),
      percent(distance(high.displacement, exact_high.displacement), 2),
      percent(distance(high.velocity, exact_high.velocity), 2),
      percent(distance(mixed.displacement, exact_high.displacement), 2),
      percent(distance(mixed.velocity, exact_high.velocity), 2), scene.analysis.harmonics));
  check_standing(artefact, low);
  claim_duration(artefact, exact_high);
  claim_travelling(artefact, high, exact_high);
  claim_maxima(artefact, high);
  check_form(artefact, low, high);
}

}  // namespace wavebalance::ll10
