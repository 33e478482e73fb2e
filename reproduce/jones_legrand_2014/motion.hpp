#pragma once
#include <string>
#include <vector>

#include "jl14.hpp"

namespace wavebalance::jl14 {

/// The motion of the bar over a period as JSON, in SI units with six significant digits, for a picture that
/// moves: gap, amplitude, frequency, length; time, n fractions of the period; pairs and reference, each
/// with label, name, nodes (n lists of the displacements of the nodes from the clamped end to the tip), tip
/// and force (n values each, the force over the amplitude). `responses` are in the order of pairs() with
/// the whole structure; those that have not converged are left out. `nodes` belong to the reference, a
/// table of node_columns(). Its instants are a subset of the responses' instants.
std::string motion_json(const Case& study, const std::vector<app::Response>& responses, const Table& nodes);
/// Attaches it as motion_case<N>.json and as the script that the page moves.
void attach_motion(report::Artefact& artefact, const Case& study,
                   const std::vector<app::Response>& responses);

/// The displacements of a bar at 128 uniform instants: time_fraction, node_1_m, ... without the clamped node.
Table node_columns(const solvers::Motion& structure);

}  // namespace wavebalance::jl14
