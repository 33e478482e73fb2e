#pragma once

namespace wavebalance::ll10 {

/// A homogeneous bar, clamped at x = 0, whose tip x = length meets a rigid obstacle at the displacement gap.
/// Any consistent units; the defaults are the nondimensional bar.
struct RigidObstacleBar {
  double youngs_modulus = 1.0;  ///< Pa, > 0
  double density = 1.0;         ///< kg/m^3, > 0
  double area = 1.0;            ///< m^2, > 0
  double length = 1.0;          ///< m, > 0
  double gap = 1.0;             ///< m, > 0

  /// Throws std::invalid_argument naming the member, its value and what is allowed.
  void validate() const;
};

/// How the energy of a mode is measured, each as a ratio to the energy of linear grazing (the linear mode
/// whose tip amplitude is the gap).
enum class EnergyMeasure {
  total,         ///< E = kinetic + elastic energy, constant in time
  mean_kinetic,  ///< the period mean of the kinetic energy
  modal          ///< gamma = mean kinetic energy / omega^2, the abscissa of [LL10, Figs. 3 and 7]
};

/// The exact nonsmooth modes of that bar, by d'Alembert:
///
///     u(x, t) = f(t + x) - f(t - x),   f' = +V on an interval of m T - 2 of each period T, -V on the rest
///
/// in units L = c = 1 (c^2 = E/rho). Mode m = 1, 2, ... touches once a period, for (2m+1)/m^2 < T < 4/(2m-1),
/// with V = g0 / (2 m^2 T - 4m - 2), over the time 4 - (2m-1) T around t = 0, with the constant contact force
/// 2V. Its total energy is 2 V^2, the period mean of the kinetic energy
/// V^2 (m T - 2) (4m + 2 - m (2m-1) T) / T. Its frequency lies between the linear one, omega_m = (2m-1) pi/2,
/// and 4 m^2 / (4 m^2 - 1) of it; m = 1: T in (3, 4), frequency ratio 4/T in (1, 4/3).
///
/// A motion of the shortest period, with any V, is one at zero gap: see zero_gap(). All quantities below are
/// in the units of the bar. Displacements carry an error of a few eps times the largest displacement of the
/// motion, which exceeds the gap by far at high energy. Functions of (x, t) throw std::invalid_argument for x
/// outside the bar; t may be any time. An argument that is not a number gives results that are not a number.
/// O(1). Immutable.
class ExactBarMode {
 public:
  /// mode >= 1; frequency_ratio = omega / omega_m within the open interval above: std::invalid_argument
  /// otherwise, naming the interval.
  ExactBarMode(RigidObstacleBar bar, int mode, double frequency_ratio);

  /// The mode at a given energy ratio. Each measure falls with T, from infinity to its value at the linear
  /// limit; at or below that (total: 8/pi^2 for m = 1) there is no such mode: std::invalid_argument naming
  /// the limit. The relative error of the energy is a few eps at any size, because the unknown is the
  /// difference of T from the shortest period. At energies above 1e30 frequency_ratio() has rounded to its
  /// supremum. O(log 1/eps).
  static ExactBarMode at_energy(RigidObstacleBar bar, int mode, EnergyMeasure measure, double energy_ratio);

  /// The mode of the bar that touches the obstacle at rest: gap 0 (bar.gap is not used), where the period is
  /// (2m+1)/m^2 at every energy. It is the limit T -> (2m+1)/m^2 at fixed V. total_energy > 0, in J:
  /// std::invalid_argument otherwise. Half a period after the middle of the contact, mode 1 is at rest with
  /// u = -2 V x: the bar pulled back from the obstacle and let go. Ratios of energy are infinite.
  static ExactBarMode zero_gap(RigidObstacleBar bar, int mode, double total_energy);

  /// The energy ratio at which the exact branch starts, T -> 4/(2m-1).
  static double onset_energy(int mode, EnergyMeasure measure);
  /// The supremum of the frequency ratio, where energies grow without bound.
  static double largest_frequency_ratio(int mode);
  /// Hz, frequency of the linear mode, (2m-1) c / (4 L).
  static double linear_frequency(const RigidObstacleBar& bar, int mode);

  int mode() const { return mode_; }
  const RigidObstacleBar& bar() const { return bar_; }
  double frequency_ratio() const;   ///< omega / omega_m
  double frequency() const;         ///< Hz
  double period() const;            ///< s
  double contact_duration() const;  ///< s

  double displacement(double x, double t) const;  ///< m, 0 <= x <= length; t = 0 is the middle of the contact
  double velocity(double x, double t) const;      ///< m/s; at a front, the mean of both sides
  double strain(double x, double t) const;        ///< u_x; at a front, the mean of both sides
  double contact_force(double t) const;           ///< N, >= 0: -E A u_x at the tip
  double total_energy() const;                    ///< J
  double mean_kinetic_energy() const;             ///< J
  double energy_ratio(EnergyMeasure measure) const;
  /// sqrt of the generalised Rayleigh quotient over omega_m [LL10, eq. (10)], what LL10 reports as the
  /// frequency.
  double rayleigh_frequency_ratio() const;

 private:
  struct Excess {
    double value;
  };
  ExactBarMode(const RigidObstacleBar& bar, int mode, Excess excess, double amplitude);

  double phase(double t) const;                           // t in units L/c, within half a period of 0
  double position(const char* quantity, double x) const;  // x / length
  double sign(double s) const;                            // f' / V, units L = c = 1
  double primitive(double s) const;                       // f / V with f(0) = 0

  RigidObstacleBar bar_;
  int mode_;
  double excess_;     // T - (2m+1)/m^2, units L = c = 1: what high energies depend on
  double period_;     // T, units L = c = 1
  double amplitude_;  // V, a strain
};

}  // namespace wavebalance::ll10
