#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The motion of the whole structure from the reduced one (r x frames, uniform over the period): with a
/// mesh a series for ParaView, whose times are fractions of the period, with displacement and stress;
/// without one motion.mtx, a Matrix Market array of a column an instant. Nothing for no frames. `name`
/// replaces "motion" in the names of the files.
std::vector<RecordFile> motion_files(const StructureModel& model, const Eigen::MatrixXd& coordinates,
                                     const std::string& name = "motion");

/// One of several motions of a record.
struct WrittenMotion {
  const solvers::Motion& contacts;
  int contact;                       ///< the leading one
  const Eigen::MatrixXd& structure;  ///< coordinates of motion_files()
  Table impacts = {};                ///< impacts_table(); without columns: none
};

/// Its files: NAME.csv of the contact with the largest force, NAME_contacts.csv of all if there are
/// several, NAME_impacts.csv, and files of the structure. `about` describes the motion.
void append_motion_files(Record& record, const Scene& scene, const StructureModel& model,
                         const WrittenMotion& motion, const std::string& name, const std::string& about);

}  // namespace wavebalance::app
