#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_form.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/modes/nonlinear_mode.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"
#include "wavebalance/solvers/time/time_pair.hpp"

namespace wavebalance::solvers {

/// Which mode is continued, and when a solution is accepted.
struct ElasticModeOptions {
  int mode = 1;              ///< the linear mode that the nonlinear one continues, from 1
  bool cosine_only = false;  ///< seek motions that are even in time: half the unknowns; Fourier bases only
  /// automatic: force for a law much stiffer than its contact, else displacement.
  ContactForm form = ContactForm::automatic;
  double tolerance = 1e-10;  ///< on the relative residual of the balance

  /// Throws std::invalid_argument for a number out of its range, whatever the model.
  void validate() const;
};

/// How far a backbone is followed, and by which steps.
struct ElasticBackboneOptions {
  double max_energy = 10.0;          ///< the curve ends once the energy ratio is above
  double max_frequency_ratio = 1.3;  ///< or omega over the linear one
  int max_points = 2000;             ///< or after so many points
  /// Arc lengths. An rms change of the contacts by their gaps has the length 1, as has a change of omega over
  /// the linear one by `frequency_scale`.
  double initial_step = 0.01, min_step = 1e-7, max_step = 0.1;
  static constexpr double frequency_scale = 0.2;
  Observer observer = {};  ///< called before each point; the curve ends when it returns false

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// How a backbone ended.
enum class BackboneStatus {
  reached_energy,      ///< at max_energy
  reached_frequency,   ///< at max_frequency_ratio, below max_energy
  internal_resonance,  ///< on an internal resonance that no step passed, and along which it was lost
  lost,                ///< no further point was found
  no_start,            ///< no point was found near the linear mode
  point_limit,         ///< after max_points
  cancelled            ///< the observer returned false
};

std::string_view to_string(BackboneStatus status);

/// The points of a mode in the order of the curve. Those on an internal resonance are kept with that status.
struct ElasticBackbone {
  BackboneStatus status = BackboneStatus::no_start;
  std::vector<ModePoint> points;
};

/// Throws std::invalid_argument for a pair of bases that damps a free motion: symbol(2) / symbol(0) is not
/// real, or it has fewer than 3 functions.
void require_free_motions(const TimePair& pair);

struct ModeProblem;

/// Nonlinear modes with elastic contact: the free periodic motions of an undamped structure, condensed on its
/// contacts, that continue a linear mode. Any law, one per contact, and any pair of bases that does not damp
/// a free motion: symbol(2) / symbol(0) must be real, as for a basis on both sides and for Fourier weights.
///
/// The curve of motions is followed by arc length in the contacts' displacements and the frequency, from the
/// linear mode at grazing on. Newton's method with the first harmonic of the continued mode as an unknown is
/// regular there, where the compliance is not. A law that acts below its gap, or has a gap of 0, starts from
/// the linear mode at an energy ratio of 1e-4. ModalModel::gaps are the lengths that energies refer to; a
/// unilateral law must have them as its gaps, unless its own is 0.
///
/// In points of this class energy_ratio is the constant energy of the motion, with the law's potential,
/// over the energy of linear grazing; gamma_ratio is LL10's. max_penetration includes the deformation of
/// the law. virial_residual is |omega^2 m - k - mean(u f)| / (omega^2 m), with m and k the quadratic forms
/// of mass and stiffness. Amplitudes are the harmonics of the samples, up to half of their number unless
/// the trial basis is Fourier.
///
/// Immutable, may be shared between threads. A Newton step costs O((C M)^3 + C N M^2).
class ElasticMode {
 public:
  /// Throws std::invalid_argument for options, a model or laws out of range, and for a pair as above.
  ElasticMode(ModalModel model, const TimePair& pair, ContactLaws laws, ElasticModeOptions options = {});

  const ModalModel& model() const;
  const ElasticModeOptions& options() const { return options_; }
  int harmonics() const;          ///< K, the highest coefficient of the trial functions that is solved for
  double linear_omega() const;    ///< rad/s, of the linear mode continued, as the pair of bases has it
  double grazing_energy() const;  ///< J, of that mode once it just reaches a gap

  /// Whether no law acts up to the energy ratio 1, below which the curve is the linear mode.
  bool starts_linear() const;
  /// The linear mode at an energy ratio <= 1, below contact.
  ModePoint linear_mode(double energy_ratio) const;
  /// The curve from the linear mode on. Throws as the options' validate() does.
  ElasticBackbone backbone(const ElasticBackboneOptions& options = {}) const;
  /// The motion of an energy ratio: the linear mode up to 1 if there is contact beyond it only, else a
  /// point of the curve that backbone() follows up to there. Status no_contact where the curve ends before;
  /// internal_resonance on a resonance along which the curve goes and, with another energy, where the curve
  /// passes the requested one between two points across a resonance.
  ModePoint at_energy(double energy_ratio, ElasticBackboneOptions options = {},
                      double tolerance = 1e-10) const;

  /// The motion in the plane across the chord of two neighbours of the curve, at `share` in 0..1 of the way
  /// from a to b. Nothing where none is found near the chord, as across a resonance that was passed.
  std::optional<ModePoint> between(const ModePoint& a, const ModePoint& b, double share) const;
  /// The stiffness of the contacts along a motion of this mode, none of a linear one.
  PeriodicStiffness contact_stiffness(const ModePoint& point) const;
  /// The same with contact where the displacement of the structure is beyond the gap. The unknown of the
  /// force form has a kink there, which H harmonics place to first order in 1/H, the displacement to third
  /// order; but of a law that is so stiff that they do not resolve the contact, only the unknown places it.
  /// Nothing in the displacement form, where both are the same, and of functions other than Fourier's.
  std::optional<PeriodicStiffness> stiffness_by_displacement(const ModePoint& point) const;

 private:
  std::shared_ptr<const ModeProblem> problem_;
  AnyTimeBasis trial_;
  ElasticModeOptions options_;
};

}  // namespace wavebalance::solvers
