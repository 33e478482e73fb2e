#include "results/record_parts.hpp"

#include <cstdlib>

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "matrices/structure_files.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// The first unbalance that turns in a plane of two rows; null without.
const ForcingTerm* turning_unbalance(const Scene& scene) {
  const auto& terms = scene.forcing.terms;
  const auto found = std::ranges::find_if(terms, [](const ForcingTerm& term) {
    return term.kind == LoadKind::unbalance && term.dofs.size() == 2;
  });
  return found == terms.end() ? nullptr : &*found;
}

bool ring_has_rows_of(const ForcingTerm& unbalance, const std::vector<SceneContact>& contacts) {
  for (std::size_t i = 0; i + 1 < contacts.size(); ++i)
    if (acts_in_plane(contacts[i].law) && contacts[i].dofs == std::vector{std::abs(unbalance.dofs[0])} &&
        contacts[i + 1].dofs == std::vector{std::abs(unbalance.dofs[1])})
      return true;
  return false;
}

/// A ring is one plane, an unbalance another unless the ring has its rows.
std::vector<OrbitPlane> planes_of(const Scene& scene, bool with_unbalance) {
  std::vector<OrbitPlane> planes;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const ForcingTerm* unbalance = with_unbalance ? turning_unbalance(scene) : nullptr;
  if (unbalance != nullptr) {
    const auto files = structure_files(scene);
    planes.push_back({fmt::format("Unbalance, {} and {}", files->row_name(std::abs(unbalance->dofs[0]) - 1),
                                  files->row_name(std::abs(unbalance->dofs[1]) - 1)),
                      missing,
                      {}});
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (acts_in_plane(contacts[i].law) && contacts[i].place == 0)
      planes.push_back({whole_name_of(contacts[i]), contacts[i].gap, {}});
  return planes;
}

/// Adds the orbits of one motion: `plane`: of the unbalance, 2 x points or empty.
void add_orbits(std::vector<OrbitPlane>& planes, const Scene& scene, const std::string& motion,
                const Eigen::MatrixXd& plane, const Eigen::MatrixXd& contacts) {
  std::size_t next = 0;
  if (plane.size() > 0) planes[next++].orbits.push_back({motion, plane.row(0), plane.row(1)});
  const std::vector<SceneContact> all = contact_places(scene);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (acts_in_plane(all[i].law) && all[i].place == 0)
      planes[next++].orbits.push_back(
          {motion, contacts.row(Eigen::Index(i)), contacts.row(Eigen::Index(i) + 1)});
}

/// The columns of one motion have its name before them where there are several.
void append_planes(Record& record, const std::vector<OrbitPlane>& planes) {
  if (planes.empty() || planes.front().orbits.empty()) return;
  Table table;
  table.add_column("time_fraction", time_fractions(int(planes.front().orbits.front().x.size())));
  for (std::size_t k = 0; k < planes.front().orbits.size(); ++k)
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Orbit& orbit = planes[i].orbits[k];
      const std::string motion = orbit.motion.empty() ? "" : fmt::format("motion_{}_", k + 1),
                        name = motion + (planes.size() > 1 ? fmt::format("orbit_{}_", i + 1) : "");
      table.add_column(name + "x_m", orbit.x).add_column(name + "y_m", orbit.y);
    }
  record.files.push_back({"orbits.csv", csv_text(table), "orbits over one period"});
  record.output_pictures.push_back({"orbits", orbits_figure(planes), "y over x in the planes of a rotor"});
}

/// "45 Hz", "peak, 48.32 Hz"
std::string name_of(const CurveMotion& motion, const SweepAxis& axis) {
  const std::string place = quantity(motion.place, axis.unit, 6);
  return motion.at == axis.quantity ? place : spaced_words(motion.at) + ", " + place;
}

}  // namespace

bool has_unbalance_orbit(const Scene& scene) {
  constexpr int most = 2000;  // coordinates, whose motions are kept at all output points
  if (scene.structure.type != StructureType::matrices || reduced_size(scene) > most) return false;
  const ForcingTerm* unbalance = turning_unbalance(scene);
  return unbalance != nullptr && !ring_has_rows_of(*unbalance, contact_places(scene));
}

void append_orbits(Record& record, const Scene& scene, const StructureModel& model,
                   const Response& response) {
  if (!response.moves || response.contacts.empty()) return;
  Eigen::MatrixXd plane;
  if (has_unbalance_orbit(scene) && response.structure.displacement.cols() == response.contacts.points())
    plane = model.plane * response.structure.displacement;
  std::vector<OrbitPlane> planes = planes_of(scene, plane.size() > 0);
  if (planes.empty()) return;
  add_orbits(planes, scene, "", plane, response.contacts.displacement);
  append_planes(record, planes);
}

void append_orbits(Record& record, const Scene& scene, const std::vector<CurveMotion>& motions) {
  if (motions.empty()) return;
  const bool with_unbalance = has_unbalance_orbit(scene) && motions.front().plane.size() > 0;
  std::vector<OrbitPlane> planes = planes_of(scene, with_unbalance);
  if (planes.empty()) return;
  for (const CurveMotion& motion : motions)
    add_orbits(planes, scene, name_of(motion, record.axis), with_unbalance ? motion.plane : Eigen::MatrixXd(),
               motion.contacts.displacement);
  append_planes(record, planes);
}

}  // namespace wavebalance::app
