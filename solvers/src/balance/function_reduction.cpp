#include "balance/function_reduction.hpp"

#include <array>
#include <complex>
#include <utility>

#include "linalg/spans.hpp"
#include "wavebalance/spectral/fft.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// Adds the product of two spectra over translates in real coordinates: the mean, and real and imaginary parts
// of the others as far as there are `functions` numbers, since an alternating coefficient is real.
void add_product(const Complex* one, const Complex* other, int functions, double* coordinates) {
  coordinates[0] += one[0].real() * other[0].real() - one[0].imag() * other[0].imag();
  for (int j = 1; j < functions; j += 2) {
    const Complex a = one[(j + 1) / 2], b = other[(j + 1) / 2];
    coordinates[j] += a.real() * b.real() - a.imag() * b.imag();
    if (j + 1 < functions) coordinates[j + 1] += a.real() * b.imag() + a.imag() * b.real();
  }
}

}  // namespace

FunctionReduction::FunctionReduction() = default;
FunctionReduction::~FunctionReduction() = default;

Eigen::Index FunctionReduction::size(const CondensedProblem& problem) {
  return Eigen::Index(problem.contacts()) * problem.pair().functions();
}

void FunctionReduction::set(ContactOperator& contact, ActiveSlopes& slopes) {
  contact_ = &contact;
  slopes_ = &slopes;
  if (!fft_) make_synthesis();
}

void FunctionReduction::make_synthesis() {
  fft_ = std::make_unique<spectral::RealFft>(pair().points());
  synthesis_.resize(pair().points(), pair().functions());
  spectrum_.resize(pair().points() / 2 + 1);
  Eigen::VectorXcd translates(pair().spectrum_size());
  Eigen::VectorXd samples(pair().points());
  for (int j = 0; j < pair().functions(); ++j) {
    translates.setZero();
    translates[(j + 1) / 2] = j % 2 == 1 || j == 0 ? Complex(1.0, 0.0) : Complex(0.0, 1.0);
    pair().spread(translates, spectrum_);
    fft_->inverse(span_of(std::as_const(spectrum_)), span_of(samples));
    synthesis_.col(j) = samples / pair().points();
  }
}

// The spectrum over translates of the inner products of a contact's force with the weighting functions.
const Eigen::VectorXcd& FunctionReduction::projection(const Eigen::VectorXd& force) {
  fft_->forward(span_of(force), span_of(spectrum_));
  pair().project(spectrum_, projection_);
  return projection_;
}

void FunctionReduction::add_coefficients(const Eigen::VectorXcd& projection, int from, double* coefficients) {
  const int contacts = contact_->problem().contacts(), functions = pair().functions();
  const Eigen::MatrixXcd& compliance = contact_->problem().compliance();
  for (int to = 0; to < contacts; ++to)
    add_product(compliance.col(to + contacts * from).data(), projection.data(), functions,
                coefficients + to * functions);
}

void FunctionReduction::fill(Eigen::MatrixXd& matrix) {
  const int contacts = contact_->problem().contacts(), functions = pair().functions();
  matrix.topLeftCorner(count(), count()).setIdentity();
  const Eigen::MatrixXd motions = synthesis_.transpose();
  const Eigen::MatrixXd rates = slopes_->rates_of(synthesis_, std::array{0}, functions).transpose();
  for (int of = 0; of < contacts; ++of)
    for (const ActiveSlopes::ContactForces& caused : slopes_->forces_of(of, motions, rates))
      for (int j = 0; j < functions; ++j)
        add_coefficients(projection(caused.force.row(j)), caused.contact,
                         matrix.col(of * functions + j).data());
}

Eigen::VectorXd FunctionReduction::read(const Eigen::VectorXd& motion) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(motion.size()), coefficients = Eigen::VectorXd::Zero(count());
  slopes_->write(slopes_->read(motion), force);
  for (int from = 0; from < contact_->problem().contacts(); ++from)
    add_coefficients(projection(force.segment(from * pair().points(), pair().points())), from,
                     coefficients.data());
  return coefficients;
}

Eigen::VectorXd FunctionReduction::motion(const Eigen::VectorXd& values) {
  return (synthesis_ * values.reshaped(pair().functions(), contact_->problem().contacts())).reshaped();
}

Eigen::VectorXd FunctionReduction::motion_transposed(const Eigen::VectorXd& row) {
  return (synthesis_.transpose() * row.reshaped(pair().points(), contact_->problem().contacts())).reshaped();
}

}  // namespace wavebalance::solvers
