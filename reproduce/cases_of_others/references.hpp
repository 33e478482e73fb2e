#pragma once
#include <complex>
#include <utility>
#include <vector>

#include "wavebalance/solvers/stability/curve_stability.hpp"

/// What is known of the cases from elsewhere.
namespace wavebalance::cases::references {

using Type = solvers::SpecialPointType;

/// Shooting on event-driven exact pieces: between the instants at which contact begins and ends the motion is
/// that of a linear structure. Grazings are in closed form. Frequencies to 1e-9.
inline constexpr const char* shooting = "event-driven shooting";

/// A special point, its frequency in the unit of the case.
struct KnownPoint {
  Type type;
  double frequency;
};

/// pyHarm, tests/nonregression/NonRegressionData/onedofgap/ref_sol.csv: frequency (rad/s), and the norm of
/// all harmonics over the gap. 7 harmonics, 1024 points. Between the points of its curve, 0.1 of arc length
/// apart, the file interpolates along straight lines, which err by up to 4e-4.
inline constexpr const char* pyharm = "pyHarm's reference solution";
inline constexpr double pyharm_tolerance = 5e-4;
inline const std::vector<std::pair<double, double>> pyharm_amplitudes{
    {2.0, 0.2776},    {5.2305, 0.7654}, {6.2170, 1.0586}, {7.5193, 1.3673}, {8.0631, 1.6055},
    {8.5324, 1.8410}, {7.5208, 1.1233}, {7.0579, 1.0164}, {9.0028, 0.2413}, {12.0029, 0.0958}};
inline constexpr double pyharm_first = 0.2776064686170019;  ///< at 2 rad/s, without interpolation
inline const std::vector<KnownPoint> pyharm_points{{Type::grazing, 5.534678554},
                                                   {Type::period_doubling, 5.556718794},
                                                   {Type::period_doubling, 5.707909282},
                                                   {Type::fold, 8.566393659},
                                                   {Type::fold, 6.997628119},
                                                   {Type::grazing, 6.997666276}};

/// A harmonic of a motion: its number, its amplitude, and what that is good for.
struct KnownHarmonic {
  int number;
  double amplitude, tolerance;
};

/// NLvib 1.3, EXAMPLES/03: amplitudes of harmonics of u1 at a frequency (rad/s). 21 harmonics, 1024 points.
/// The curve of 1024 points zigzags: at one frequency it has three motions, whose harmonics differ by
/// 6e-4, 1.1e-4 and 3e-5. The four digits of the frequency add 2e-5, 8e-5 and 3e-5.
inline constexpr const char* nlvib = "NLvib, 21 harmonics";
inline constexpr double nlvib_frequency = 0.7541;
inline const std::vector<KnownHarmonic> nlvib_harmonics{
    {1, 1.326954, 6.2e-4}, {3, 0.093190, 1.9e-4}, {5, 0.026339, 6e-5}};
inline const std::vector<KnownHarmonic> nlvib_exact_harmonics{
    {1, 1.3251418, 1e-5}, {3, 0.0930403, 1e-5}, {5, 0.0263522, 1e-5}};
inline const std::vector<KnownPoint> nlvib_points{{Type::grazing, 0.6534401405},
                                                  {Type::fold, 0.6534401345},
                                                  {Type::fold, 0.755627353},
                                                  {Type::period_doubling, 0.755586159},
                                                  {Type::period_doubling, 0.738783025},
                                                  {Type::neimark_sacker, 0.618606874},
                                                  {Type::neimark_sacker, 0.5819006504},
                                                  {Type::grazing, 0.5818996390}};

/// The oscillator with a stop, rad/s.
inline const std::vector<KnownPoint> oscillator_points{{Type::grazing, 2.999062609918},
                                                       {Type::period_doubling, 2.973736781998},
                                                       {Type::period_doubling, 2.206199894019}};
struct KnownMotion {
  double frequency;  ///< rad/s
  std::complex<double> multiplier;
  double contact;  ///< fraction of the period
};
inline const std::vector<KnownMotion> oscillator_motions{{2.0, {-0.25616405, 0.81534206}, 0.2265369217},
                                                         {2.3, {-1.77764006, 0.0}, 0.2071673601},
                                                         {2.5, {-2.55458961, 0.0}, 0.1863299386},
                                                         {2.8, {-2.56680525, 0.0}, 0.1330697175}};

/// The mass on an elastic slider: motions at a frequency (rad/s), with the work of friction in a period and
/// the modulus of the leading multiplier, and the motion of its mode, without damper, that turns at 2.
struct KnownSlip {
  double frequency, displacement, harmonic, work, multiplier;
};
inline const std::vector<KnownSlip> slider_motions{
    {1.2, 5.030259141, 5.002826509, 16.12103657, 0.64754840},
    {1.0, 15.30050151, 15.24880669, 57.20200604, 0.85325385},
    {0.45, 1.118791905, 1.097855263, 0.4751676217, 0.34209596}};
struct KnownMode {
  double amplitude;  ///< of the first harmonic, over that of first slip
  double omega, damping_ratio;
};
inline constexpr KnownMode slider_mode{2.000767809, 1.225867690198, 0.105752880426};

/// Recipes for Continuation [H. Dankowicz, F. Schilder, SIAM 2013], example 15.2, and where a motion without
/// contact reaches a gap.
inline constexpr const char* coco = "Recipes for Continuation, example 15.2";
inline constexpr const char* closed_form = "closed form";

/// The bars, Hz.
inline constexpr const char* modal_shooting = "shooting with exact modal pieces";
inline const std::vector<KnownPoint> small_gap_points{
    {Type::grazing, 2734.115878}, {Type::period_doubling, 2840.476702}, {Type::period_doubling, 2988.746353}};
inline const std::vector<KnownPoint> lightly_damped_points{{Type::neimark_sacker, 1312.442975},
                                                           {Type::neimark_sacker, 1378.541283}};

/// What the discretisations of the scenes are good for: the change of a frequency when their functions are
/// halved, rounded up. 63 harmonics of the bars: 0.02 Hz.
inline constexpr double pyharm_point_tolerance = 5e-5, nlvib_point_tolerance = 2e-5,
                        oscillator_point_tolerance = 1e-6, bar_point_tolerance = 0.02;

}  // namespace wavebalance::cases::references
