#include "attractors/flow_rows.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"

namespace wavebalance::app {
namespace {

/// Only the places of analysis.outputs, each once, without contacts: rows have displacements in SI units.
std::vector<Output> output_rows(Scene scene) {
  scene.analysis.contact_outputs = false;
  std::vector<std::string> places;
  for (const std::string& text : scene.analysis.outputs)
    if (std::string place = output_words(text).place; std::ranges::find(places, place) == places.end())
      places.push_back(std::move(place));
  scene.analysis.outputs = std::move(places);
  return outputs_of(scene);
}

StructureModel with_outputs(const Scene& scene, const StructureModel& model) {
  const std::vector<Output> outputs = output_rows(scene);
  if (outputs.empty()) return model;
  StructureModel wider = model;
  const Eigen::MatrixXd rows = rows_of_outputs(outputs, scene, model);
  Eigen::MatrixXd directions(model.contacts() + rows.rows(), model.size());
  directions << Eigen::MatrixXd(model.structure.contact_directions), rows;
  wider.structure.contact_directions = directions.sparseView();
  wider.gaps.conservativeResize(directions.rows());
  wider.gaps.tail(rows.rows()).setZero();
  wider.dynamics = std::make_shared<solvers::StructureDynamics>();
  return wider;
}

solvers::ContactLaws laws_with_outputs(const Scene& scene, int contacts) {
  const std::size_t outputs = output_rows(scene).size();
  const auto with_outputs = [contacts, outputs](const solvers::ContactLaws& laws) -> solvers::ContactLaws {
    std::vector<solvers::AnyContactLaw> each;
    for (int row = 0; row < contacts; row += laws[row].rows()) each.push_back(laws[row]);
    each.resize(each.size() + outputs);  // of no law
    return each;
  };
  const solvers::ContactLaws laws = make_laws(scene);
  if (!laws.follow_frequency()) return with_outputs(laws);
  return solvers::ContactLaws::over_frequency(
      [laws, with_outputs](double frequency) { return with_outputs(laws.at(frequency)); },
      load_frequency(scene));
}

std::vector<MotionPlace> places_of(const Scene& scene) {
  std::vector<MotionPlace> places;
  for (const SceneContact& one : contacts_of(scene))
    places.push_back({name_of(one), displacement_unit(scene, one), one.number, false});
  for (const Output& one : output_rows(scene)) places.push_back({one.name, one.unit, 0, true});
  return places;
}

/// Loads need a pair, which is not used.
Scene paired_scene(const Scene& scene) {
  Scene paired = scene;
  paired.time = balance_of(scene, least_start_functions(scene)).time;
  return paired;
}

}  // namespace

FlowRows::FlowRows(const Scene& scene, const StructureModel& model)
    : over_amplitude_(is_over_amplitude(scene.analysis)),
      contacts_(model.contacts()),
      model_(with_outputs(scene, model)),
      laws_(laws_with_outputs(scene, model.contacts())),
      places_(places_of(scene)),
      problem_(make_problem(paired_scene(scene), model_)) {}

solvers::ExactProblem FlowRows::at(double value) {
  if (over_amplitude_)
    problem_.set_load_scale(value);
  else
    problem_.set_load_frequency(value);
  return here();
}

solvers::ExactProblem FlowRows::here() { return solvers::exact_problem(problem_, laws_, *dynamics()); }

}  // namespace wavebalance::app
