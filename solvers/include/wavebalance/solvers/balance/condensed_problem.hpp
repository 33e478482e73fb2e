#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "wavebalance/solvers/balance/harmonic_compliance.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// The periodic problem of C contacts at one frequency, written for the displacement
/// samples u (N values per contact at t_l = (l + sample_offset)/N; contact c has entries [c N, (c + 1) N)):
///
///   u = u0 - K f_c(u),
///
/// u0 the linear response and K (C N x C N, rank C M) the dynamic compliance between force and displacement
/// samples: DFT, weighting, compliance S Z(k)^-1 S^T, trial functions, inverse DFT. K is never formed; a
/// product costs O(C N log N + C^2 M), and a shift by shift_period() samples in time maps its columns onto
/// each other.
///
/// Structural damping (LinearStructure::loss_factor) makes the stiffness in Z(k) complex, K (1 + i eta
/// sign(k)). Here k = -M/2..M/2 is the lowest harmonic that the coefficient k over translates contains. The
/// damping thus acts on translates and does not depend on the basis. The coefficients k and -k stay
/// conjugate, so that motions are real. The static coefficient is not damped, nor is the alternating one, k =
/// M/2, which contains both signs.
///
/// A Nyquist coefficient that the pair drops is never condensed: its compliance and load response are zero.
/// ContactOperator maps contact forces to the unknown for which contact is solved, which may be another than
/// u.
///
/// A structure that turns (LinearStructure::turning) does so with its load: structure() has the matrices at
/// the last set_frequency(), and slopes by the frequency contain their changes.
///
/// A structure that is free to move (LinearStructure::rigid_modes) has no static compliance along the rigid
/// contact displacements Q, an orthonormal basis of S R: the mean contact forces must balance the static load
/// there, and the mean displacement Q^T u is an unknown. Springs kappa Q Q^T hold the structure in the static
/// compliance, and their force is taken back from the contact forces:
///
///   u = u0 - K (f_c(u) - kappa Q Q^T mean(u)),
///
/// which has the solutions of the free structure for any kappa. Motions that no contact resists keep a zero
/// mean.
///
/// Owns plans and buffers: one object per thread.
class CondensedProblem {
 public:
  /// `load_harmonics[n]`: complex amplitude h_n of the load's time function Re sum h_n exp(2 pi i n t),
  /// which scales structure.load; {0, 1} is the cosine of JL14. structure.forces have the period of the
  /// load: with p = gcd of the load's harmonics above 0, their harmonic m is harmonic p m of the problem.
  /// Throws as Condensation does.
  CondensedProblem(TimePair pair, const LinearStructure& structure, Eigen::VectorXcd load_harmonics,
                   CondensationMethod method = CondensationMethod::automatic);
  /// With a compliance of the user, of as many contacts and loads as the structure has; the matrices of the
  /// structure are then not condensed.
  CondensedProblem(TimePair pair, const LinearStructure& structure, Eigen::VectorXcd load_harmonics,
                   std::unique_ptr<HarmonicCompliance> compliance);
  CondensedProblem(CondensedProblem&&) noexcept;
  CondensedProblem& operator=(CondensedProblem&&) noexcept;
  ~CondensedProblem();

  const TimePair& pair() const { return pair_; }
  int contacts() const { return structure_->contacts(); }  ///< C
  int points() const { return pair_.points(); }            ///< N, samples of each contact
  int samples() const { return contacts() * points(); }    ///< C N
  /// HarmonicCompliance::condition() at the frequency.
  double condition() const { return harmonics_->condition(); }
  /// One that turns changes with set_frequency().
  const LinearStructure& structure() const { return *structure_; }
  const Eigen::VectorXcd& load_harmonics() const { return load_harmonics_; }

  /// Threads of each condensation, as in Condensation::set_threads(); 1 by default.
  void set_threads(int threads) { harmonics_->set_threads(threads); }
  int threads() const { return harmonics_->threads(); }

  /// Condenses at a frequency (Hz, > 0). Throws std::invalid_argument or SingularSystem. M/2 + 1 points of
  /// condensation and O(C N log N).
  void set_frequency(double frequency_hz);
  double frequency() const { return frequency_; }
  /// Makes the next set_frequency() condense again, even at the present frequency. Measurements of whole
  /// solves need that.
  void forget_condensation() { condensed_at_ = 0.0; }

  /// Sets how many periods of the load one period of the problem has, 1 by default. Parameters of curves are
  /// frequencies of the load. The harmonics of the load do not change. Throws std::invalid_argument below 1.
  void set_periods(int periods);
  int periods() const { return periods_; }
  /// Hz, periods() times frequency().
  double load_frequency() const { return periods_ * frequency_; }
  void set_load_frequency(double frequency_hz) { set_frequency(frequency_hz / periods_); }

  /// The size of the load without its static part, 1 at first, where it belongs to structure and harmonics.
  /// Finite, or std::invalid_argument. No condensation: O(C (L M + N log N)).
  void set_load_scale(double scale);
  double load_scale() const { return load_scale_; }
  /// Gives load_scale() a unit in which the load of structure and harmonics has the size `amplitude`, and
  /// sets it to that size. Throws std::invalid_argument for an amplitude that is not positive and finite.
  void set_load_unit(double amplitude, std::string unit);
  const std::string& load_unit() const { return load_unit_; }
  double full_load() const { return full_load_; }  ///< `amplitude` of the unit, 1 without a unit
  /// The factor on every harmonic of load and forces but the static one.
  double load_factor() const { return load_scale_ / full_load_; }

  /// u0, m, samples() values, and its derivatives by frequency, m/Hz, and by load_scale(), m.
  const Eigen::VectorXd& linear_response() const { return free_response_; }
  const Eigen::VectorXd& linear_response_slope();
  Eigen::VectorXd linear_response_by_scale();

  /// Whether the structure is free to move.
  bool is_free() const { return hold_ != nullptr; }
  /// K applied to the constant forces kappa Q of the springs, samples() x q. Only for a free structure. O(q N
  /// log N) on first use.
  const Eigen::MatrixXd& hold_response();
  /// The position of a free structure, Q^T mean(u), q values, m. `unknown` and `force` are the unknown u + E
  /// lambda / epsilon of a ContactOperator and its contact force, samples() values each, and `flexibility` is
  /// its 1 / epsilon. O(C N).
  Eigen::VectorXd rigid_position(const Eigen::VectorXd& unknown, const Eigen::VectorXd& force,
                                 const Eigen::VectorXd& flexibility) const;
  /// The force on the structure held by springs, N, samples() values: the contact force less the springs'
  /// force kappa Q Q^T mean(u). The functions below take this force. It is `force` itself for a structure
  /// that is not free.
  Eigen::VectorXd force_on_held_structure(const Eigen::VectorXd& force, const Eigen::VectorXd& unknown,
                                          const Eigen::VectorXd& flexibility) const;
  /// Q, C x q.
  const Eigen::MatrixXd& rigid_directions() const;
  /// The mean contact forces Q^T f that balance the static load, q values, N.
  Eigen::VectorXd balancing_force() const;
  /// kappa times the largest displacement without contact, N. Rounding errors of balancing_force() are
  /// relative to it.
  double spring_force() const;
  /// Whether the static load does no work, to rounding, on the rigid motions that no contact resists.
  bool drift_is_balanced() const;

  /// The compliance of each contact to a force at it, m/N. It is the median of the moduli at the harmonics 0,
  /// 1 and 2, or the static one for fewer than five functions.
  Eigen::VectorXd contact_compliance() const;
  /// The same for forces as brief as the functions resolve, m/N: the median over all harmonics.
  Eigen::VectorXd high_frequency_compliance() const;

  /// The compliance over translates, (M/2 + 1) x C^2, m/N. It and the two bases determine K.
  const Eigen::MatrixXcd& compliance() const { return condensed_.compliance; }
  /// How often compliance() has changed.
  std::uint64_t condensations() const { return condensations_; }

  /// K f. `force` in N, samples() values; the result in m. O(C N log N + C^2 M).
  void apply(const Eigen::VectorXd& force, Eigen::VectorXd& displacement);
  /// (dK / d frequency) f, m/Hz.
  void apply_slope(const Eigen::VectorXd& force, Eigen::VectorXd& slope);
  /// The same products, and K^T v, with another compliance over translates.
  void apply(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& force, Eigen::VectorXd& displacement);
  void apply_transposed(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& values,
                        Eigen::VectorXd& result);

  /// u0 - K f, m, samples() values.
  Eigen::VectorXd displacement(const Eigen::VectorXd& force);

  /// Spectra over translates, (M/2 + 1) x C, of the coefficients that belong to force samples (samples()):
  /// a(k) = linear response - compliance * <p, f>. O(C N log N + C^2 M).
  Eigen::MatrixXcd coefficients(const Eigen::VectorXd& force);
  /// The same with another compliance over translates.
  Eigen::MatrixXcd coefficients(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& force);

  /// Estimated rounding error of the condensation in the motion of those coefficients, at fixed forces: the
  /// 2-norm of the errors of the coefficients, over the norm of the coefficients with or without contact,
  /// whichever is larger. O(C N log N + C^2 M).
  double rounding_error(const Eigen::VectorXd& force);
  /// A motion of the size of these errors, m, samples() values. Each error has the phase of the compliance or
  /// load response that it belongs to, which is exact where one mode dominates.
  Eigen::VectorXd rounding_motion(const Eigen::VectorXd& force);

  /// Spectra over translates of the coefficients of all n degrees of freedom, n x (M/2 + 1), for force
  /// samples of all contacts (samples()). Throws SingularSystem. O(n M), or M/2 + 1 factorisations.
  Eigen::MatrixXcd full_coefficients(const Eigen::VectorXd& force);

 private:
  Eigen::VectorXd median_compliance(int harmonics) const;
  void apply_kernel(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                    const Eigen::MatrixXcd& kernel, bool adjoint, const Eigen::VectorXcd& synthesis,
                    Eigen::VectorXd& out);
  void synthesize(const Eigen::MatrixXcd& spectra, Eigen::VectorXd& samples);
  void project(const Eigen::VectorXd& force);
  void set_unit_loads();
  struct Growth {
    double value, slope;  // a factor on a unit load, and its derivative per Hz
  };
  Growth growth_of_load(Eigen::Index load) const;
  Eigen::MatrixXcd scaled_unit_loads() const;
  Eigen::MatrixXcd combine_loads(const Eigen::MatrixXcd& responses, const Eigen::MatrixXcd& loads) const;
  Eigen::MatrixXd load_errors() const;
  void update_load();
  void update_free_response();

  TimePair pair_;
  std::shared_ptr<const LinearStructure> structure_, given_;  // at the frequency, and as it was given
  Eigen::VectorXcd load_harmonics_;
  struct Hold;  // the springs that hold a structure that is free to move
  std::unique_ptr<Hold> hold_;
  std::unique_ptr<HarmonicCompliance> harmonics_;
  Eigen::MatrixXcd unit_loads_, static_loads_;  // projected at 1 Hz, over translates (rows): all, and static
  Eigen::MatrixXcd load_;                       // the loads at frequency_, projected
  int periods_ = 1;
  double frequency_ = 0.0;
  double load_scale_ = 1.0, full_load_ = 1.0;
  std::string load_unit_ = "of the load";
  double condensed_at_ = 0.0;  // Hz, the frequency of all members below; 0 where they are not current
  std::uint64_t condensations_ = 0;
  CondensedSpectrum condensed_;     // load responses to unit loads
  Eigen::MatrixXcd load_response_;  // response to the projected loads, (M/2 + 1) x C
  Eigen::VectorXd free_response_, free_response_slope_;
  bool slope_is_current_ = false;
  struct Work;
  std::unique_ptr<Work> work_;
};

/// How often the load of a problem repeats within its period: the greatest common divisor of the load's
/// harmonics above 0, 1 without any. A problem at the frequency f / n with its load in harmonic n has n:
/// its responses are the motions of n periods of a load of frequency f, and of fewer.
int load_periods(const CondensedProblem& problem);

}  // namespace wavebalance::solvers
