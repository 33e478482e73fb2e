#include "multiscale_basis.hpp"

#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "linalg/spans.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

double wrapped(double time) { return time - std::floor(time); }

// The centre of the square of a function on the circle, from its samples.
double centre_of(const Eigen::VectorXd& samples) {
  std::complex<double> moment = 0.0;
  const double turn = 2.0 * std::numbers::pi / double(samples.size());
  for (Eigen::Index l = 0; l < samples.size(); ++l)
    moment += samples[l] * samples[l] * std::polar(1.0, turn * double(l));
  return wrapped(std::arg(moment) / (2.0 * std::numbers::pi));
}

void require_unit_vector(const Eigen::VectorXd& translates, int functions, int block) {
  constexpr double rounding =
      1e-9;  // what FastWaveletTransform lets a filter miss orthonormality by, and a bit
  if (translates.size() == functions && std::abs(translates.squaredNorm() - 1.0) < rounding) return;
  throw std::invalid_argument("MultiscaleBasis: the synthesis of function 0 of block " +
                              std::to_string(block) + " has " + std::to_string(translates.size()) +
                              " coefficients of norm " + std::to_string(translates.norm()) +
                              "; it must have " + std::to_string(functions) + " of norm 1");
}

}  // namespace

MultiscaleBasis::MultiscaleBasis(const AnyTimeBasis& basis, int points, Synthesis synthesis, int levels)
    : functions_(basis.functions()), points_(points), coarse_(0) {
  if (levels < 0 || levels > 24 || functions_ % (1 << levels) != 0)
    throw std::invalid_argument("MultiscaleBasis: levels is " + std::to_string(levels) + "; with " +
                                std::to_string(functions_) +
                                " functions it must be 0 or more with 2^levels a divisor of their number");
  if (points < 1 || points % functions_ != 0)
    throw std::invalid_argument("MultiscaleBasis: points is " + std::to_string(points) +
                                "; it must be a multiple of the " + std::to_string(functions_) +
                                " functions");
  coarse_ = functions_ >> levels;
  blocks_.resize(static_cast<std::size_t>(levels + 1));
  TrialEvaluator evaluate(basis, points, 0);
  for (int b = 0; b <= levels; ++b) {
    const Eigen::VectorXd translates = synthesis(Eigen::VectorXd::Unit(functions_, first(b)), levels);
    require_unit_vector(translates, functions_, b);
    Block& block = blocks_[static_cast<std::size_t>(b)];
    block.spectrum = translate_spectrum(translates);
    block.samples = evaluate(block.spectrum);
    block.centre = centre_of(block.samples);
  }
}

int MultiscaleBasis::block_of(int function) const {
  return function < coarse_ ? 0 : std::bit_width(static_cast<unsigned>(function / coarse_));
}

double MultiscaleBasis::centre(int function) const {
  return wrapped(blocks_[static_cast<std::size_t>(block_of(function))].centre +
                 double(offset(function)) / functions_);
}

std::vector<int> MultiscaleBasis::around(int block, double time, double radius) const {
  constexpr double rounding = 1e-9;
  const int n = size(block);
  const double place = (time - blocks_[static_cast<std::size_t>(block)].centre) * n;
  int from = static_cast<int>(std::ceil(place - radius * n - rounding));
  int to = static_cast<int>(std::floor(place + radius * n + rounding));
  if (from > to) from = to = static_cast<int>(std::lround(place));
  std::vector<int> result;
  for (int k = from; k <= to && k < from + n; ++k) result.push_back(first(block) + ((k % n) + n) % n);
  return result;
}

Selection MultiscaleBasis::uniform(int count) const {
  if (count < 1 || count > blocks())
    throw std::invalid_argument("MultiscaleBasis: the number of blocks is " + std::to_string(count) +
                                "; it must be in 1.." + std::to_string(blocks()));
  Selection selection(static_cast<std::size_t>(first(count - 1) + size(count - 1)));
  for (std::size_t i = 0; i < selection.size(); ++i) selection[i] = static_cast<int>(i);
  return selection;
}

void MultiscaleBasis::require_selection(const Selection& selection) const {
  if (selection.empty()) throw std::invalid_argument("MultiscaleBasis: the selection is empty");
  int previous = -1;
  for (const int function : selection) {
    if (function <= previous || function >= functions_)
      throw std::invalid_argument("MultiscaleBasis: the selection holds " + std::to_string(function) +
                                  " after " + std::to_string(previous) + "; it must ascend in 0.." +
                                  std::to_string(functions_ - 1));
    previous = function;
  }
}

Eigen::MatrixXd MultiscaleBasis::samples(const Selection& selection) const {
  require_selection(selection);
  Eigen::MatrixXd matrix(points_, static_cast<Eigen::Index>(selection.size()));
  for (std::size_t j = 0; j < selection.size(); ++j) {
    const Eigen::VectorXd& source = blocks_[static_cast<std::size_t>(block_of(selection[j]))].samples;
    const Eigen::Index by = Eigen::Index{offset(selection[j])} * (points_ / functions_);
    auto column = matrix.col(static_cast<Eigen::Index>(j));
    column.tail(points_ - by) = source.head(points_ - by);
    column.head(by) = source.tail(by);
  }
  return matrix;
}

Eigen::MatrixXd MultiscaleBasis::section(const Eigen::VectorXcd& symbol, const Selection& selection) const {
  require_selection(selection);
  std::vector<Eigen::MatrixXd> products;
  for (const Block& block : blocks_) products.push_back(correlations(symbol.cwiseProduct(block.spectrum)));
  const auto count = static_cast<Eigen::Index>(selection.size());
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = selection[static_cast<std::size_t>(j)];
    const Eigen::MatrixXd& of_block = products[static_cast<std::size_t>(block_of(column))];
    for (Eigen::Index i = 0; i < count; ++i) {
      const int row = selection[static_cast<std::size_t>(i)];
      const int lag = offset(row) - offset(column);
      matrix(i, j) = of_block(lag < 0 ? lag + functions_ : lag, block_of(row));
    }
  }
  return matrix;
}

Eigen::MatrixXd MultiscaleBasis::correlations(const Eigen::VectorXcd& coefficients) const {
  Eigen::MatrixXd result(functions_, blocks());
  for (int b = 0; b < blocks(); ++b)
    result.col(b) = translate_coefficients(
        blocks_[static_cast<std::size_t>(b)].spectrum.conjugate().cwiseProduct(coefficients), functions_);
  return result;
}

Eigen::VectorXd MultiscaleBasis::analysis(const Eigen::VectorXcd& coefficients) const {
  const Eigen::MatrixXd products = correlations(coefficients);
  Eigen::VectorXd result(functions_);
  for (int i = 0; i < functions_; ++i) result[i] = products(offset(i), block_of(i));
  return result;
}

}  // namespace wavebalance::solvers
