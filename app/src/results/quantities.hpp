#pragma once
#include <algorithm>
#include <array>

#include "wavebalance/app/files/summary.hpp"

/// The values of records that have a unit or words, or that are read again, each named in this one place.
/// Others are written by their name where they are known.
namespace wavebalance::app::quantities {

using enum EntryKind;

inline constexpr Quantity converged{"converged", heading}, status{"status", heading},
    analysis{"analysis", heading}, wall_seconds{"wall_seconds", heading, "s"},
    solve_seconds{"solve_seconds", heading, "s"}, reduction_seconds{"reduction_seconds", heading, "s"};

inline constexpr Quantity frequency{"frequency_Hz", setting, "Hz", "frequency"}, mode{"mode", setting},
    linear_frequency{"linear_frequency_Hz", setting, "Hz", "linear frequency"},
    subharmonic{"subharmonic", setting}, start_from{"start_from", setting}, tolerance{"tolerance", setting},
    trial{"trial", setting}, weight{"weight", setting}, formulation{"formulation", setting},
    inner_products{"inner_products", setting}, functions{"functions", setting},
    quadrature_points{"quadrature_points", setting}, sample_offset{"sample_offset", setting},
    nyquist{"nyquist", setting}, harmonics{"harmonics", setting}, samples{"samples", setting},
    contacts{"contacts", setting}, displacement_unit{"displacement_unit", setting},
    contact_directions{"contact_directions", setting}, degrees_of_freedom{"degrees_of_freedom", setting},
    reduced_degrees_of_freedom{"reduced_degrees_of_freedom", setting};

inline constexpr Quantity residual{"residual"}, form{"form"}, warnings{"warnings"},
    estimated_error{"estimated_error"}, ladder_seconds{"ladder_seconds", diagnostic, "s"},
    phases_status{"phases_status"}, error_of_vibration{"error_of_vibration"},
    error_of_displacement{"error_of_displacement"}, peak_value_resolution{"peak_value_resolution"},
    peak_place_resolution{"peak_place_resolution"}, error_of_force{"error_of_force"},
    contact_intervals{"phases"}, solved_by{"solved_by"}, points{"points"}, points_tongue{"points_tongue"},
    tongues{"tongues"}, stability{"stability"}, stability_by{"stability_by"},
    points_stability_not_known{"points_stability_not_known"}, stability_not_known{"stability_not_known"},
    unstable_parts{"unstable_parts"}, special_points{"special_points"}, random_starts{"random_starts"},
    motions{"motions"}, structure_curve{"structure_curve"},
    structure_special_points{"structure_special_points"}, other_motions{"other_motions"}, isola{"isola"},
    isolas{"isolas"}, isola_frequencies{"isola_frequencies"}, isola_starts{"isola_starts"},
    isola_seconds{"isola_seconds", diagnostic, "s"}, outputs{"outputs"},
    endless_time{"endless_time_s", diagnostic, "s"};

inline constexpr Quantity max_displacement{"max_displacement_m", result, "m", "max displacement"},
    min_displacement{"min_displacement_m", result, "m", "min displacement"},
    rms_displacement{"rms_displacement_m", result, "m", "rms displacement"},
    vibration{"vibration_m", result, "m", "vibration"},
    rms_vibration{"rms_vibration_m", result, "m", "rms vibration"},
    max_contact_force{"max_contact_force_N", result, "N", "max contact force"},
    contact_fraction{"contact_fraction", result},
    contact_dissipation{"contact_dissipation_J", result, "J", "contact dissipation"},
    friction_work{"friction_work_J", result, "J", "friction work"}, wear{"wear_m3", result, "m3", "wear"},
    friction{"friction", result}, max_slip_fraction{"max_slip_fraction", result},
    max_open_fraction{"max_open_fraction", result},
    equivalent_damping_ratio{"equivalent_damping_ratio", result}, impacts{"impacts", result},
    max_impulse{"max_impulse_Ns", result, "N s", "max impulse"},
    max_impact_velocity{"max_impact_velocity_m_per_s", result, "m/s", "max impact velocity"},
    impact_energy{"impact_energy_J", result, "J", "impact energy"},
    lasting_contacts{"lasting_contacts", result},
    max_penetration{"max_penetration_m", result, "m", "max penetration"},
    min_contact_force{"min_contact_force_N", result, "N", "min contact force"},
    complementarity{"complementarity", result}, leading_contact{"leading_contact", result},
    leading_contact_name{"leading_contact_name", result}, leading_direction{"leading_direction", result},
    leading_output{"leading_output"}, period_of_motion{"period_of_motion", result},
    change_after_one_period{"change_after_one_period", result},
    unstable_multipliers{"unstable_multipliers", result}, settled_periods{"settled_periods", result},
    settled_max_displacement{"settled_max_displacement_m", result, "m", "attractor max displacement"},
    leading_multiplier_real{"leading_multiplier_real", result},
    leading_multiplier_imag{"leading_multiplier_imag", result},
    leading_multiplier_error{"leading_multiplier_error", result};

// Quantities of motions that do not repeat, with half the width of their 95 % confidence intervals, and of
// diagrams.
inline constexpr std::string_view aperiodic = "aperiodic";  ///< the status of such a record
inline constexpr Quantity lyapunov_exponent{"lyapunov_exponent", result},
    lyapunov_exponent_error{"lyapunov_exponent_error", result}, curve_residual{"curve_residual", result},
    second_frequency{"second_frequency_Hz", result, "Hz", "second frequency"},
    rotation_number{"rotation_number", result},
    rms_displacement_error{"rms_displacement_error_m", result, "m", "error of rms displacement"},
    rms_vibration_error{"rms_vibration_error_m", result, "m", "error of rms vibration"},
    mean_contact_force{"mean_contact_force_N", result, "N", "mean contact force"},
    mean_contact_force_error{"mean_contact_force_error_N", result, "N", "error of mean contact force"},
    friction_work_error{"friction_work_error_J", result, "J", "error of friction work"},
    wear_error{"wear_error_m3", result, "m3", "error of wear"}, impacts_error{"impacts_error", result},
    impact_energy_error{"impact_energy_error_J", result, "J", "error of impact energy"};
inline constexpr Quantity diagram_values{"values", setting}, aperiodic_values{"aperiodic_values", result},
    quasi_periodic_values{"quasi_periodic_values", result}, hysteresis_values{"hysteresis_values", result},
    longest_found{"longest_period_found", result};

// Quantities of nonlinear modes.
inline constexpr Quantity energy_ratio{"energy_ratio", result}, frequency_ratio{"frequency_ratio", result},
    rayleigh_frequency_ratio{"rayleigh_frequency_ratio", result}, virial_residual{"virial_residual", result},
    largest_energy_ratio{"largest_energy_ratio", result},
    largest_frequency_ratio{"largest_frequency_ratio", result},
    max_penetration_over_gap{"max_penetration_over_gap", result};
// Quantities of modes with friction.
inline constexpr Quantity linear_damping_ratio{"linear_damping_ratio", setting},
    slip_amplitude{"slip_amplitude_m", result, "m", "amplitude at which a contact first acts"},
    damping_ratio{"damping_ratio", result}, largest_damping_ratio{"largest_damping_ratio", result},
    least_frequency_ratio{"least_frequency_ratio", result};

/// Where a curve is highest: at a frequency, or at an amplitude in the unit of its load.
inline constexpr std::array peak_places{
    Quantity{"frequency_at_max_displacement_Hz", result, "Hz", "frequency at max displacement"},
    Quantity{"amplitude_at_max_displacement_N", result, "N", "amplitude at max displacement"},
    Quantity{"amplitude_at_max_displacement_m", result, "m", "amplitude at max displacement"},
    Quantity{"amplitude_at_max_displacement_m_per_s2", result, "m/s^2", "amplitude at max displacement"},
    Quantity{"amplitude_at_max_displacement_g", result, "g", "amplitude at max displacement"},
    Quantity{"amplitude_at_max_displacement_kg_m", result, "kg m", "amplitude at max displacement"}};

/// Where the vibration of contacts along a curve is largest.
inline constexpr std::array vibration_places{
    Quantity{"frequency_at_largest_vibration_Hz", result, "Hz", "frequency at largest vibration"},
    Quantity{"amplitude_at_largest_vibration_N", result, "N", "amplitude at largest vibration"},
    Quantity{"amplitude_at_largest_vibration_m", result, "m", "amplitude at largest vibration"},
    Quantity{"amplitude_at_largest_vibration_m_per_s2", result, "m/s^2", "amplitude at largest vibration"},
    Quantity{"amplitude_at_largest_vibration_g", result, "g", "amplitude at largest vibration"},
    Quantity{"amplitude_at_largest_vibration_kg_m", result, "kg m", "amplitude at largest vibration"}};

/// The one of these places for a curve over a frequency or an amplitude in `unit`.
constexpr const Quantity& in_unit(const std::array<Quantity, 6>& places, std::string_view unit) {
  return *std::ranges::find(places, unit, &Quantity::unit);
}

/// The quantity with words that a column of a table holds; null for others.
constexpr const Quantity* find_in_words(std::string_view column) {
  for (const Quantity* one :
       {&frequency, &linear_frequency, &max_displacement, &min_displacement, &rms_displacement, &vibration,
        &rms_vibration, &max_contact_force, &contact_dissipation, &friction_work, &wear, &slip_amplitude,
        &max_penetration, &min_contact_force})
    if (one->name == column) return one;
  for (const auto* places : {&peak_places, &vibration_places})
    for (const Quantity& one : *places)
      if (one.name == column) return &one;
  return nullptr;
}

}  // namespace wavebalance::app::quantities
