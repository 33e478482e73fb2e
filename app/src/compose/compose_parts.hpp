#pragma once
#include <initializer_list>

#include "scene/scene_document.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::app {

/// Loads and contacts of a structure before its reduction: see solvers::LinearStructure.
struct Loads {
  Eigen::VectorXd load;
  std::vector<solvers::PeriodicForce> forces;
};

/// Coordinates that a reduction keeps in addition to its modes.
struct Kept {
  std::vector<int> boundary;
  Eigen::SparseMatrix<double> merging = {};  ///< merging() of coordinates of several unknowns, or 0 x 0
};

/// Sets the structure of a model from matrices, reduced to the boundary and so many modes. Modes and static
/// deflections follow from the symmetric parts of the matrices. Their skew parts, gyroscopic and
/// circulatory forces, are projected on them.
void reduce(StructureModel& model, const fem::Matrices& matrices, const Loads& loads,
            const solvers::ContactDirections& directions, const Kept& kept, int kept_modes,
            const solvers::Observer& observer, const solvers::TurningParts& turning = {});

/// Throws SceneError at the first of `names` that the scene holds; if there is none, at the first one's
/// section.
[[noreturn]] void fail_rule(const Document& document, std::initializer_list<std::string_view> names,
                            const std::string& rule);

/// Checks that the laws of contact can be made from their constants and files, and that the analysis
/// supports them. Throws SceneError.
void check_laws(const Document& document, const Scene& scene);

/// Checks the rules between the keys of a scene's structure, and its files, which are read and kept in the
/// scene. Throws SceneError.
void check_structure_rules(const Document& document, Scene& scene);

/// Checks that each series of the loads has what its file and the functions can hold. Throws SceneError.
void check_loads(const Document& document, const Scene& scene);

/// Checks functions, quadrature and the pair of bases of a balance. Throws SceneError.
void check_time(const Document& document, const Scene& scene);

/// Checks the keys of a nonlinear mode. Throws SceneError.
void check_mode(const Document& document, const Scene& scene);

/// Checks the keys of a limit cycle. Throws SceneError.
void check_without_load(const Document& document, const Scene& scene);

/// Checks the rules between the keys of a scene, each of which is valid by itself: sizes of wavelet bases,
/// quadrature, admissible pairs, sweeps, sizes of time stepping, the structure's rules. Throws SceneError at
/// the key at fault.
void check_scene_rules(const Document& document, Scene& scene);

/// Checks analysis.outputs, contact_outputs and peak_of.
void check_outputs(const Document& document, const Scene& scene);

/// The interval of a sweep or a diagram, and the load that varies.
void check_sweep(const Document& document, const Scene& scene);
/// Records of time stepping and of diagrams.
void check_records(const Document& document, const Scene& scene);

/// Appends a degree of freedom for each periodic stiffness: a spring without mass, whose load makes it the
/// signal that the second row of the law is. O(entries).
void append_signals(solvers::LinearStructure& structure, const Scene& scene);
/// The same, and that it moves nothing of the whole structure.
void append_signals(StructureModel& model, const Scene& scene);

/// Sets the motions of supports that are added to an output for its frame of reference, and the support
/// motion that a transmissibility divides by, with its derivative. Throws std::invalid_argument where the
/// loads of the scene have no such frame.
void set_frame(Output& output, const OutputWords& words, const Scene& scene);

}  // namespace wavebalance::app
