#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "sums_choices.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/report/rule.hpp"

namespace wavebalance::jl14 {
using report::lower;
using report::percent;

namespace {

/// Errors of the contact force of all pairs under one reading.
struct ForceErrors {
  std::vector<double> rms, mean;
};

ForceErrors force_errors(const Case& study, const Readings& readings, std::size_t i) {
  const auto forces = readings.values(i, &app::Response::force);
  const Eigen::VectorXd reference = study.reference().force();
  return {measured(forces, reference, &app::relative_rms_error),
          measured(forces, reference, &relative_mean_error)};
}

void check_duration(report::Artefact& artefact, const Case& study,
                    const std::vector<app::Response>& responses) {
  int same = 0;
  std::vector<double> shares;
  for (const auto& response : responses) {
    const Mask force = response.force().array() > 0.0,
               plateau = response.displacement().array() > study.gap();
    same += (force == plateau).all() ? 1 : 0;
    shares.push_back(force.cast<double>().mean());
  }
  artefact.check(
      {"section 5.3",
       "Notice the time duration of the contact forces coincide with the tip displacement plateaus of Fig. 6 as "
       "this is the only period during which the tip is in contact with the rigid foundation.",
       "eq. (5) makes the two the same: there is a force where, and only where, the displacement is beyond the gap",
       fmt::format("true of {} pairs; in contact during {} of the period, the reference {}",
                   same == static_cast<int>(responses.size()) ? "all six" : fmt::format("{} of six", same),
                   listed(pairs(), shares), percent(app::contact_fraction(study.reference().contacts))),
       same == static_cast<int>(responses.size())});
}

void state_force_ringing(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const Eigen::VectorXd reference = study.reference().force();
  const auto found = judged(readings, {"fourier_fourier", "bspline_bspline"}, [&](std::size_t i) {
    const auto forces = readings.values(i, &app::Response::force);
    const double exact = total_variation(reference);
    return Finding{report::together({lower({exact}, {total_variation(forces[0])}),
                                     lower({exact}, {total_variation(forces[1])})}),
                   "excess variation " + listed(pairs(), measured(forces, reference, &excess_variation))};
  });
  report::Statement statement{
      "section 5.3", "The effect of Gibbs phenomenon can be seen in the HBM and Galerkin B-spline cases.",
      "the contact force of both varies more over the period than that of the reference (sum of all changes)"};
  const auto excess = measured(readings.values(0, &app::Response::force), reference, &excess_variation);
  const auto more = std::count_if(excess.begin(), excess.end(), [&](double one) { return one > excess[1]; });
  statement.because = spread(found) + ".";
  artefact.note(fmt::format(
      "Gibbs phenomenon does not set Fourier:Fourier and B-spline:B-spline apart: with points at left ends {} of the {} "
      "pairs have a higher excess variation of the force than B-spline:B-spline.",
      more, excess.size()));
  statement.panel = "(a), (d)";
  artefact.statement(concluded(statement, found));
}

void state_haar_force(report::Artefact& artefact, const Case& study, const Readings& readings) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  const auto found = judged(readings, {"haar_fourier", "haar_bspline"}, [&](std::size_t i) {
    const auto [rms, mean] = force_errors(study, readings, i);
    if (all_sums()[i].of_text()) {
      least = std::min({least, rms[3], rms[5]});
      most = std::max({most, rms[3], rms[5]});
    }
    return Finding{both_within_twice({rms[3], rms[5]}, {mean[3], mean[5]}, rms[0], mean[0]),
                   "rms error " + listed(pairs_named({"haar_fourier", "haar_bspline", "fourier_fourier"}),
                                         {rms[3], rms[5], rms[0]})};
  });
  report::Statement statement{
      "section 5.3",
      "The cases where Haar trial functions are used approximate the contact force relatively well.",
      fmt::format("both Haar pairs have at most {:g} times the error of Fourier:Fourier, rms and mean",
                  report::similar_factor)};
  statement.because = fmt::format(
      "The law is steep, so that a saw tooth of the displacement within its penetration becomes one of the whole "
      "force. With points at left ends and at mid-points, which the text allows, the two pairs have errors of {} to {}.",
      percent(least), percent(most));
  statement.claim = "Haar gives the contact force relatively well";
  statement.headline = fmt::format("its error is {} to {}, that of harmonic balance {}.", percent(least, 2),
                                   percent(most, 2), percent(force_errors(study, readings, 0).rms[0], 2));
  statement.panel = "(c), (e)";
  artefact.statement(concluded(statement, found));
}

void state_daubechies_force(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto found = judged(readings, {}, [&](std::size_t i) {
    const auto [rms, mean] = force_errors(study, readings, i);
    return daubechies_lowest(rms, mean);
  });
  const auto& force = readings.at(0, "daubechies6_daubechies6").force();
  const auto& spline = readings.at(0, "bspline_bspline").force();
  const Eigen::VectorXd exact = study.reference().force();
  report::Statement statement{
      "section 5.3",
      "Again, the DB6 trial functions appear to most accurately approximate the contact forces compared to the "
      "other cases.",
      "the lower error of the two pairs with DB6 trial functions is lower than the lowest of the other four, rms "
      "and mean of the error of the force"};
  statement.because = "The best of them is not one of the DB6 pairs by both measures.";
  const auto [rms, mean] = force_errors(study, readings, 0);
  statement.claim = "DB6 gives the contact force best";
  statement.headline =
      fmt::format("the mean error is {}, the next best {}; rms {} and {}.",
                  percent(lowest_of("daubechies6", mean), 2), percent(lowest_without_daubechies(mean), 2),
                  percent(lowest_of("daubechies6", rms)), percent(lowest_without_daubechies(rms)));
  artefact.note(fmt::format(
      "The short spikes at the beginning of contact go into the rms error of the force with their squares. The largest "
      "force of DB6:DB6 is {} of that of the reference, that of B-spline:B-spline {}.",
      percent(force.maxCoeff() / exact.maxCoeff(), 4), percent(spline.maxCoeff() / exact.maxCoeff(), 4)));
  statement.panel = "(b), (f)";
  artefact.statement(concluded(statement, found));
}

void state_abstract(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const std::vector<std::size_t> mixed{3, 4, 5};
  const auto found = judged(readings, {"haar_fourier", "haar_bspline"}, [&](std::size_t i) {
    const auto [rms, mean] = force_errors(study, readings, i);
    std::vector<report::Verdict> parts;
    for (const std::size_t k : mixed)
      parts.push_back(report::together({lower({rms[k]}, {rms[0]}), lower({mean[k]}, {mean[0]})}));
    return Finding{report::together(parts),
                   fmt::format("rms {}; mean {}", listed(pairs(), rms), listed(pairs(), mean))};
  });
  const auto errors = force_errors(study, readings, 0);
  std::string better, worse;
  for (const std::size_t k : mixed) {
    auto& list = errors.rms[k] < errors.rms[0] ? better : worse;
    list += (list.empty() ? "" : ", ") + pairs()[k].label;
  }
  report::Statement statement{
      "abstract", "and seemingly more accurate contact force prediction.",
      "each of the three Petrov-Galerkin pairs has a lower error of the force than Fourier:Fourier, rms and mean"};
  statement.because =
      fmt::format("With points at left ends more accurate than Fourier:Fourier (rms): {}; less accurate: {}.",
                  better.empty() ? "none" : better, worse.empty() ? "none" : worse);
  statement.panel = "(b), (c), (e)";
  artefact.statement(concluded(statement, found));
}

/// Errors of displacement, velocity and force, rms and mean, of all pairs in both cases: one list per
/// measure.
std::vector<std::vector<double>> all_errors(const Case& study, const Readings& readings, std::size_t i) {
  std::vector<std::vector<double>> errors;
  const auto add = [&](Eigen::VectorXd (app::Response::*history)() const) {
    const Eigen::VectorXd reference = (study.reference().*history)();
    const auto values = readings.values(i, history);
    errors.push_back(measured(values, reference, &app::relative_rms_error));
    errors.push_back(measured(values, reference, &relative_mean_error));
  };
  add(&app::Response::displacement);
  add(&app::Response::velocity);
  add(&app::Response::force);
  return errors;
}

void state_conclusions(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const Case other(artefact, 2);
  const Readings there(artefact, other);
  const auto found = judged(
      [&](std::size_t i) {
        auto errors = all_errors(study, readings, i);
        for (auto& one : all_errors(other, there, i)) errors.push_back(std::move(one));
        std::vector<report::Verdict> parts;
        std::string text;
        for (const std::string trial : {"haar", "daubechies6"}) {
          std::size_t comparable = 0, better = 0;
          for (const auto& error : errors) {
            const double own = lowest_of(trial, error), fourier = error[0];
            comparable += within_twice({own}, {fourier}) == report::Verdict::agrees ? 1 : 0;
            better += lower({own}, {fourier}) == report::Verdict::agrees ? 1 : 0;
          }
          parts.push_back(report::mostly(comparable, errors.size()));
          parts.push_back(report::plain(better > 0));
          text += fmt::format("{}{} comparable in {} and better in {} of {}", text.empty() ? "" : "; ",
                              trial == "haar" ? "Haar" : "DB6", comparable, better, errors.size());
        }
        return Finding{report::together(parts), text};
      },
      [](std::size_t) { return std::string(); });
  report::Statement statement{
      "section 6",
      "As expected, Fourier functions perform well as a trial basis, though nonsmooth functions such as Haar and "
      "Daubechies scaling functions are also attractive since they provide comparable prediction accuracy and even "
      "out perform the Fourier functions in some measures.",
      fmt::format(
          "of Haar and of DB6 trial functions, the better of their two pairs: in most of 12 measures (rms "
          "and mean error of displacement, velocity and force, at 150 and at 1275 Hz) at most {:g} times "
          "the error of Fourier:Fourier, and in some a lower one",
          report::similar_factor)};
  statement.because =
      "One of the two kinds of functions is not comparable in most of the measures, or better in none.";
  artefact.statement(concluded(statement, found));
}

}  // namespace

void fig09(report::Artefact& artefact) {
  Case study(artefact, 1);
  const double amplitude = study.scene().forcing.amplitude;
  const Eigen::VectorXd reference = study.reference().force() / amplitude;
  const auto responses = study.solve_all();
  auto forces = drawn(responses, &app::Response::force);
  for (auto& force : forces) force /= amplitude;
  artefact.data(comparison_table(study.time(), reference, forces),
                "time in periods, contact forces divided by the amplitude F of the external force",
                {fmt::format("64 functions; reference: {}", reference_label)});
  artefact.picture(
      pair_rows("Contact force at 150 Hz, 64 functions", {0.01, 0.03, {}},
                pair_view({forces, reference, -0.17, 0.17, "Contact force f_c/F (-)", {}}, true)));
  artefact.caption(
      "64 functions at 150 Hz, about the contact; there is no force in the rest of the period. The force is "
      "eq. (5) of the predicted displacement. (c) and (e) have a scale of their own.");
  const Readings readings(artefact, study);
  check_duration(artefact, study, responses);
  state_force_ringing(artefact, study, readings);
  state_haar_force(artefact, study, readings);
  state_daubechies_force(artefact, study, readings);
  state_abstract(artefact, study, readings);
  state_conclusions(artefact, study, readings);
  attach_sums(artefact, study, readings,
              {.label = "Contact force over F",
               .history = &app::Response::force,
               .scale = 1.0 / amplitude,
               .from = -0.17,
               .to = 0.17});
  refer_to_readings(artefact);
}

}  // namespace wavebalance::jl14
