#include "wavebalance/app/analysis/measures.hpp"

#include <fmt/format.h>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::app {

double rms(const Eigen::VectorXd& values) {
  return values.stableNorm() / std::sqrt(static_cast<double>(values.size()));
}

double relative_rms_error(const Eigen::VectorXd& values, const Eigen::VectorXd& reference) {
  if (values.size() != reference.size())
    throw std::invalid_argument(fmt::format(
        "relative_rms_error: there are {} values and {} of the reference; their numbers must be equal",
        values.size(), reference.size()));
  return rms(values - reference) / rms(reference);
}

Eigen::VectorXd system_energy(const Scene& scene, const solvers::Motion& motion) {
  const solvers::LinearStructure structure = make_structure(scene);
  if (motion.rows() != structure.size() || motion.velocity.rows() != structure.size() ||
      motion.velocity.cols() != motion.points())
    throw std::invalid_argument(
        fmt::format("system_energy: the motion holds {} degrees of freedom; it must hold all {}",
                    motion.rows(), structure.size()));
  // A rigid obstacle stores no energy.
  const bool rigid = is_rigid(scene.contact.law);
  return solvers::system_energy(structure, rigid ? solvers::ContactLaws() : make_laws(scene), motion);
}

double energy_norm(const Scene& scene, const solvers::Motion& motion) {
  return rms(system_energy(scene, motion));
}

double contact_fraction(const solvers::Motion& motion) {
  return (motion.force.array() > 0.0).cast<double>().mean();
}

double largest_contact_force(const Scene& scene, const solvers::Motion& contacts, int row) {
  const SceneContact place = contact_places(scene).at(static_cast<std::size_t>(row));
  if (!acts_in_plane(place.law)) return contacts.force.row(row).maxCoeff();
  return contacts.force.middleRows(row - place.place, place.directions).colwise().norm().maxCoeff();
}

double contact_fraction(const Scene& scene, const solvers::Motion& contacts, int row) {
  const SceneContact place = contacts_of(scene).at(static_cast<std::size_t>(row));
  if (has_friction(place.law)) {
    const bool has_normal = contact::number_of(place.values, "tangents") < place.directions;
    return has_normal ? (contacts.force.row(row - place.place).array() > 0.0).cast<double>().mean() : 1.0;
  }
  if (acts_everywhere(place.law)) return std::numeric_limits<double>::quiet_NaN();
  const auto forces = contacts.force.middleRows(row - place.place, place.directions).array();
  return (forces != 0.0).colwise().any().cast<double>().mean();
}

int leading_contact(const solvers::Motion& contacts, const Eigen::VectorXd& gaps) {
  Eigen::Index contact = 0;
  if (contacts.force.size() > 0 && contacts.force.maxCoeff() > 0.0)
    contacts.force.rowwise().maxCoeff().maxCoeff(&contact);
  else if (!contacts.empty())
    (contacts.displacement.rowwise().maxCoeff() - gaps).maxCoeff(&contact);
  return static_cast<int>(contact);
}

int leading_contact(const Scene& scene, const solvers::Motion& contacts, const Eigen::VectorXd& gaps) {
  const int first = leading_contact(contacts, gaps);
  const std::vector<SceneContact> places = contact_places(scene);
  const auto range = [&](int row) {
    const auto u = contacts.displacement.row(row);
    return u.maxCoeff() - u.minCoeff();
  };
  int best = first;
  for (int row = 0; row < contacts.rows(); ++row)
    if (places[std::size_t(row)].number == places[std::size_t(first)].number && range(row) > range(best))
      best = row;
  return best;
}

double observed_order(std::span<const double> sizes, std::span<const double> errors) {
  if (sizes.size() != errors.size())
    throw std::invalid_argument(
        fmt::format("observed_order: there are {} sizes and {} errors; their numbers must be equal",
                    sizes.size(), errors.size()));
  if (sizes.size() < 2) throw std::invalid_argument("observed_order: there must be at least two entries");
  const auto n = static_cast<Eigen::Index>(sizes.size());
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(sizes.data(), n).log();
  const Eigen::ArrayXd y = Eigen::Map<const Eigen::ArrayXd>(errors.data(), n).log();
  if (!x.isFinite().all() || !y.isFinite().all())
    throw std::invalid_argument("observed_order: sizes and errors must be positive and finite");
  const Eigen::ArrayXd centred = x - x.mean();
  return -(centred * y).sum() / centred.square().sum();
}

double highest_at_impacts(const solvers::ExactSolution& motion, std::optional<int> contact) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const solvers::Impact& one : motion.impacts)
    if (!contact || one.contact == *contact)
      largest = std::max(largest, motion.displacement(Eigen::VectorXd::Constant(1, one.time))(one.contact));
  return largest;
}

Eigen::VectorXd time_fractions(int points) {
  return Eigen::VectorXd::LinSpaced(points, 0.0, static_cast<double>(points - 1)) /
         static_cast<double>(points);
}

}  // namespace wavebalance::app
