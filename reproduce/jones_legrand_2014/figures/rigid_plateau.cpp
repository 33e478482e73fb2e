// The step that JL14 names as its next one: the same bar against a rigid obstacle, compared with the
// penalty law.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
using report::lower;
using report::percent;

namespace {

struct Study {
  Study(report::Artefact& artefact, int case_number);

  int number;
  app::Scene scene;                  ///< with the rigid obstacle
  Case penalty;                      ///< with the exponential law
  std::vector<app::Response> soft;   ///< of pairs(), exponential law
  std::vector<app::Response> rigid;  ///< of pairs()
  app::Response exact;               ///< exact, against the rigid obstacle
};

std::vector<std::string> rigid_overrides(const Pair& pair, int points, bool keeps_nyquist = false) {
  return {"time.trial=" + pair.trial, "time.weight=" + pair.weight,
          fmt::format("time.quadrature_points={}", points),
          std::string("time.nyquist=") + (keeps_nyquist ? "keep" : "drop")};
}

Study::Study(report::Artefact& artefact, int case_number)
    : number(case_number),
      scene(artefact.scene(fmt::format("case{}_rigid.toml", number))),
      penalty(artefact, number),
      soft(penalty.solve_all()) {
  const std::string name = fmt::format("case{}_rigid.toml", number);
  for (const auto& pair : pairs()) {
    rigid.push_back(app::weighted_residual_response(
        artefact.scene(name, rigid_overrides(pair, scene.time.quadrature_points))));
    if (!rigid.back().converged)
      artefact.note(fmt::format("Case {}, {} did not converge ({}) and is not drawn.", number, pair.label,
                                rigid.back().status));
  }
  exact = exact_solution(artefact.scene(fmt::format("reference_case{}_rigid.toml", number)));
}

/// A group of pairs that share panels.
struct Group {
  std::string title;
  std::vector<std::size_t> members;  ///< of pairs()
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{{"Fourier, B-spline", {0, 1}}, {"DB6", {2, 4}}, {"Haar", {3, 5}}};
  return all;
}

app::Panel group_panel(const Study& study, const Group& group, double scale,
                       Eigen::VectorXd (app::Response::*history)() const, const std::string& label) {
  const auto [from, to] = contact_interval(study.penalty, -0.5);
  app::Panel panel;
  const Eigen::VectorXd soft = scale * (study.penalty.reference().*history)(),
                        exact = scale * (study.exact.*history)();
  Values shown{window(soft, from, to), window(exact, from, to)};
  auto rigid = reference_series(exact, -0.5);
  rigid.dash = app::Dash::solid;
  rigid.label = fmt::format("rigid, {}", reference_label);
  panel.add(std::move(rigid));
  for (const std::size_t member : group.members) {
    if (!study.rigid[member].converged) continue;
    const Eigen::VectorXd values = scale * (study.rigid[member].*history)();
    panel.add(report::styled(periodic_series(pairs()[member].label, values, -0.5), pairs()[member].colour,
                             {.width = member == group.members.back() ? 1.1 : 1.6}));
    shown.push_back(window(values, from, to));
  }
  auto exponential = reference_series(soft, -0.5);
  exponential.label = fmt::format("exponential, {}", reference_label);
  panel.add(std::move(exponential));
  panel.x = axis(time_label, from, to);
  panel.y = fitted_axis(label, shown);
  return panel;
}

void add_panels(app::Figure& figure, const Study& study) {
  for (const auto& group : groups()) {
    auto motion = group_panel(study, group, millimetres, &app::Response::displacement, "Displacement (mm)");
    auto force = group_panel(study, group, 1.0 / study.scene.forcing.amplitude, &app::Response::force,
                             "Contact force f_c/F (-)");
    motion.mark_y(millimetres * study.scene.contact.gap);
    motion.title = study.penalty.frequency_text() + ", " + group.title;
    force.title = "the same, force";
    const bool last = study.number == 2 && &group == &groups().back();
    if (!last) {
      motion.x.label.clear();
      force.x.label.clear();
    }
    figure.panels.push_back(std::move(motion));
    figure.panels.push_back(std::move(force));
  }
}

void append_rows(Table& table, const Study& study) {
  const double amplitude = study.scene.forcing.amplitude, gap = study.scene.contact.gap;
  const auto add = [&](const std::string& contact, const std::string& trial, const std::string& weight,
                       const app::Response& response) {
    const Eigen::VectorXd u = response.displacement(), pressure = response.force();
    table.append_row(
        {std::int64_t{study.number}, contact, trial, weight, response.converged, u.maxCoeff() / gap - 1.0,
         response.rigid ? std::max(0.0, response.rigid->max_penetration / gap) : solvers::missing,
         pressure.mean() / amplitude, pressure.maxCoeff() / amplitude,
         app::contact_fraction(response.leading())});
  };
  add("exponential", pairs()[0].trial, pairs()[0].weight, study.soft[0]);
  for (std::size_t i = 0; i < study.rigid.size(); ++i)
    add("rigid", pairs()[i].trial, pairs()[i].weight, study.rigid[i]);
  add("rigid, contact phases", "none", "none", study.exact);
}

/// The force just after contact begins, over the amplitude of the load.
double first_force(const Study& study) {
  constexpr double just = 1e-9;  // of the period
  const solvers::ExactSolution& motion = study.exact.exact->motion;
  const Eigen::VectorXd time = Eigen::VectorXd::Constant(1, motion.intervals.front().begin + just);
  return motion.force(time)(0, 0) / study.scene.forcing.amplitude;
}

void note_forces(report::Artefact& artefact, const Study& study) {
  std::vector<double> largest;
  for (const auto& response : study.rigid)
    if (response.converged) largest.push_back(response.force().maxCoeff() / study.scene.forcing.amplitude);
  const auto [least, most] = std::minmax_element(largest.begin(), largest.end());
  const double first = first_force(study);
  const double drawn = study.exact.force().maxCoeff() / study.scene.forcing.amplitude;
  artefact.note(fmt::format(
      "Case {}: where contact with the rigid obstacle begins the exact force rises to {} F at once. Its largest "
      "value is {} F, of which the {} points of the picture reach {} F. Those of the pairs with 64 functions are {} "
      "to {} F.",
      study.number, report::number(first), report::number(std::max(first, drawn)),
      study.exact.contacts.points(), report::number(drawn), report::number(*least), report::number(*most)));
}

/// Errors of the force of all pairs, over Fourier:Fourier's.
struct RelativeErrors {
  std::vector<double> rms, mean;
};

RelativeErrors beside_fourier(const std::vector<app::Response>& responses, const app::Response& exact) {
  const auto forces = jl14::drawn(responses, &app::Response::force);
  RelativeErrors errors{measured(forces, exact.force(), &app::relative_rms_error),
                        measured(forces, exact.force(), &relative_mean_error)};
  for (auto* list : {&errors.rms, &errors.mean}) {
    const double fourier = list->front();
    for (double& value : *list) value /= fourier;
  }
  return errors;
}

void state_haar_rigid(report::Artefact& artefact, const std::vector<Study>& studies) {
  std::vector<double> soft_rms, soft_mean, rigid_rms, rigid_mean;
  std::string text;
  for (const auto& study : studies) {
    const auto soft = beside_fourier(study.soft, study.penalty.reference()),
               rigid = beside_fourier(study.rigid, study.exact);
    for (const std::size_t i : {3, 5}) {
      if (!study.soft[i].converged || !study.rigid[i].converged) continue;
      soft_rms.push_back(soft.rms[i]), soft_mean.push_back(soft.mean[i]);
      rigid_rms.push_back(rigid.rms[i]), rigid_mean.push_back(rigid.mean[i]);
      text += fmt::format("{}{} at {} {} times, with the exponential law {} times", text.empty() ? "" : "; ",
                          pairs()[i].label, study.penalty.frequency_text(), report::number(rigid.rms[i]),
                          report::number(soft.rms[i]));
    }
  }
  report::Statement statement{
      "section 5.3",
      "It is hypothesized that when a rigid contact law is enforced the Haar scaling functions will perform even "
      "better relative to the other functions; this will be investigated in future work.",
      "the error of the contact force of both Haar pairs over that of Fourier:Fourier is lower against a rigid "
      "obstacle than with the exponential law, rms and mean, in most of both pairs and both cases; errors against "
      "the exact motion of each law",
      "rms error over that of Fourier:Fourier: " + text,
      report::together({lower(rigid_rms, soft_rms), lower(rigid_mean, soft_mean)})};
  const auto [least, most] = std::minmax_element(rigid_rms.begin(), rigid_rms.end());
  const auto [soft_least, soft_most] = std::minmax_element(soft_rms.begin(), soft_rms.end());
  statement.claim = "Haar does better against a rigid obstacle";
  statement.headline = fmt::format(
      "its force error is {} to {} times that of harmonic balance, with the exponential law {} to {} times.",
      report::number(*least, 2), report::number(*most, 2), report::number(*soft_least, 2),
      report::number(*soft_most, 2));
  statement.because =
      "Beside Fourier:Fourier the Haar pairs do not gain everywhere. " + statement.measured + ".";
  artefact.statement(statement);
}

/// How far from the gap the tip is in contact, two cells away from its ends, over the gap.
double distance_from_gap(const Study& study, const app::Response& response) {
  const Mask contact = study.exact.force().array() > 0.0;
  const Eigen::Index n = contact.size(), width = report::parts_at_an_end * n / report::parts_of_period;
  const Mask inside = Mask::NullaryExpr(n, [&](Eigen::Index i) {
    int free = 0;
    for (Eigen::Index j = -width; j <= width; ++j) free += contact[(i + j + n) % n] ? 0 : 1;
    return free == 0;
  });
  const double gap = study.scene.contact.gap;
  return (select(response.displacement(), inside).array() - gap).abs().maxCoeff() / gap;
}

/// Which pairs have a flat plateau with so many points, and how far the others are from the gap.
std::string flatness(report::Artefact& artefact, const std::vector<Study>& studies, int points, bool keeps) {
  std::string flat;
  double worst = 0.0;
  for (const auto& study : studies)
    for (std::size_t i = 0; i < pairs().size(); ++i) {
      const auto response =
          points == study.scene.time.quadrature_points
              ? study.rigid[i]
              : app::weighted_residual_response(artefact.scene(fmt::format("case{}_rigid.toml", study.number),
                                                               rigid_overrides(pairs()[i], points, keeps)));
      const double uneven = response.converged ? distance_from_gap(study, response) : 1.0;
      if (uneven < report::rounding)
        flat += fmt::format("{}{} at {}", flat.empty() ? "" : ", ", pairs()[i].label,
                            study.penalty.frequency_text());
      else if (response.converged)
        worst = std::max(worst, uneven);
    }
  return fmt::format("{} points{}: flat {}, the others up to {} of the gap away", points,
                     keeps ? " and the Nyquist coefficient" : "", flat.empty() ? "none" : flat,
                     percent(worst));
}

void leave_flat(report::Artefact& artefact, const std::vector<Study>& studies) {
  std::string found;
  for (const auto& [points, keeps] : {std::pair{512, false}, std::pair{64, false}, std::pair{64, true}})
    found += (found.empty() ? "" : "; ") + flatness(artefact, studies, points, keeps);
  artefact.unjudged(
      {"section 6",
       "The goal is to improve on the penalty approach by implementing an exact unilateral contact method (e.g. "
       "Lagrange multiplier, LCP, etc.). This should result in perfectly flat contact plateaus within the periodic "
       "response.",
       "It is a hope for future work and names no discretisation. The discretisation decides how flat a plateau is, "
       "not the law alone.",
       found});
}

}  // namespace

void rigid_plateau(report::Artefact& artefact) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 400;
  figure.panel_height = 230;
  figure.title = "Rigid obstacle, 64 functions; black: exact, dashed with the exponential law";
  Table table({"case", "contact", "trial", "weight", "converged", "largest_penetration_over_gap",
               "penetration_at_quadrature_points_over_gap", "mean_force_over_amplitude",
               "largest_force_over_amplitude", "contact_fraction"});
  std::vector<Study> studies;
  for (const int number : {1, 2}) {
    const Study& study = studies.emplace_back(artefact, number);
    add_panels(figure, study);
    append_rows(table, study);
    note_forces(artefact, study);
  }
  artefact.data(table, "without unit");
  artefact.picture(figure);
  artefact.caption(
      "The paper's next step, rigid (Signorini) contact, with the six pairs (64 functions, 512 points, the tip's mass "
      "moved to its neighbour), and the exact motions with it and with the exponential law.");
  state_haar_rigid(artefact, studies);
  leave_flat(artefact, studies);
}

}  // namespace wavebalance::jl14
