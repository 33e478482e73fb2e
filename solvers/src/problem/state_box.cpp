#include "problem/state_box.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "linalg/dense.hpp"
#include "period/modal_flow.hpp"
#include "problem/motion_samples.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The displacements of all degrees of freedom under the static loads only, with the contacts that they
// close; at rest where that is not found.
Eigen::VectorXd standing(ContactProblem& problem) {
  CondensedProblem& condensed = problem.condensed();
  condensed.set_load_scale(0.0);
  const PeriodicResponse held = forced_response(condensed, problem.laws(), {});
  Eigen::VectorXd displacement = Eigen::VectorXd::Zero(problem.structure().size());
  if (held.converged()) displacement = structure_motion(condensed, held, 1).displacement.col(0);
  condensed.set_load_scale(condensed.full_load());
  return displacement;
}

// The motion about its mean.
Motion vibration_of(Motion motion) {
  motion.displacement.colwise() -= Eigen::VectorXd(motion.displacement.rowwise().mean());
  return motion;
}

// Factor of a vibration so that its displacements reach a gap from the static deflection.
double factor_to_gap(const ContactProblem& problem, const Eigen::VectorXd& stands, const Motion& vibration) {
  const Eigen::SparseMatrix<double>& directions = problem.structure().contact_directions;
  const Eigen::VectorXd gaps = problem.laws().gaps(problem.contacts()) - directions * stands;
  const Eigen::VectorXd largest = (directions * vibration.displacement).cwiseAbs().rowwise().maxCoeff();
  double factor = std::numeric_limits<double>::infinity();
  for (Eigen::Index c = 0; c < gaps.size(); ++c)
    if (gaps[c] > 0.0 && largest[c] > 0.0) factor = std::min(factor, gaps[c] / largest[c]);
  return std::isfinite(factor) ? std::max(1.0, factor) : 1.0;
}

// Contribution of the contacts to the squared frequency of a mode, or to the stiffness of a shape, in
// vibration about the static deflection: their force in its first harmonic, over the amplitude.
double added_stiffness(const ContactProblem& problem, const Eigen::VectorXd& contacts_stand,
                       const Eigen::VectorXd& shape, double amplitude) {
  constexpr int points = 64;
  const Eigen::RowVectorXd cosine =
      Eigen::RowVectorXd::LinSpaced(points, 0.0, 2.0 * std::numbers::pi * (1.0 - 1.0 / points)).array().cos();
  const Eigen::MatrixXd motion = (amplitude * shape * cosine).colwise() + contacts_stand;
  return 2.0 / (points * amplitude) * shape.dot(problem.laws().force(motion) * cosine.transpose());
}

// The largest amplitude between two at which a shape of the stiffness `square` has that which its mass times
// the square of a frequency makes, `wanted`; 0 without one.
double resonant_amplitude(const ContactProblem& problem, const Eigen::VectorXd& contacts_stand,
                          const Eigen::VectorXd& shape, double square, double wanted, double least,
                          double most) {
  constexpr double step = 1.25;
  double found = 0.0, before = square - wanted;
  for (double amplitude = least; amplitude < step * most; amplitude *= step) {
    const double now = square + added_stiffness(problem, contacts_stand, shape, amplitude) - wanted;
    if (std::isnan(now)) break;
    if ((now > 0.0) != (before > 0.0)) found = amplitude;
    before = now;
    if (std::isinf(now)) break;
  }
  return found;
}

// The amplitudes of the modes in a harmonic of a motion uniform over the period.
Eigen::VectorXcd amplitudes_of(const Eigen::MatrixXd& modes, int harmonic) {
  const double points = double(modes.cols());
  Eigen::VectorXcd wave(modes.cols());
  for (Eigen::Index l = 0; l < modes.cols(); ++l)
    wave[l] = std::polar(2.0 / points, -2.0 * std::numbers::pi * harmonic * double(l) / points);
  return modes * wave;
}

// The structure by its modes, and the vibration without contact in a harmonic of the load.
struct ModalVibration {
  Eigen::MatrixXd contacts;     // C x m, displacements of the contacts in each mode
  Eigen::MatrixXd damping;      // m x m
  Eigen::VectorXd squares;      // m, of the frequencies in radians
  double omega = 0.0;           // rad/s, of the harmonic
  Eigen::VectorXcd amplitudes;  // m

  // The load along a shape, which follows from the vibration.
  std::complex<double> load(const Eigen::VectorXd& shape) const {
    const Eigen::VectorXcd load = (squares.array() - omega * omega).matrix().cwiseProduct(amplitudes) +
                                  std::complex<double>(0.0, omega) * (damping * amplitudes);
    return shape.cast<std::complex<double>>().dot(load);
  }
  // The most that a shape can vibrate with the work of the load.
  double most(const Eigen::VectorXd& shape) const {
    return std::abs(load(shape)) / (omega * shape.dot(damping * shape));
  }
};

// The contacts where a shape vibrates with an amplitude in a harmonic, as late behind the load as leaves its
// damping the work that the load gives: before or after the quarter of a turn, at which it gives most.
void add_resonances(const ContactProblem& problem, const Eigen::VectorXd& contacts_stand,
                    const ModalVibration& vibration, const Eigen::VectorXd& shape, double amplitude,
                    int harmonic, StateBox& box) {
  constexpr int points = 256;
  const double lag = std::asin(std::min(1.0, amplitude / vibration.most(shape)));
  for (const double late : {lag, std::numbers::pi - lag}) {
    const double phase = std::arg(vibration.load(shape)) - late;
    Eigen::RowVectorXd wave(points);
    for (int l = 0; l < points; ++l)
      wave[l] = amplitude * std::cos(2.0 * std::numbers::pi * harmonic * l / points + phase);
    Motion motion{(vibration.contacts * shape * wave).colwise() + contacts_stand, {}, {}};
    motion.force = problem.laws().force(motion.displacement);
    box.resonances.push_back(std::move(motion));
  }
}

// The modes, and the shapes with each contact as a spring tuned to the harmonic: stiff contacts cause
// shapes that no mode has.
std::vector<Eigen::VectorXd> resonant_shapes(const ModalVibration& vibration) {
  constexpr double least_part = 1e-3;
  const Eigen::Index modes = vibration.squares.size();
  const double largest = vibration.amplitudes.cwiseAbs().maxCoeff();
  std::vector<Eigen::VectorXd> shapes;
  for (Eigen::Index j = 0; j < modes; ++j)
    if (std::abs(vibration.amplitudes[j]) > least_part * largest && !vibration.contacts.col(j).isZero(0.0))
      shapes.emplace_back(Eigen::VectorXd::Unit(modes, j));
  const Eigen::ArrayXd apart = vibration.squares.array() - vibration.omega * vibration.omega;
  for (Eigen::Index c = 0; c < vibration.contacts.rows() && modes > 1; ++c) {
    const Eigen::VectorXd shape = vibration.contacts.row(c).transpose().array() / apart;
    const double size = shape.norm();
    if (std::isfinite(size) && size > 0.0) shapes.emplace_back(shape / size);
  }
  return shapes;
}

// The load follows from the linear response, and with it the largest vibration of a shape at the same
// frequency, whose damping dissipates the work of the load.
void include_resonances(const ContactProblem& problem, const Eigen::VectorXd& stands, const Motion& free,
                        double factor, StateBox& box) {
  constexpr int harmonics = 3;
  constexpr double most_times = 1e6;
  if (!problem.laws().have_finite_force()) return;
  const LinearStructure& structure = problem.structure();
  const Eigen::MatrixXd &shapes = box.shapes, modes = product(box.projection, free.displacement);
  const Eigen::VectorXd contacts_stand = structure.contact_directions * stands;
  ModalVibration vibration{structure.contact_directions * shapes,
                           shapes.transpose() * (structure.damping * shapes),
                           shapes.cwiseProduct(structure.stiffness * shapes).colwise().sum().transpose(),
                           0.0,
                           {}};
  for (int h = 1; h <= harmonics; ++h) {
    vibration.omega = 2.0 * std::numbers::pi * h * problem.condensed().frequency();
    vibration.amplitudes = amplitudes_of(modes, h);
    for (const Eigen::VectorXd& shape : resonant_shapes(vibration)) {
      const Eigen::VectorXd contacts = vibration.contacts * shape;
      const double moved = (vibration.contacts * vibration.amplitudes).cwiseAbs().maxCoeff(),
                   least = moved / contacts.cwiseAbs().maxCoeff(),
                   most = std::min(most_times * least, vibration.most(shape));
      if (!(least > 0.0)) continue;
      const double resonant = resonant_amplitude(problem, contacts_stand, contacts,
                                                 shape.cwiseAbs2().dot(vibration.squares),
                                                 vibration.omega * vibration.omega, least, most),
                   found = factor * resonant;
      if (!(resonant > 0.0)) continue;
      add_resonances(problem, contacts_stand, vibration, shape, resonant, h, box);
      box.displacement = box.displacement.cwiseMax(found * shape.cwiseAbs());
      box.velocity = box.velocity.cwiseMax(found * vibration.omega * shape.cwiseAbs());
    }
  }
}

}  // namespace

void StateBox::include(const Motion& motion, double factor) {
  const auto largest = [&](const Eigen::MatrixXd& values, const Eigen::VectorXd& from) -> Eigen::VectorXd {
    return factor * (product(projection, values).colwise() - from).cwiseAbs().rowwise().maxCoeff();
  };
  displacement = displacement.cwiseMax(largest(motion.displacement, middle));
  velocity = velocity.cwiseMax(largest(motion.velocity, Eigen::VectorXd::Zero(middle.size())));
}

std::vector<BoxSide> StateBox::sides() const {
  std::vector<BoxSide> sides;
  for (Eigen::Index i = 0; i < displacement.size(); ++i) {
    const double largest = shapes.col(i).cwiseAbs().maxCoeff();
    sides.push_back({largest * displacement[i], largest * velocity[i]});
  }
  return sides;
}

StructureState StateBox::random(std::mt19937& generator) const {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto within = [&](Eigen::VectorXd modes, const Eigen::VectorXd& sides) -> Eigen::VectorXd {
    for (Eigen::Index i = 0; i < sides.size(); ++i) modes[i] += sides[i] * uniform(generator);
    return shapes * modes;
  };
  StructureState state;
  state.displacement = within(middle, displacement);
  state.velocity = within(Eigen::VectorXd::Zero(velocity.size()), velocity);
  return state;
}

std::optional<StateBox> box_of_motions(ContactProblem& problem, double frequency) {
  constexpr double larger = 2.0;
  problem.condensed().set_load_frequency(frequency);
  const auto flow =
      ModalFlow::make(problem.structure(), frequency, 1.0 / frequency, AttractorOptions::max_modes);
  if (!flow) return std::nullopt;
  const Eigen::VectorXd stands = standing(problem);
  PeriodicResponse open;
  open.frequency = problem.condensed().frequency();
  open.force_on_held_structure = Eigen::VectorXd::Zero(problem.samples());
  Motion free = vibration_of(structure_motion(problem.condensed(), open, points_of_period));
  const double factor = larger * factor_to_gap(problem, stands, free);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(flow->modes());
  StateBox box{flow->shapes(), flow->projection(), flow->projection() * stands, zero, zero, {}};
  include_resonances(problem, stands, free, larger, box);
  free.displacement.colwise() += stands;
  box.include(free, factor);
  return box;
}

}  // namespace wavebalance::solvers::detail
