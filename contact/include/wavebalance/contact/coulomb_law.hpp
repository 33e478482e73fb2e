#pragma once
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "wavebalance/contact/law_description.hpp"
#include "wavebalance/contact/linear_law.hpp"

namespace wavebalance::contact {

/// State of a contact with friction at an instant.
enum class FrictionState { open, stick, slip };

/// Coulomb friction along one or two directions.
struct FrictionParameters {
  double friction = 0.0;              ///< mu >= 0, the coefficient of friction
  double tangential_stiffness = 0.0;  ///< k_t > 0, N/m, in series with the slider; infinite: rigid friction
  double normal_load = 0.0;           ///< N0 >= 0, N, the normal force at zero displacement
  int tangents = 1;                   ///< 1 or 2 orthogonal directions
  std::vector<double> slider = {};    ///< m, position of the slider at rest, one per tangent; empty: 0
  /// The coefficient that ends sticking, at least `friction`; 0: that.
  double static_friction = 0.0;
  double surface_speed = 0.0;       ///< m/s, of the surface along the tangent: a belt, a journal
  double tangential_damping = 0.0;  ///< N s/m, >= 0, parallel to the spring k_t, which is then finite
  double normal_damping = 0.0;      ///< N s/m, >= 0, parallel to the normal spring; the contact does not
                                    ///< pull
};

/// The friction of a contact over a period, N samples.
struct FrictionPeriod {
  /// One entry of the derivative of the forces by displacements, which counts rows x N values.
  struct Slope {
    int force = 0, displacement = 0;
    double slope = 0.0;  ///< N/m
  };
  std::vector<double> force;         ///< N, rows x N
  std::vector<FrictionState> state;  ///< N
  std::vector<double> slip;          ///< N, m: the distance that the slider moves up to each sample
  std::vector<Slope> slopes;         ///< empty if not requested
  double work = 0.0;                 ///< J, dissipated by friction in the period
  double normal_work = 0.0;          ///< J, the normal force times the distance of slip, for wear [Archard]
  /// Whether the force depends on the past beyond the period: the contact neither slips nor opens.
  bool history_dependent = false;
};

/// Elastic Coulomb friction: a spring k_t in series with a slider that moves where its force would exceed mu
/// times the normal force N [Jenkins, Br. J. Appl. Phys. 13, 1962]. With a normal direction N = max(0, N0 +
/// k_n (u_n - g0)), so that the contact also opens; friction then vanishes and the slider starts anew at the
/// instant of closing. Without one N = N0. Rows are the normal direction, where there is one, then the
/// tangents; forces oppose positive displacements.
///
/// The force depends on the order of displacements and not on their velocity. Over a period of samples it is
/// the periodic one: each step is a return mapping, of two tangents with the exact return along a straight
/// step [R. D. Krieg, D. B. Krieg, J. Pressure Vessel Technol. 99, 1977], whose error falls with the square
/// of the step; a radial return is of first order. With one tangent the force after one period is periodic
/// exactly; with two, Newton's method closes the period.
///
/// Against a surface that moves, with a larger coefficient at rest, or with dashpots parallel to its
/// springs the force depends on velocities and on the state of the contact. Such a law with one tangent,
/// needs_states(), has no steps over samples; the solvers use it as a state machine.
///
/// With an infinite k_t friction is rigid: a displacement does not determine its force, and the law in
/// series with springs, resolvent(), is used instead. For a spring h this is elastic friction with k_t = 1
/// / h.
///
/// O(rows N), with two tangents and slopes O(rows N memory), memory the samples back to the last reversal of
/// some. Immutable, may be shared between threads.
class CoulombLaw {
 public:
  /// Throws std::invalid_argument for parameters out of range, a slider with another number of entries than
  /// tangents, without a normal direction for N0 = 0 and a normal damping, for a tangential damping without
  /// a spring, and for two tangents of a law that needs states.
  explicit CoulombLaw(FrictionParameters parameters, std::optional<LinearLaw> normal = {});

  /// Its row of the catalogue, and the law of complete values: without a normal direction where
  /// normal_stiffness is 0.
  static LawDescription description();
  static CoulombLaw of(const LawValues& values);

  int rows() const { return normal_rows() + parameters_.tangents; }
  int tangents() const { return parameters_.tangents; }
  int normal_rows() const { return normal_ ? 1 : 0; }
  double friction() const { return parameters_.friction; }
  double tangential_stiffness() const { return parameters_.tangential_stiffness; }
  bool rigid() const { return std::isinf(parameters_.tangential_stiffness); }  ///< along its tangents
  double static_friction() const { return parameters_.static_friction; }
  double surface_speed() const { return parameters_.surface_speed; }
  double tangential_damping() const { return parameters_.tangential_damping; }
  double normal_damping() const { return parameters_.normal_damping; }
  /// Whether its force follows only from a machine of states, not from steps.
  bool needs_states() const;
  double gap() const { return normal_ ? normal_->gap() : 0.0; }  ///< g0, m; 0 without a normal direction
  /// k_n, N/m; 0 without a normal direction.
  double normal_stiffness() const { return normal_ ? normal_->stiffness() : 0.0; }
  /// N, without the bound at zero: negative where the contact is open. Without a normal direction N0.
  double raw_normal_force(double normal_displacement) const;

  /// The law in series with a spring along each row (flexibility > 0, m/N), of the displacements u +
  /// flexibility f. Throws std::invalid_argument for another number of flexibilities than rows(), one that is
  /// not positive and finite, two tangents of which they differ, and a law that needs states.
  CoulombLaw resolvent(std::span<const double> flexibility) const;

  /// The periodic forces of `points` samples of the displacements of all rows, row after row, m. Throws
  /// std::invalid_argument for rigid friction and a law that needs states.
  FrictionPeriod over_period(int points, std::span<const double> displacement, bool with_slopes) const;

  /// The forces at the end of a step, over which displacements are linear in time from `before`. The
  /// displacements at the end are v - flexibility f, f the force along the same row (flexibility >= 0,
  /// m/N). `force` holds those before the step and receives those after it. All spans have rows() entries.
  /// With flexibilities of 0 it is the step of over_period(). Rigid friction requires positive ones along
  /// tangents, and v is then linear in time. Throws std::invalid_argument for a law that needs states.
  void advance(std::span<const double> before, std::span<const double> v, std::span<const double> flexibility,
               std::span<double> force) const;
  /// The same of displacements at rest, reached from the slider's position at rest.
  void start(std::span<const double> v, std::span<const double> flexibility, std::span<double> force) const;

  /// For the solvers' concept of a law over a period: see PeriodKinematics and PeriodForces there.
  template <class Motion, class Forces>
  void evaluate(const Motion& motion, Forces& out) const {
    const FrictionPeriod period = over_period(motion.points, motion.displacement, true);
    for (std::size_t i = 0; i < period.force.size(); ++i) {
      out.force[i] = period.force[i];
      out.piece[i] = piece(period.state[i % period.state.size()], period.force[i]);
    }
    for (const FrictionPeriod::Slope& one : period.slopes)
      if (one.force == one.displacement)
        out.displacement_slope[static_cast<std::size_t>(one.force)] += one.slope;
      else
        out.others.push_back({one.force, one.displacement, one.slope});
  }

 private:
  static int piece(FrictionState state, double force) {
    if (state == FrictionState::slip) return force < 0.0 ? 3 : 2;
    return state == FrictionState::stick ? 1 : 0;
  }

  void require_steps() const;
  void step(std::span<const double> before, std::span<const double> v, std::span<const double> flexibility,
            std::span<double> force) const;

  FrictionParameters parameters_;
  std::optional<LinearLaw> normal_;
};

}  // namespace wavebalance::contact
