#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/scene/structure.hpp"

namespace wavebalance::app {

/// Place of the load on a blade's tip.
enum class TipPlace { leading_edge, mid_chord, trailing_edge };
/// Kind of a further load, forcing.terms.kind: a force, or the motion of supports.
enum class LoadKind { force, base_displacement, base_acceleration, unbalance };

/// One entry of [[forcing.terms]]: amplitude cos(harmonic 2 pi frequency t + phase), or amplitude times a
/// periodic function given by samples.
struct ForcingTerm {
  LoadKind kind = LoadKind::force;
  int harmonic = 1;        ///< of Forcing::frequency; 0: static, without phase
  double amplitude = 1.0;  ///< in unit_of() the term
  std::string unit = {};   ///< for a base_acceleration "g"; empty: SI
  /// CSV file with the columns frequency_Hz, amplitude and phase_degrees, which may be left out: factors on
  /// amplitude and phases added to phase, over Forcing::frequency or along a sweep; or empty.
  std::string amplitude_table = {};
  double phase = 0.0;          ///< degrees ahead of a cosine
  std::string samples = {};    ///< CSV file, its last column one period at uniform times; or empty
  std::vector<int> dofs = {};  ///< matrices: as Forcing::load_dofs; empty: where Forcing::amplitude acts
  std::vector<double> coefficients = {};  ///< as Forcing::load_coefficients
  std::string load = {};                  ///< matrices: of a force, as Forcing::load; or empty
  /// Matrices with a dof map: along which a base_acceleration moves all nodes, "x" or "-z"; empty: dofs.
  std::string direction = {};

  bool operator==(const ForcingTerm&) const = default;
};

/// The force amplitude * cos(2 pi frequency t), at a bar's tip; along load (1/1) of matrices; at one place of
/// a blade's tip; and the terms. Nonlinear modes do not use it.
struct Forcing {
  double amplitude = 0.0;                      ///< N
  std::string amplitude_table = {};            ///< factors on it, as ForcingTerm::amplitude_table; or empty
  double frequency = 0.0;                      ///< Hz, > 0; a frequency sweep does not use it
  std::string load = {};                       ///< matrices: Matrix Market file of n values, or empty
  std::vector<int> load_dofs = {};             ///< matrices: from 1, each with value 1; -i: dof i with -1
  std::vector<double> load_coefficients = {};  ///< of each of load_dofs, the part of the force; empty: 1
  TipPlace place = TipPlace::leading_edge;     ///< blade
  Direction direction = Direction::y;          ///< blade
  /// Matrices with a dof map: m/s^2 along x, y and z, the static acceleration that all masses feel; or empty.
  std::vector<double> weight = {};
  std::vector<ForcingTerm> terms = {};  ///< in addition to it

  bool operator==(const Forcing&) const = default;
};

/// Unit of the amplitude of a term: "N", "m", "m/s^2" or "kg m", mass times eccentricity of an unbalance.
std::string_view unit_of(LoadKind kind);
/// Unit of the amplitude of a term; may be "g".
std::string_view unit_of(const ForcingTerm& term);
inline constexpr double standard_gravity = 9.80665;  ///< m/s^2 in a g

/// The load whose amplitude an amplitude sweep varies, with all others in proportion: Forcing::amplitude or,
/// where that is 0, the first term that is not static. Null without any.
struct ReferenceLoad {
  double amplitude;       ///< of the scene
  std::string_view unit;  ///< of unit_of()
};
std::optional<ReferenceLoad> reference_load(const Forcing& forcing);

}  // namespace wavebalance::app
