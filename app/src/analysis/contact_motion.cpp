#include "wavebalance/app/analysis/contact_motion.hpp"

#include <cstdint>

#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::app {

int leading_contact(const solvers::Motion& contacts, const Eigen::VectorXd& gaps) {
  Eigen::Index contact = 0;
  if (contacts.force.size() > 0 && contacts.force.maxCoeff() > 0.0)
    contacts.force.rowwise().maxCoeff().maxCoeff(&contact);
  else if (!contacts.empty())
    (contacts.displacement.rowwise().maxCoeff() - gaps).maxCoeff(&contact);
  return static_cast<int>(contact);
}

Table response_table(const solvers::Motion& contact) {
  Table table;
  table.add_column("time_fraction", time_fractions(contact.points()))
      .add_column("displacement_m", contact.displacement)
      .add_column("velocity_m_per_s", contact.velocity)
      .add_column("contact_force_N", contact.force);
  return table;
}

Table contacts_table(const solvers::Motion& contacts) {
  Table table({"time_fraction", "contact", "displacement_m", "contact_force_N"});
  const Eigen::VectorXd times = time_fractions(contacts.points());
  for (int l = 0; l < contacts.points(); ++l)
    for (int contact = 0; contact < contacts.rows(); ++contact)
      table.append_row({times[l], std::int64_t{contact + 1}, contacts.displacement(contact, l),
                        contacts.force(contact, l)});
  return table;
}

}  // namespace wavebalance::app
