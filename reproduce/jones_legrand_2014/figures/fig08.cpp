#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <complex>
#include <numbers>

#include "curve_measures.hpp"
#include "figures.hpp"
#include "jl14.hpp"
#include "readings.hpp"
#include "sums_choices.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/report/rule.hpp"
#include "wavebalance/spectral/fft.hpp"
#include "wavebalance/wavelets/fast_transform.hpp"
#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::jl14 {
using report::lower;
using report::number;
using report::percent;

namespace {

constexpr int velocity_cells = report::parts_of_period;
constexpr int paper_points = 256;

/// Velocities of all pairs and of the reference at the same instants.
struct Velocities {
  Values pairs;
  Eigen::VectorXd reference;
  Mask contact;  ///< of the reference
};

/// The derivative of the trial functions, eq. (34).
Velocities differentiated(const Case& study, const Readings& readings, std::size_t i) {
  return {readings.values(i, &app::Response::velocity), study.reference().velocity(),
          study.reference().force().array() > 0.0};
}

/// Differences of 256 values of the displacement; pairs with Haar trial functions keep their jumps.
Velocities differenced(const Case& study, const Readings& readings, std::size_t i) {
  Velocities result;
  const auto u = readings.values(i, &app::Response::displacement);
  const auto v = readings.values(i, &app::Response::velocity);
  const double period = 1.0 / study.scene().forcing.frequency;
  for (std::size_t k = 0; k < u.size(); ++k)
    result.pairs.push_back(has_haar_trial(readings.chosen()[k])
                               ? thinned(v[k], paper_points)
                               : central_differences(u[k], paper_points, period));
  result.reference = thinned(study.reference().velocity(), paper_points);
  result.contact = thinned(study.reference().force(), paper_points).array() > 0.0;
  return result;
}

/// Findings under all sums and both ways to a velocity, of which the text has the derivative.
std::vector<report::Reading> judged_velocities(const Case& study, const Readings& readings,
                                               const std::vector<std::string>& needed,
                                               const std::function<Finding(const Velocities&)>& judge) {
  std::vector<report::Reading> all;
  for (const bool differences : {false, true}) {
    auto found = judged(readings, needed, [&](std::size_t i) {
      return judge(differences ? differenced(study, readings, i) : differentiated(study, readings, i));
    });
    for (auto& reading : found) {
      reading.name += differences ? ", differences" : ", differentiated";
      reading.of_text = reading.of_text && !differences;
      all.push_back(std::move(reading));
    }
  }
  std::stable_partition(all.begin(), all.end(), [](const report::Reading& one) { return one.of_text; });
  return all;
}

double largest_jump(const Eigen::VectorXd& v) {
  return largest_change(v, static_cast<int>(v.size()) / velocity_cells) / v.cwiseAbs().maxCoeff();
}

/// Every motion with contact has the jump, and every approximation by smooth functions rings at it.
void check_jump(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto free = app::weighted_residual_response(artefact.scene("case1.toml", {"contact.gap=1"}));
  const double without = largest_jump(free.velocity());
  const Velocities v = differentiated(study, readings, 0);
  std::vector<double> jumps;
  for (const auto& one : v.pairs)
    if (one.allFinite()) jumps.push_back(largest_jump(one));
  artefact.check(
      {"section 5.2",
       "It is visible from these approximations that there is a sharp jump in velocity due to the contact "
       "condition.",
       fmt::format("the largest change of velocity within 1/{} of the period, over its maximum, is higher "
                   "than without contact, in most of the six pairs",
                   report::parts_of_period),
       fmt::format("it changes by {} to {} of its maximum, without contact by {}",
                   percent(*std::min_element(jumps.begin(), jumps.end())),
                   percent(*std::max_element(jumps.begin(), jumps.end())), percent(without)),
       lower(std::vector<double>(jumps.size(), without), jumps) == report::Verdict::agrees});
  artefact.check(
      {"section 5.2",
       "As expected, this results in ringing due to Gibbs phenomenon when the Fourier trial functions are used.",
       "the velocity of Fourier:Fourier varies more over the period than that of the reference (sum of all changes)",
       fmt::format("{} more", percent(excess_variation(v.pairs[0], v.reference))),
       total_variation(v.pairs[0]) > total_variation(v.reference)});
}

double excess(const Eigen::VectorXd& v, const Eigen::VectorXd& reference) {
  return std::max(0.0, excess_variation(v, reference));
}

/// In contact, two cells away from both ends.
Mask core(const Mask& contact) {
  const Eigen::Index n = contact.size(), width = report::parts_at_an_end * n / velocity_cells;
  return Mask::NullaryExpr(n, [&](Eigen::Index i) {
    for (Eigen::Index j = -width; j <= width; ++j)
      if (!contact[(i + j + n) % n]) return false;
    return true;
  });
}

void state_bspline_ringing(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto found = judged_velocities(study, readings, {}, [](const Velocities& v) {
    const Mask inside = core(v.contact);
    const auto error = [&](std::size_t k) { return select(v.pairs[k] - v.reference, inside); };
    const double hbm = app::rms(error(0)), spline = app::rms(error(1));
    return Finding{
        report::together({lower({excess(v.pairs[0], v.reference)}, {excess(v.pairs[1], v.reference)}),
                          lower({hbm}, {spline}),
                          lower({error(0).cwiseAbs().mean()}, {error(1).cwiseAbs().mean()})}),
        fmt::format("excess variation {} against {}, rms error within the plateau {} against {} mm/s",
                    percent(excess(v.pairs[1], v.reference)), percent(excess(v.pairs[0], v.reference)),
                    number(1e3 * spline), number(1e3 * hbm))};
  });
  report::Statement statement{
      "section 5.2", "Interestingly, the ringing is more pronounced in the Galerkin B-spline case.",
      "the excess variation of B-spline:B-spline over the reference is higher than that of Fourier:Fourier, and so "
      "are rms and mean of the error within the plateau"};
  statement.because =
      "The measures part: the velocity of B-spline:B-spline varies about as much, and its error within the plateau is the "
      "lower one.";
  statement.panel = "(a), (d)";
  artefact.statement(concluded(statement, found));
}

void state_daubechies_velocity(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto found = judged_velocities(study, readings, {}, [](const Velocities& v) {
    return daubechies_lowest(measured(v.pairs, v.reference, &app::relative_rms_error),
                             measured(v.pairs, v.reference, &relative_mean_error));
  });
  report::Statement statement{
      "section 5.2", "The DB6 trial functions appear to do the best job of approximating the tip response.",
      "the lower error of the two pairs with DB6 trial functions is lower than the lowest of the other four, rms "
      "and mean of the error of the velocity"};
  const auto differences = std::find_if(found.begin(), found.end(), [](const report::Reading& one) {
    return one.name == all_sums()[0].name() + ", differences";
  });
  statement.because = fmt::format(
      "The derivative of a Daubechies function is rough: the more points it is drawn at, the more of that is in the "
      "error. Differentiated, as eq. (34) says, the errors are {}. As differences of the displacement at {} points "
      "they would be {}.",
      found.front().measured, paper_points, differences->measured);
  statement.panel = "(b), (f)";
  artefact.statement(concluded(statement, found));
}

void state_haar_velocity(report::Artefact& artefact, const Case& study, const Readings& readings) {
  const auto edges = [](const Eigen::VectorXd& values) { return thinned(values, velocity_cells); };
  const Eigen::VectorXd reference = edges(study.reference().velocity());
  const auto found = judged(readings, {"haar_fourier", "haar_bspline"}, [&](std::size_t i) {
    const auto v = readings.values(i, &app::Response::velocity);
    const auto rms = measured({edges(v[3]), edges(v[5]), edges(v[0])}, reference, &app::relative_rms_error);
    const auto mean = measured({edges(v[3]), edges(v[5]), edges(v[0])}, reference, &relative_mean_error);
    return Finding{
        both_within_twice({rms[0], rms[1]}, {mean[0], mean[1]}, rms[2], mean[2]),
        "rms error " + listed(pairs_named({"haar_fourier", "haar_bspline", "fourier_fourier"}), rms)};
  });
  report::Statement statement{
      "section 5.2",
      "For cases involving Haar trial functions the velocity function envelope is reasonably approximated by the "
      "delta function representation discussed above.",
      fmt::format(
          "at the cell edges, where the jumps stand, both Haar pairs have at most {} times the error of "
          "Fourier:Fourier, rms and mean",
          number(report::similar_factor))};
  statement.because =
      "A jump between cells divided by the cell width passes the saw tooth of the displacement on to the velocity, "
      "enlarged, and how large it is depends on the sums.";
  statement.panel = "(c), (e)";
  artefact.statement(concluded(statement, found));
}

/// Coefficients of an orthonormal basis of as many values as there are samples.
Eigen::VectorXd fourier_coefficients(const Eigen::VectorXd& values) {
  const auto n = static_cast<std::size_t>(values.size());
  std::vector<std::complex<double>> spectrum(n / 2 + 1);
  spectral::RealFft(static_cast<int>(n)).forward({values.data(), n}, spectrum);
  Eigen::VectorXd coefficients(values.size());
  coefficients[0] = spectrum.front().real();
  coefficients[values.size() - 1] = spectrum.back().real();
  for (std::size_t k = 1; k < n / 2; ++k) {
    coefficients[static_cast<Eigen::Index>(2 * k - 1)] = std::numbers::sqrt2 * spectrum[k].real();
    coefficients[static_cast<Eigen::Index>(2 * k)] = std::numbers::sqrt2 * spectrum[k].imag();
  }
  return coefficients;
}

Eigen::VectorXd wavelet_coefficients(const Eigen::VectorXd& values, int filter) {
  const int levels = std::countr_zero(static_cast<unsigned>(values.size()));
  return wavelets::FastWaveletTransform(wavelets::daubechies_filter(filter)).analysis(values, levels);
}

void state_sparse(report::Artefact& artefact, const Case& study) {
  std::vector<double> fourier, haar, daubechies;
  std::string text;
  const auto count = [&](const std::string& name, const Eigen::VectorXd& values) {
    for (const double share : {report::tie_share, report::visible_share}) {
      fourier.push_back(coefficients_needed(fourier_coefficients(values), share));
      haar.push_back(coefficients_needed(wavelet_coefficients(values, 2), share));
      daubechies.push_back(coefficients_needed(wavelet_coefficients(values, 6), share));
      text += fmt::format("{}{} to {}: Fourier {}, Haar {}, DB6 {}", text.empty() ? "" : "; ", name,
                          percent(share), fourier.back(), haar.back(), daubechies.back());
    }
  };
  count("velocity", study.reference().velocity());
  count("contact force", study.reference().force());
  report::Statement statement{
      "section 3.2",
      "These localized characteristics, or compact support, allow sparse representation of piecewise signals "
      "including transients and singularities [22].",
      fmt::format(
          "of the 1024 samples of the reference at 150 Hz, velocity and contact force, fewer of the largest "
          "coefficients are needed for an rms error of {} and of {} with Haar and with DB6 wavelets (full "
          "transforms) than with Fourier functions, in most of the four",
          percent(report::tie_share), percent(report::visible_share)),
      text, report::together({lower(haar, fourier), lower(daubechies, fourier)})};
  const auto fewer = [&](const std::vector<double>& counts) {
    int number = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) number += counts[i] < fourier[i] ? 1 : 0;
    return number;
  };
  statement.because = fmt::format(
      "Haar wavelets need fewer coefficients than Fourier functions in {} of {}, DB6 in {}. Wavelets gain where a "
      "signal is zero or constant for a while, not where it is smooth throughout.",
      fewer(haar), fourier.size(), fewer(daubechies));
  artefact.statement(statement);
}

app::Figure velocity_figure(const Case& study, const Values& u, const Values& v) {
  PairView view{v, study.reference().velocity(), -0.5, 0.5, "Velocity (m/s)", {}};
  auto whole = pair_view(view, false);
  view.from = -0.17, view.to = 0.17;
  auto contact = pair_view(view, true);
  const double period = 1.0 / study.scene().forcing.frequency;
  const auto chosen = panel_pairs();
  const auto displacements = in_panels(u);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i].trial != "daubechies6") continue;
    auto series = periodic_series("differences of 256 values",
                                  central_differences(displacements[i], paper_points, period), -0.5);
    series.colour = app::Colour::grey;
    contact[i].add(std::move(series));
    contact[i].texts.push_back({-0.02, -0.85, "grey: differences of 256 values"});
  }
  return pair_rows("Tip velocity at 150 Hz, 64 functions", {-0.17, -1.25, {}}, std::move(whole),
                   std::move(contact), "the same, about the contact");
}

}  // namespace

void fig08(report::Artefact& artefact) {
  Case study(artefact, 1);
  const auto responses = study.solve_all();
  const auto v = drawn(responses, &app::Response::velocity);
  artefact.data(comparison_table(study.time(), study.reference().velocity(), v),
                "time in periods, velocities in m/s",
                {fmt::format("64 functions; reference: {}", reference_label)});
  artefact.picture(velocity_figure(study, drawn(responses, &app::Response::displacement), v));
  artefact.caption(
      "64 functions at 150 Hz. Haar trial functions: the jump between neighbouring cells divided by the cell "
      "width, placed at the cell edge. Right, grey in (b) and (f): differences of 256 values of the displacement; "
      "(c) and (e) have a scale of their own.");
  const Readings readings(artefact, study);
  check_jump(artefact, study, readings);
  state_bspline_ringing(artefact, study, readings);
  state_daubechies_velocity(artefact, study, readings);
  state_haar_velocity(artefact, study, readings);
  state_sparse(artefact, study);
  artefact.note(
      "Velocities are derivatives of the trial functions, eq. (34), at 1024 points. Central differences of the "
      "displacement at 256 points stand beside them.");
  attach_sums(artefact, study, readings,
              {.label = "Velocity (m/s)", .history = &app::Response::velocity, .from = -0.17, .to = 0.17});
  refer_to_readings(artefact);
}

}  // namespace wavebalance::jl14
