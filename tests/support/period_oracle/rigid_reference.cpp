#include "period_oracle/rigid_reference.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "linalg/dense.hpp"
#include "period_oracle/shooting_modes.hpp"

namespace wavebalance::oracle {

using solvers::LinearStructure;

namespace {

constexpr int halvings = 32;

// State: displacements of the dofs with mass, their velocities over a bound of the natural angular
// frequencies, displacement of the tip, cosine and sine of the load; time as a fraction of the period. The
// matrix exponential loses the digits by which displacements and velocities differ in size.
class Flows {
 public:
  Flows(const LinearStructure& structure, double gap, double frequency, int points)
      : masses_(structure.size() - 1), gap_(gap) {
    const Eigen::MatrixXd m = structure.mass, c = structure.damping, k = structure.stiffness;
    const int n = masses_, size = 2 * n + 3;
    require_single_contact(structure, "rigid_reference");
    structure.require_causal_damping("rigid_reference");
    if (structure.selected_dof(0) != n || m.row(n).cwiseAbs().maxCoeff() != 0.0 || c(n, n) <= 0.0)
      throw std::invalid_argument(
          "rigid_reference: the last degree of freedom must touch, have no mass and "
          "be damped");
    force_ = Eigen::RowVectorXd::Zero(size);
    force_ << -k.row(n).head(n), -c.row(n).head(n), -k(n, n), structure.load[n], 0.0;
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(n, size);
    forces << -k.topLeftCorner(n, n), -c.topLeftCorner(n, n), -k.col(n).head(n), structure.load.head(n),
        Eigen::VectorXd::Zero(n);
    const solvers::detail::Lu<double> lu(m.topLeftCorner(n, n));
    fastest_ = std::sqrt(lu.solve(Eigen::MatrixXd(k.topLeftCorner(n, n))).norm());
    for (const bool closed : {false, true}) {
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
      const Eigen::RowVectorXd tip =
          closed ? Eigen::RowVectorXd::Zero(size) : Eigen::RowVectorXd(force_ / c(n, n));
      a.block(0, n, n, n).setIdentity();
      a.middleRows(n, n) = lu.solve(Eigen::MatrixXd(forces - c.col(n).head(n) * tip));
      a.row(2 * n) = tip;
      a.middleRows(n, n) /= fastest_;
      a.middleCols(n, n) *= fastest_;
      a /= frequency;
      a(2 * n + 1, 2 * n + 2) = -2.0 * std::numbers::pi;
      a(2 * n + 2, 2 * n + 1) = 2.0 * std::numbers::pi;
      for (int h = 0; h <= halvings; ++h)
        steps_[closed].push_back(solvers::detail::exponential(a * std::ldexp(1.0 / points, -h)));
    }
    force_.segment(n, n) *= fastest_;
  }

  double tip(const Eigen::VectorXd& state) const { return state[2 * masses_]; }
  double force(const Eigen::VectorXd& state) const { return force_ * state; }
  bool leaves(const Eigen::VectorXd& state, bool closed) const {
    return closed ? force(state) < 0.0 : tip(state) > gap_;
  }
  Eigen::VectorXd advance(const Eigen::VectorXd& state, bool closed, int halving) const {
    return steps_[closed][static_cast<std::size_t>(halving)] * state;
  }
  void close(Eigen::VectorXd& state) const { state[2 * masses_] = gap_; }
  Eigen::VectorXd start() const {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(2 * masses_ + 3);
    state[2 * masses_ + 1] = 1.0;
    return state;
  }
  void reset_load(Eigen::VectorXd& state) const { state.tail<2>() = Eigen::Vector2d(1.0, 0.0); }

 private:
  int masses_;
  double gap_, fastest_ = 1.0;  // rad/s
  Eigen::RowVectorXd force_;
  std::array<std::vector<Eigen::MatrixXd>, 2> steps_;
};

// One sample ahead, through any number of switches, whose places within the sample are appended.
void advance_sample(const Flows& flows, Eigen::VectorXd& state, bool& closed, std::vector<double>& places) {
  long done = 0;
  const long whole = 1L << halvings;
  while (done < whole) {
    for (int h = 0; h <= halvings && done < whole; ++h) {
      const long length = whole >> h;
      if (done + length > whole) continue;
      Eigen::VectorXd next = flows.advance(state, closed, h);
      const bool leaves = flows.leaves(next, closed);
      if (leaves && h < halvings) continue;
      state = std::move(next);
      done += length;
      if (!leaves) continue;
      places.push_back(double(done) / double(whole));
      closed = !closed;
      if (closed) flows.close(state);
      break;
    }
  }
}

}  // namespace

RigidReference rigid_reference(const LinearStructure& structure, double gap, double frequency_hz, int points,
                               double tolerance, int max_periods) {
  if (!structure.forces.empty())
    throw std::invalid_argument("rigid_reference: the structure has " +
                                std::to_string(structure.forces.size()) +
                                " forces beside its load; it must have none");
  const Flows flows(structure, gap, frequency_hz, points);
  RigidReference result;
  result.displacement.resize(points);
  result.contact_force.resize(points);
  Eigen::VectorXd state = flows.start();
  bool closed = false;
  while (!result.converged && result.periods < max_periods) {
    const Eigen::VectorXd before = state;
    result.instants.clear();
    std::vector<double> places;
    for (int l = 0; l < points; ++l) {
      result.displacement[l] = flows.tip(state);
      result.contact_force[l] = closed ? flows.force(state) : 0.0;
      places.clear();
      advance_sample(flows, state, closed, places);
      for (const double place : places) result.instants.push_back((l + place) / points);
    }
    flows.reset_load(state);
    ++result.periods;
    result.change = (state - before).norm() / state.norm();
    result.converged = result.change <= tolerance;
  }
  return result;
}

}  // namespace wavebalance::oracle
