#include "wavebalance/spectral/fft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

#include "require.hpp"

namespace wavebalance::spectral {
namespace {

// FFTW's planner is one per process and not thread-safe; only execution is.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

struct FreeBuffer {
  void operator()(void* buffer) const { fftw_free(buffer); }
};

template <class T>
std::unique_ptr<T[], FreeBuffer> make_buffer(int count) {
  void* memory = fftw_malloc(sizeof(T) * static_cast<std::size_t>(count));
  if (memory == nullptr) throw std::bad_alloc();
  return std::unique_ptr<T[], FreeBuffer>(static_cast<T*>(memory));
}

int checked_size(int size) {
  detail::require_at_least("RealFft: size", size, 1);
  return size;
}

fftw_complex* as_fftw(std::complex<double>* values) { return reinterpret_cast<fftw_complex*>(values); }

// The two plans of one size. Each is made by the first transform that needs it, because planning takes longer
// than a transform and many objects transform in one direction only. Execution does not change a plan.
class PlanPair {
 public:
  explicit PlanPair(int size) : size_(size) {}
  ~PlanPair() {
    const std::lock_guard lock(planner_mutex());
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(inverse_);
  }
  PlanPair(const PlanPair&) = delete;
  PlanPair& operator=(const PlanPair&) = delete;

  // Planning by estimate does not write to `real` and `complex`; only their alignment matters.
  fftw_plan forward(double* real, fftw_complex* complex) {
    const std::lock_guard lock(planner_mutex());
    if (forward_ == nullptr)
      forward_ = fftw_plan_dft_r2c_1d(size_, real, complex, FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
    return require(forward_);
  }
  fftw_plan inverse(double* real, fftw_complex* complex) {
    const std::lock_guard lock(planner_mutex());
    if (inverse_ == nullptr)
      inverse_ = fftw_plan_dft_c2r_1d(size_, complex, real, FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
    return require(inverse_);
  }

 private:
  fftw_plan require(fftw_plan plan) const {
    if (plan != nullptr) return plan;
    throw std::runtime_error("RealFft: FFTW has no plan for size " + std::to_string(size_));
  }

  int size_;
  fftw_plan forward_ = nullptr;
  fftw_plan inverse_ = nullptr;
};

// Plans are kept after the objects that use them, up to `most_points` points in total, because a solver makes
// transforms of the same sizes many times.
std::shared_ptr<PlanPair> shared_plans(int size) {
  constexpr std::size_t most_points = std::size_t{1} << 20;
  static std::mutex mutex;
  static std::map<int, std::shared_ptr<PlanPair>> kept;
  static std::size_t points = 0;
  const std::lock_guard lock(mutex);
  const auto found = kept.find(size);
  if (found != kept.end()) return found->second;
  points += static_cast<std::size_t>(size);
  if (points > most_points) {
    kept.clear();
    points = static_cast<std::size_t>(size);
  }
  return kept.emplace(size, std::make_shared<PlanPair>(size)).first->second;
}

}  // namespace

struct RealFft::Plan {
  explicit Plan(int points)
      : real(make_buffer<double>(points)),
        complex(make_buffer<std::complex<double>>(points / 2 + 1)),
        shared(shared_plans(points)) {}

  // FFTW's vector code needs the alignment of the plan, given by fftw_malloc.
  bool fits(const double* values) const {
    return fftw_alignment_of(const_cast<double*>(values)) == fftw_alignment_of(real.get());
  }
  bool fits(const std::complex<double>* values) const {
    return fits(reinterpret_cast<const double*>(values));
  }
  fftw_plan forward() {
    if (forward_ == nullptr) forward_ = shared->forward(real.get(), as_fftw(complex.get()));
    return forward_;
  }
  fftw_plan inverse() {
    if (inverse_ == nullptr) inverse_ = shared->inverse(real.get(), as_fftw(complex.get()));
    return inverse_;
  }

  std::unique_ptr<double[], FreeBuffer> real;
  std::unique_ptr<std::complex<double>[], FreeBuffer> complex;
  std::shared_ptr<PlanPair> shared;

 private:
  fftw_plan forward_ = nullptr;
  fftw_plan inverse_ = nullptr;
};

RealFft::RealFft(int size) : size_(checked_size(size)), plan_(std::make_unique<Plan>(size)) {}
RealFft::~RealFft() = default;
RealFft::RealFft(RealFft&&) noexcept = default;
RealFft& RealFft::operator=(RealFft&&) noexcept = default;

// One plan serves aligned and unaligned spans, so that the result does not depend on where the caller's data
// lie.
void RealFft::forward(std::span<const double> in, std::span<std::complex<double>> out) {
  detail::require_length("RealFft::forward: in", std::ssize(in), size_);
  detail::require_length("RealFft::forward: out", std::ssize(out), harmonics());
  double* source = const_cast<double*>(in.data());  // kept by FFTW_PRESERVE_INPUT
  if (!plan_->fits(in.data())) source = std::copy(in.begin(), in.end(), plan_->real.get()) - size_;
  const bool direct = plan_->fits(out.data());
  std::complex<double>* target = direct ? out.data() : plan_->complex.get();
  fftw_execute_dft_r2c(plan_->forward(), source, as_fftw(target));
  if (!direct) std::copy_n(target, harmonics(), out.begin());
}

void RealFft::inverse(std::span<const std::complex<double>> in, std::span<double> out) {
  detail::require_length("RealFft::inverse: in", std::ssize(in), harmonics());
  detail::require_length("RealFft::inverse: out", std::ssize(out), size_);
  std::complex<double>* source = plan_->complex.get();  // the fast complex-to-real plans destroy their input
  std::copy(in.begin(), in.end(), source);
  source[0] = source[0].real();
  if (size_ % 2 == 0) source[size_ / 2] = source[size_ / 2].real();
  const bool direct = plan_->fits(out.data());
  double* target = direct ? out.data() : plan_->real.get();
  fftw_execute_dft_c2r(plan_->inverse(), as_fftw(source), target);
  if (!direct) std::copy_n(target, size_, out.begin());
}

}  // namespace wavebalance::spectral
