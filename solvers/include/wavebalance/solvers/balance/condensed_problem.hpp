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
/// u0 the contact-free response and K (C N x C N, rank C M) the dynamic compliance between force and
/// displacement samples: DFT, weighting, compliance S Z(k)^-1 S^T, trial functions, inverse DFT. K is never
/// formed; a product takes O(C N log N + C^2 M), and a shift by shift_period() samples in time maps its
/// columns onto each other.
///
/// Structural damping (LinearStructure::loss_factor) is K (1 + i eta sign(k)) in Z(k), with k = -M/2..M/2 the
/// least harmonic that the coefficient k over translates stands for: the operator of the damping acts on the
/// translates, whatever their generator. k and -k stay conjugate, so that motions are real. The static
/// coefficient and an alternating one, k = M/2, which stands for both signs, have none.
///
/// A Nyquist coefficient that the pair drops is never condensed: its compliance and load response are zero.
/// What stands between forces and the unknown in which contact is solved for is a ContactOperator.
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
  /// `load_harmonics[n]`: complex amplitude h_n of the load's time function Re sum h_n exp(2 pi i n t), which
  /// scales structure.load; {0, 1} is the cosine of JL14. The period of structure.forces is that of the load:
  /// with p = gcd of the load's harmonics above 0, their harmonic m is harmonic p m of the problem.
  /// Throws as Condensation does.
  CondensedProblem(TimePair pair, const LinearStructure& structure, Eigen::VectorXcd load_harmonics,
                   CondensationMethod method = CondensationMethod::automatic);
  /// With a compliance of one's own, of as many contacts and loads as the structure has; the matrices of the
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
  const LinearStructure& structure() const { return *structure_; }
  const Eigen::VectorXcd& load_harmonics() const { return load_harmonics_; }

  /// Threads of each condensation, as Condensation::set_threads() takes them; 1 until it is called.
  void set_threads(int threads) { harmonics_->set_threads(threads); }
  int threads() const { return harmonics_->threads(); }

  /// Condenses at a frequency (Hz, > 0). Throws std::invalid_argument or SingularSystem. M/2 + 1 points of
  /// condensation and O(C N log N).
  void set_frequency(double frequency_hz);
  double frequency() const { return frequency_; }
  /// Makes the next set_frequency() condense, also at the frequency that the problem has: for measurements of
  /// whole solves.
  void forget_condensation() { condensed_at_ = 0.0; }

  /// Says that a period of the problem is `periods` of the load, 1 until it is said: curves are told in
  /// frequencies of the load. The harmonics of the load stay as they are. Throws std::invalid_argument below
  /// 1.
  void set_periods(int periods);
  int periods() const { return periods_; }
  /// Hz, periods() times frequency().
  double load_frequency() const { return periods_ * frequency_; }
  void set_load_frequency(double frequency_hz) { set_frequency(frequency_hz / periods_); }

  /// The size of the load without its static part, 1 at first, where it is that of structure and harmonics.
  /// Finite, or std::invalid_argument. No condensation: O(C (L M + N log N)).
  void set_load_scale(double scale);
  double load_scale() const { return load_scale_; }
  /// Tells it in a unit, in which the load of structure and harmonics has the size `amplitude`, and sets it
  /// to that. Throws std::invalid_argument for an amplitude that is not positive and finite.
  void set_load_unit(double amplitude, std::string unit);
  const std::string& load_unit() const { return load_unit_; }
  double full_load() const { return full_load_; }  ///< that amplitude, 1 where no unit was set
  /// The factor on every harmonic of load and forces but the static one.
  double load_factor() const { return load_scale_ / full_load_; }

  /// u0, m, samples() values, and its derivatives by frequency, m/Hz, and by load_scale(), m.
  const Eigen::VectorXd& contact_free_response() const { return free_response_; }
  const Eigen::VectorXd& contact_free_response_slope();
  Eigen::VectorXd contact_free_response_by_scale();

  /// Whether the structure is free to move.
  bool is_free() const { return hold_ != nullptr; }
  /// K of the springs' forces kappa Q, constant in time, samples() x q; a free structure's alone. O(q N log
  /// N) on first use.
  const Eigen::MatrixXd& hold_response();
  /// Q^T mean(u), q values, m, of an unknown u + E lambda / epsilon with the flexibilities 1 / epsilon of a
  /// ContactOperator and its contact force, samples() each. O(C N).
  Eigen::VectorXd rigid_position(const Eigen::VectorXd& unknown, const Eigen::VectorXd& force,
                                 const Eigen::VectorXd& flexibility) const;
  /// The contact force less kappa Q Q^T mean(u), N, samples() values: what the motion follows from in all
  /// functions below. The force itself for a structure that is held.
  Eigen::VectorXd force_on_held_structure(const Eigen::VectorXd& force, const Eigen::VectorXd& unknown,
                                          const Eigen::VectorXd& flexibility) const;
  /// Q, C x q, and the mean contact forces Q^T f that balance the static load, q values, N.
  const Eigen::MatrixXd& rigid_directions() const;
  Eigen::VectorXd balancing_force() const;
  /// kappa times the largest displacement without contact, N: the size that rounding of balancing_force()
  /// has.
  double spring_force() const;
  /// Whether the static load does no work on the motions that no contact resists, to rounding.
  bool drift_is_balanced() const;

  /// How far each contact yields to a unit force at it, m/N: the median of the moduli at the harmonics 0, 1
  /// and 2, or the static one for fewer than five functions.
  Eigen::VectorXd contact_compliance() const;
  /// How far it yields to forces as brief as the functions resolve, m/N: the median over all harmonics.
  Eigen::VectorXd high_frequency_compliance() const;

  /// The compliance over translates, (M/2 + 1) x C^2, m/N: K of samples follows from it and the two bases.
  const Eigen::MatrixXcd& compliance() const { return condensed_.compliance; }
  /// Counts how often it has changed.
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
  /// a(k) = contact-free response - compliance * <p, f>. O(C N log N + C^2 M).
  Eigen::MatrixXcd coefficients(const Eigen::VectorXd& force);
  /// The same with another compliance over translates.
  Eigen::MatrixXcd coefficients(const Eigen::MatrixXcd& compliance, const Eigen::VectorXd& force);

  /// Estimated rounding error of the condensation in the motion of those coefficients, at fixed forces: the
  /// 2-norm of the errors of the coefficients, over that of the coefficients or of those without contact,
  /// whichever is larger. O(C N log N + C^2 M).
  double rounding_error(const Eigen::VectorXd& force);
  /// A motion of that size, m, samples() values, if the errors have the phases of compliance and load
  /// response, as those of one dominant mode have.
  Eigen::VectorXd rounding_motion(const Eigen::VectorXd& force);

  /// Spectra over translates of the coefficients of all n degrees of freedom, n x (M/2 + 1), for force
  /// samples of all contacts (samples()). Throws SingularSystem. O(n M), or M/2 + 1 factorisations.
  Eigen::MatrixXcd full_coefficients(const Eigen::VectorXd& force);

 private:
  Eigen::VectorXd median_compliance(int harmonics) const;
  void apply_kernel(const Eigen::VectorXd& in, const Eigen::VectorXcd& analysis,
                    const Eigen::MatrixXcd& kernel, const Eigen::VectorXcd& synthesis, Eigen::VectorXd& out);
  void synthesize(const Eigen::MatrixXcd& spectra, Eigen::VectorXd& samples);
  void project(const Eigen::VectorXd& force);
  void set_unit_loads();
  double load_power(Eigen::Index load) const;
  Eigen::MatrixXcd combine_loads(const Eigen::MatrixXcd& responses, const Eigen::MatrixXcd& loads) const;
  Eigen::MatrixXd load_errors() const;
  void update_load();
  void update_free_response();

  TimePair pair_;
  std::shared_ptr<const LinearStructure> structure_;
  Eigen::VectorXcd load_harmonics_;
  struct Hold;  // of a structure that is free to move
  std::unique_ptr<Hold> hold_;
  std::unique_ptr<HarmonicCompliance> harmonics_;
  Eigen::MatrixXcd unit_loads_, static_loads_;  // projected at 1 Hz, over translates (rows): all, and static
  Eigen::MatrixXcd load_;                       // those that act at frequency_
  int periods_ = 1;
  double frequency_ = 0.0;
  double load_scale_ = 1.0, full_load_ = 1.0;
  std::string load_unit_ = "of the load";
  double condensed_at_ = 0.0;  // Hz, at which all below is current; 0: none
  std::uint64_t condensations_ = 0;
  CondensedSpectrum condensed_;     // load responses to unit loads
  Eigen::MatrixXcd load_response_;  // to the projected loads, (M/2 + 1) x C
  Eigen::VectorXd free_response_, free_response_slope_;
  bool slope_is_current_ = false;
  struct Work;
  std::unique_ptr<Work> work_;
};

/// How often the load of a problem repeats within its period: the greatest common divisor of the load's
/// harmonics above 0, 1 without any. A problem at the frequency f / n with its load in harmonic n has n: its
/// responses are the motions of n periods of a load of frequency f, and those of fewer.
int load_periods(const CondensedProblem& problem);

}  // namespace wavebalance::solvers
