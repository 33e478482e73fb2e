// The step that JL14 names as its next one: the same bar against a rigid obstacle, beside the penalty law.
#include <fmt/format.h>

#include <cmath>

#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
using app::Colour;

namespace {

struct Study {
  int number;
  app::Scene scene;
  std::vector<app::Response> rigid;  ///< in the order of pairs()
  app::Response penalty;             ///< Fourier:Fourier, exponential law
};

Study studied(report::Artefact& artefact, int number) {
  const std::string name = "case" + std::to_string(number);
  Study study{number, artefact.scene(name + "_rigid.toml"), {}, {}};
  study.penalty = app::weighted_residual_response(artefact.scene(name + ".toml"));
  for (const auto& pair : pairs()) {
    study.rigid.push_back(app::weighted_residual_response(
        artefact.scene(name + "_rigid.toml", {"time.trial=" + pair.trial, "time.weight=" + pair.weight})));
    if (!study.rigid.back().converged)
      artefact.note(fmt::format("Case {}, {} did not converge ({}) and is not drawn.", number, pair.label,
                                study.rigid.back().status));
  }
  return study;
}

Series centred(const std::string& label, const Eigen::VectorXd& values, Colour colour) {
  auto series = periodic_series(label, values, -0.5);
  series.colour = colour;
  return series;
}

void add_panels(app::Figure& figure, const Study& study) {
  const double gap = millimetres * study.scene.contact.gap;
  const bool first = study.number == 1;
  const std::size_t place = figure.panels.size();
  figure.panels.resize(place + 2);
  auto& motion = figure.panels[place];
  auto& force = figure.panels[place + 1];
  motion.title = "case " + std::to_string(study.number) + ", tip displacement";
  force.title = "case " + std::to_string(study.number) + ", contact force";
  motion.x = force.x = first ? axis("Time (fraction of a period)", -0.16, 0.16)
                             : axis("Time (fraction of a period)", 0.01, 0.15);
  motion.y = axis("Displacement (mm)", (first ? 0.97 : 0.93) * gap, (first ? 1.022 : 1.055) * gap);
  force.y = axis("Force over amplitude", 0.0, first ? 0.4 : 12.0);
  const double scale = 1.0 / study.scene.forcing.amplitude;
  auto penalty = centred("", millimetres * study.penalty.displacement(), Colour::black);
  penalty.dash = app::Dash::dashed;
  auto penalty_force = centred("exponential law", scale * study.penalty.force(), Colour::black);
  penalty_force.dash = app::Dash::dashed;
  motion.legend = app::Legend::none;
  force.legend = first ? app::Legend::none : app::Legend::top_right;
  motion.add(penalty).mark_y(gap);
  force.add(penalty_force);
  for (std::size_t i = 0; i < study.rigid.size(); ++i) {
    if (!study.rigid[i].converged) continue;
    const auto& pair = pairs()[i];
    motion.add(centred("", millimetres * study.rigid[i].displacement(), pair.colour));
    force.add(centred("rigid, " + pair.label, scale * study.rigid[i].force(), pair.colour));
  }
}

void append(Table& table, const Study& study) {
  const double amplitude = study.scene.forcing.amplitude, gap = study.scene.contact.gap;
  const auto add = [&](const std::string& contact, const Pair& pair, const app::Response& response) {
    const Eigen::VectorXd u = response.displacement(), pressure = response.force();
    const double missing = std::nan("");
    table.append_row({std::int64_t{study.number}, contact, pair.trial, pair.weight, response.converged,
                      u.maxCoeff() / gap - 1.0,
                      response.rigid ? std::max(0.0, response.rigid->max_penetration / gap) : missing,
                      pressure.mean() / amplitude, pressure.maxCoeff() / amplitude,
                      app::contact_fraction(response.leading())});
  };
  add("exponential", pairs()[0], study.penalty);
  for (std::size_t i = 0; i < study.rigid.size(); ++i) add("rigid", pairs()[i], study.rigid[i]);
}

}  // namespace

void rigid_plateau(report::Artefact& artefact) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 360;
  Table table({"case", "contact", "trial", "weight", "converged", "largest_penetration_over_gap",
               "penetration_at_quadrature_points_over_gap", "mean_force_over_amplitude",
               "largest_force_over_amplitude", "contact_fraction"});
  for (const int number : {1, 2}) {
    const Study study = studied(artefact, number);
    add_panels(figure, study);
    append(table, study);
    double worst = 0.0;
    for (const auto& response : study.rigid)
      worst = std::max(worst, response.displacement().maxCoeff() / study.scene.contact.gap - 1.0);
    artefact.note(fmt::format(
        "Case {}: the exponential law lets the tip {} of the gap beyond it, the rigid obstacle up to {}: the "
        "discretisation error of 64 functions.",
        number, report::percent(study.penalty.displacement().maxCoeff() / study.scene.contact.gap - 1.0, 2),
        report::percent(worst, 2)));
  }
  artefact.data(table, "without unit");
  artefact.picture(figure);
  artefact.caption(
      "The paper's next step, rigid (Signorini) contact, with the six pairs (64 functions, 512 points, the "
      "tip's mass moved to its neighbour) beside the exponential law of the paper.");
}

}  // namespace wavebalance::jl14
