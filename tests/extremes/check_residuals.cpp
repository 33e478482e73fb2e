#include "check_residuals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <stdexcept>

#include "period_oracle/shooting.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::extremes {
namespace {

using app::Scene;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXcd spectrum(spectral::RealFft& fft, const Eigen::VectorXd& samples) {
  Eigen::VectorXcd result(fft.harmonics());
  fft.forward({samples.data(), static_cast<std::size_t>(samples.size())},
              {result.data(), static_cast<std::size_t>(result.size())});
  return result;
}

/// Trial coefficients of every degree of freedom, n x (M/2 + 1), by projecting its samples on the trial
/// functions.
Eigen::MatrixXcd coefficients(const solvers::TimePair& pair, const Eigen::MatrixXd& displacements) {
  const solvers::AliasMap index{pair.functions(), pair.points()};
  spectral::RealFft fft(pair.points());
  Eigen::VectorXcd gram, projected;
  index.fold(pair.trial_spectrum(), pair.trial_spectrum(), gram);
  Eigen::MatrixXcd result(displacements.rows(), pair.spectrum_size());
  for (Eigen::Index dof = 0; dof < displacements.rows(); ++dof) {
    index.fold(pair.trial_spectrum(), spectrum(fft, displacements.row(dof)), projected);
    result.row(dof) = projected.cwiseQuotient(gram);
  }
  return result;
}

/// Standard deviation of a coefficient's spectrum, M/2 + 1 values, by that projection of samples with errors
/// of deviation one: large where a trial function has little of a harmonic.
Eigen::VectorXd projected_noise(const solvers::TimePair& pair) {
  const solvers::AliasMap index{pair.functions(), pair.points()};
  Eigen::VectorXcd gram;
  index.fold(pair.trial_spectrum(), pair.trial_spectrum(), gram);
  return (double(pair.points()) * gram.real().cwiseInverse()).cwiseSqrt();
}

double largest(const Eigen::SparseMatrix<double>& matrix) {
  return matrix.nonZeros() == 0
             ? 0.0
             : Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()).cwiseAbs().maxCoeff();
}

/// Weighted contact forces of every contact, C x (M/2 + 1).
Eigen::MatrixXcd projected(const solvers::TimePair& pair, const Eigen::MatrixXd& forces) {
  spectral::RealFft fft(pair.points());
  Eigen::MatrixXcd result(forces.rows(), pair.spectrum_size());
  Eigen::VectorXcd one;
  for (Eigen::Index contact = 0; contact < forces.rows(); ++contact) {
    pair.project(spectrum(fft, forces.row(contact)), one);
    result.row(contact) = one;
  }
  return result;
}

void measure_motion(const Scene& scene, const app::Response& response, Residuals& result) {
  const Eigen::MatrixXd& u = response.structure.displacement;
  const solvers::LinearStructure structure = app::make_model(scene).structure;
  const solvers::TimePair pair = app::make_pair(scene.time);
  const Eigen::MatrixXcd a = coefficients(pair, u);
  const Eigen::MatrixXcd contact = projected(pair, response.contacts.force);
  Eigen::VectorXcd harmonics = Eigen::VectorXcd::Zero(2);
  harmonics[1] = 1.0;
  const Eigen::VectorXcd load = pair.load(harmonics);
  const double f = scene.forcing.frequency;
  const double mass = largest(structure.mass), damping = largest(structure.damping),
               stiffness = largest(structure.stiffness);
  constexpr double deviations = 4.0;  // hardly a coefficient in ten thousand has a larger error
  const Eigen::VectorXd noise =
      deviations * std::numeric_limits<double>::epsilon() * u.cwiseAbs().maxCoeff() * projected_noise(pair);
  double worst = 0.0, scale = 0.0, rounding = 0.0;
  for (int k = 0; k < pair.solved_size(); ++k) {
    const std::array<Eigen::VectorXcd, 3> terms{structure.mass * (pair.symbol(2)[k] * f * f * a.col(k)),
                                                structure.damping * (pair.symbol(1)[k] * f * a.col(k)),
                                                structure.stiffness * (pair.symbol(0)[k] * a.col(k))};
    Eigen::VectorXcd residual = terms[0] + terms[1] + terms[2] - structure.load * load[k];
    residual += structure.contact_directions.transpose() * contact.col(k);
    double size =
        contact.col(k).cwiseAbs().maxCoeff() + structure.load.cwiseAbs().maxCoeff() * std::abs(load[k]);
    for (const auto& term : terms) size += term.cwiseAbs().maxCoeff();
    worst = std::max(worst, residual.cwiseAbs().maxCoeff());
    if (std::isnan(residual.cwiseAbs().sum())) worst = std::numeric_limits<double>::infinity();
    scale = std::max(scale, size);
    rounding = std::max(rounding, noise[k] * (std::abs(pair.symbol(2)[k]) * f * f * mass +
                                              std::abs(pair.symbol(1)[k]) * f * damping +
                                              std::abs(pair.symbol(0)[k]) * stiffness));
  }
  result.motion = scale > 0.0 ? worst / scale : worst;
  result.motion_rounding = scale > 0.0 ? rounding / scale : rounding;
}

/// How far forces are outside of what their laws give within a billionth of the motion about its
/// displacements, over the largest force. Displacements do not resolve a very stiff law any better.
double law_violation(const Scene& scene, const solvers::Motion& contacts) {
  const solvers::ContactLaws laws = app::make_laws(scene);
  const double largest = contacts.force.cwiseAbs().maxCoeff();
  const double near = 1e-9 * contacts.displacement.cwiseAbs().maxCoeff();
  double worst = 0.0;
  for (int contact = 0; contact < contacts.rows(); ++contact)
    for (Eigen::Index l = 0; l < contacts.points(); ++l) {
      const double u = contacts.displacement(contact, l), force = contacts.force(contact, l);
      worst = std::max({worst, force - laws[contact].force(u + near), laws[contact].force(u - near) - force});
    }
  return largest > 0.0 ? worst / largest : worst;
}

double law_or_obstacle_violation(const Scene& scene, const solvers::Motion& contacts) {
  if (scene.contact.law != "rigid") return law_violation(scene, contacts);
  const Eigen::ArrayXXd force = contacts.force.array();
  Eigen::ArrayXXd opening = -contacts.displacement.array();
  for (int contact = 0; contact < contacts.rows(); ++contact)
    opening.row(contact) += contacts_of(scene).at(contact).gap;
  const double largest = force.abs().maxCoeff();
  double span = contacts.displacement.cwiseAbs().maxCoeff();
  // On the obstacle to rounding or to the solver's residual, which is relative to the response without
  // contact.
  Scene free = scene;
  free.contact = {};
  if (const auto motion = solve(free).contacts.displacement; motion.size() > 0)
    span = std::max(span, motion.cwiseAbs().maxCoeff());
  double worst = std::max(0.0, -force.minCoeff()) / (largest > 0.0 ? largest : 1.0);
  if (span > 0.0) worst = std::max(worst, -opening.minCoeff() / span);
  if (largest > 0.0 && span > 0.0)
    worst = std::max(worst, ((force / largest) * (opening / span)).abs().maxCoeff());
  return worst;
}

/// In the force form the law holds at w = v - f / epsilon, and v - u is f / epsilon for all weighting
/// functions.
double complementarity(const Scene& scene, const app::Response& response) {
  if (response.series_flexibility.size() == 0) return law_or_obstacle_violation(scene, response.contacts);
  const solvers::TimePair pair = app::make_pair(scene.time);
  const Eigen::MatrixXcd unknown = response.unknown_coefficients.transpose(),
                         motion = coefficients(pair, response.contacts.displacement);
  const Eigen::MatrixXcd yielded =
      response.series_flexibility.asDiagonal() * projected(pair, response.contacts.force);
  double worst = 0.0, scale = 0.0;
  for (int k = 0; k < pair.solved_size(); ++k) {
    const auto symbol = pair.symbol(0)[k];
    worst =
        std::max(worst, (symbol * (unknown.col(k) - motion.col(k)) - yielded.col(k)).cwiseAbs().maxCoeff());
    scale = std::max(scale,
                     (std::abs(symbol) * (unknown.col(k).cwiseAbs() + motion.col(k).cwiseAbs())).maxCoeff());
  }
  solvers::Motion held = response.contacts;
  solvers::MotionEvaluator evaluate(pair.trial(), static_cast<int>(held.points()));
  held.displacement = evaluate(response.unknown_coefficients, scene.forcing.frequency).displacement -
                      response.series_flexibility.asDiagonal() * held.force;
  return std::max(scale > 0.0 ? worst / scale : 0.0, law_or_obstacle_violation(scene, held));
}

/// Steps follow the fastest mode of the structure: many periods of it take too many.
bool is_slow(const Scene& scene) {
  const auto& structure = scene.structure;
  return scene.forcing.frequency * structure.length <
         0.01 * std::sqrt(structure.youngs_modulus / structure.density);
}

/// They also follow the contact: against a law far stiffer than the bar's elements they take too many.
bool is_stiff(const Scene& scene, double displacement) {
  const auto& structure = scene.structure;
  const double element = structure.youngs_modulus * structure.area / structure.length * structure.elements;
  return !(app::make_law(scene.contact).tangent(std::max(displacement, scene.contact.gap)) <= 1e4 * element);
}

bool can_be_stepped(const Scene& scene, const app::Response& response, int stepped_elements) {
  return scene.structure.type == app::StructureType::bar && !is_slow(scene) && scene.contact.law != "rigid" &&
         !is_stiff(scene, response.displacement().maxCoeff()) && !scene.structure.massless_tip &&
         scene.structure.elements <= stepped_elements && scene.time.trial != "haar" &&
         scene.time.trial != "daubechies2" && scene.time.trial != "daubechies4";
}

double periodicity(const Scene& scene, const solvers::Motion& structure) {
  oracle::ShootingOptions options;
  options.output_points = 2;
  options.settling_periods = 0;
  options.max_iterations = 1;
  options.initial_displacement = structure.displacement.col(0);
  options.initial_velocity = structure.velocity.col(0);
  try {
    const auto result = oracle::shoot(app::make_model(scene).structure, app::make_law(scene.contact),
                                      scene.forcing.frequency, options);
    return result.residual_history.empty() ? missing : result.residual_history.front();
  } catch (const std::invalid_argument&) {
    return missing;  // an undamped structure at a natural frequency of its own
  }
}

bool all_finite(const solvers::Motion& motion) {
  return motion.displacement.allFinite() && motion.velocity.allFinite() && motion.force.allFinite();
}

/// The first condition that a response reported as converged violates; empty if it violates none.
std::string violated_condition(const app::Response& response, const Residuals& found) {
  if (!all_finite(response.leading()) || !all_finite(response.structure))
    return "converged with samples that are not finite";
  if (!(response.residual >= 0.0)) return "converged with a residual that is no number";
  if (!(found.motion <= largest_motion_residual + found.motion_rounding))
    return "converged, the equation of motion does not hold";
  if (!(found.complementarity <= largest_complementarity)) return "converged, complementarity does not hold";
  return "";
}

CheckResult solved_or_not(const Scene& scene, int stepped_elements = 30) {
  CheckResult result;
  const app::Response response = solve(scene);
  if (!response.converged) {
    result.outcome = Outcome::not_converged;
    result.text = response.status;
    return result;
  }
  if (response.structure.empty()) {
    result.text = "converged without a motion";
    return result;
  }
  result.residuals = residuals(scene, response, stepped_elements);
  result.text = violated_condition(response, result.residuals);
  result.outcome = result.text.empty() ? Outcome::solved : Outcome::wrong;
  return result;
}

CheckResult timed(const std::function<CheckResult()>& run) {
  const std::clock_t start = std::clock();
  CheckResult result;
  try {
    result = run();
  } catch (const std::exception& error) {
    result.outcome = Outcome::error;
    result.text = error.what();
  }
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

/// The error without the place where the file lies, which differs from machine to machine.
std::string without_folder(const std::string& text, const std::filesystem::path& scenes) {
  const std::string folder = (scenes / "").string();
  const auto place = text.find(folder);
  return place == std::string::npos ? text : text.substr(0, place) + text.substr(place + folder.size());
}

}  // namespace

bool led_to_what_it_must(const Case& item, const CheckResult& result) {
  const bool solved = result.outcome == Outcome::solved && result.text.empty();
  if (item.must == Outcome::solved || (item.may_be_solved && solved)) return solved;
  if (result.outcome != item.must) return false;
  if (item.named.empty())
    throw std::invalid_argument(
        fmt::format("extremes: \"{}\", {}: must end with {}, but gives no words that the text must hold",
                    item.group, item.scene, to_string(item.must)));
  return result.text.find(item.named) != std::string::npos;
}

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::solved:
      return "solved";
    case Outcome::error:
      return "error";
    case Outcome::not_converged:
      return "not converged";
    case Outcome::wrong:
      break;
  }
  return "wrong";
}

app::Response solve(Scene scene) {
  scene.analysis.output_points = scene.time.quadrature_points;
  app::ResponseOptions options;
  options.structure_points = scene.analysis.output_points;
  return app::weighted_residual_response(scene, options);
}

Residuals residuals(const Scene& scene, const app::Response& response, int stepped_elements) {
  Residuals result;
  measure_motion(scene, response, result);
  result.complementarity = complementarity(scene, response);
  if (can_be_stepped(scene, response, stepped_elements))
    result.periodicity = periodicity(scene, response.structure);
  return result;
}

CheckResult check_residuals(const Scene& scene, int stepped_elements) {
  return timed([&] { return solved_or_not(scene, stepped_elements); });
}

CheckResult check_residuals(const Case& item, const std::filesystem::path& scenes) {
  CheckResult result =
      timed([&] { return solved_or_not(app::load_scene(scenes / item.scene, item.overrides)); });
  result.text = without_folder(result.text, scenes);
  return result;
}

}  // namespace wavebalance::extremes
