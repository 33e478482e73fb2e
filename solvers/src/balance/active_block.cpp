#include "balance/active_block.hpp"

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

// I + B K S in the leading block.
void ActiveBlock::fill(ContactOperator& contact) {
  if (count() == 0) return;
  const std::vector<int> contacts = contacts_of(slopes_->samples(), contact.problem().points());
  const Eigen::MatrixXd& columns = contact.columns(contacts);
  const int period = contact.problem().pair().shift_period();
  slopes_->fill(contact.problem().points(), period, columns, slopes_->rates_of(columns, contacts, period),
                matrix_);
}

// x = r - K S z.
void ActiveBlock::complete(ContactOperator& contact, const Eigen::VectorXd& r,
                           const Eigen::VectorXd& active_values, Eigen::VectorXd& x) {
  x = r;
  if (count() == 0) return;
  weighted_.setZero(r.size());
  slopes_->write(active_values, weighted_);
  contact.apply(weighted_, product_);
  x -= product_;
}

bool ActiveBlock::factorize(ContactOperator& contact, ActiveSlopes& slopes) {
  slopes_ = &slopes;
  matrix_.resize(count(), count());
  fill(contact);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void ActiveBlock::solve(ContactOperator& contact, const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  Eigen::VectorXd values;
  if (count() > 0) values = lu_.solve(slopes_->read(r));
  complete(contact, r, values, x);
}

// Eliminating x = r - K S z - b y leaves (I + B K S) z + B b y = B r and -(S K^T c).z + (d - c.b) y = s -
// c.r.
bool ActiveBlock::factorize_bordered(ContactOperator& contact, ActiveSlopes& slopes, const Eigen::VectorXd& b,
                                     const Eigen::VectorXd& c, double d) {
  slopes_ = &slopes;
  border_column_ = b;
  border_row_ = c;
  matrix_.resize(count() + 1, count() + 1);
  fill(contact);
  if (count() > 0) {
    contact.apply_transposed(c, product_);
    matrix_.col(count()).head(count()) = slopes_->read(b);
    matrix_.row(count()).head(count()) =
        -product_(slopes_->samples()).cwiseProduct(slopes_->scale()).transpose();
  }
  matrix_(count(), count()) = d - c.dot(b);
  lu_.compute(matrix_);
  return !lu_.is_singular();
}

void ActiveBlock::solve_bordered(ContactOperator& contact, const Eigen::VectorXd& r, double s,
                                 Eigen::VectorXd& x, double& y) {
  Eigen::VectorXd values(count() + 1);
  values.head(count()) = slopes_->read(r);
  values[count()] = s - border_row_.dot(r);
  values = lu_.solve(values);
  y = values[count()];
  complete(contact, r - border_column_ * y, values.head(count()), x);
}

double ActiveBlock::condition() const { return lu_.condition(); }

// Eliminating the samples without stiffness, on whose columns J is the identity, does not change the
// determinant, and nor does the scale S of the unknowns.
int ActiveBlock::determinant_sign() const { return lu_.determinant_sign(); }

}  // namespace wavebalance::solvers
