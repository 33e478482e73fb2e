#include "balance/sample_reduction.hpp"

#include <vector>

namespace wavebalance::solvers {
namespace {

// The contacts of ascending samples, ascending.
std::vector<int> contacts_of(std::span<const int> samples, int points) {
  std::vector<int> contacts;
  for (const int sample : samples)
    if (contacts.empty() || contacts.back() != sample / points) contacts.push_back(sample / points);
  return contacts;
}

}  // namespace

void SampleReduction::fill(Eigen::MatrixXd& matrix) {
  const std::vector<int> contacts = contacts_of(slopes_->samples(), contact_->problem().points());
  const Eigen::MatrixXd& columns = contact_->columns(contacts);
  const int period = contact_->problem().pair().shift_period();
  slopes_->fill(contact_->problem().points(), period, columns, slopes_->rates_of(columns, contacts, period),
                matrix);
}

Eigen::VectorXd SampleReduction::motion(const Eigen::VectorXd& values) {
  weighted_.setZero(contact_->problem().samples());
  slopes_->write(values, weighted_);
  contact_->apply(weighted_, product_);
  return product_;
}

Eigen::VectorXd SampleReduction::motion_transposed(const Eigen::VectorXd& row) {
  contact_->apply_transposed(row, product_);
  return product_(slopes_->samples()).cwiseProduct(slopes_->scale());
}

}  // namespace wavebalance::solvers
