#include "wavebalance/app/analysis/contact_motion.hpp"

#include <cstdint>

#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::app {

int ContactMotion::leading(const Eigen::VectorXd& gaps) const {
  Eigen::Index contact = 0;
  if (force.size() > 0 && force.maxCoeff() > 0.0)
    force.rowwise().maxCoeff().maxCoeff(&contact);
  else if (displacement.size() > 0)
    (displacement.rowwise().maxCoeff() - gaps).maxCoeff(&contact);
  return static_cast<int>(contact);
}

ContactMotion ContactMotion::of(const solvers::PeriodSamples& samples) {
  if (samples.points() == 0) return {};
  const auto by_contact = [&](const Eigen::VectorXd& values) -> Eigen::MatrixXd {
    return values.reshaped(samples.points(), samples.contacts).transpose();
  };
  return {by_contact(samples.displacement), by_contact(samples.velocity), by_contact(samples.contact_force)};
}

solvers::PeriodSamples ContactMotion::samples(int contact) const {
  solvers::PeriodSamples samples;
  if (points() == 0) return samples;
  samples.displacement = displacement.row(contact);
  samples.velocity = velocity.row(contact);
  samples.contact_force = force.row(contact);
  return samples;
}

Table contacts_table(const ContactMotion& motion) {
  Table table({"time_fraction", "contact", "displacement_m", "contact_force_N"});
  const Eigen::VectorXd times = time_fractions(motion.points());
  for (int l = 0; l < motion.points(); ++l)
    for (int contact = 0; contact < motion.contacts(); ++contact)
      table.append_row(
          {times[l], std::int64_t{contact + 1}, motion.displacement(contact, l), motion.force(contact, l)});
  return table;
}

}  // namespace wavebalance::app
