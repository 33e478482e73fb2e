#include "wavebalance/spectral/fft.hpp"

#include <thread>

#include "testing.hpp"

namespace wavebalance::spectral {
namespace {

using Complex = std::complex<double>;

std::vector<double> random_samples(int size, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> samples(static_cast<std::size_t>(size));
  for (double& value : samples) value = uniform(generator);
  return samples;
}

std::vector<Complex> forward(const std::vector<double>& samples) {
  RealFft fft(static_cast<int>(samples.size()));
  std::vector<Complex> spectrum(static_cast<std::size_t>(fft.harmonics()));
  fft.forward(samples, spectrum);
  return spectrum;
}

Complex defining_sum(const std::vector<double>& samples, std::size_t harmonic) {
  const std::size_t size = samples.size();
  Complex sum = 0.0;
  for (std::size_t l = 0; l < size; ++l) {
    const double turns = static_cast<double>(harmonic * l % size) / static_cast<double>(size);
    sum += samples[l] * std::polar(1.0, -2.0 * std::numbers::pi * turns);
  }
  return sum;
}

class RealFftOfSize : public testing::TestWithParam<int> {};

TEST_P(RealFftOfSize, ForwardIsTheDefiningSum) {
  const auto samples = random_samples(GetParam());
  const auto spectrum = forward(samples);
  ASSERT_EQ(spectrum.size(), static_cast<std::size_t>(GetParam() / 2 + 1));
  for (std::size_t n = 0; n < spectrum.size(); ++n)
    EXPECT_LE(std::abs(spectrum[n] - defining_sum(samples, n)), 8 * eps * GetParam()) << "harmonic " << n;
}

TEST_P(RealFftOfSize, InverseOfForwardIsTheSizeTimesTheInput) {
  const auto samples = random_samples(GetParam());
  RealFft fft(GetParam());
  std::vector<Complex> spectrum(static_cast<std::size_t>(fft.harmonics()));
  std::vector<double> back(samples.size());
  fft.forward(samples, spectrum);
  fft.inverse(spectrum, back);
  for (std::size_t l = 0; l < samples.size(); ++l)
    EXPECT_NEAR(back[l] / GetParam(), samples[l], 16 * eps) << "sample " << l;
}

TEST_P(RealFftOfSize, IsItsOwnAdjointUpToTheWeightOfTheHarmonics) {
  const auto samples = random_samples(GetParam(), 2);
  const auto spectrum = forward(samples);
  const auto other = forward(random_samples(GetParam(), 3));
  RealFft fft(GetParam());
  std::vector<double> back(samples.size());
  fft.inverse(other, back);
  double in_time = 0.0;
  for (std::size_t l = 0; l < samples.size(); ++l) in_time += samples[l] * back[l];
  double in_frequency = 0.0;
  for (std::size_t n = 0; n < spectrum.size(); ++n) {
    const bool once = n == 0 || 2 * n == samples.size();
    in_frequency += (once ? 1.0 : 2.0) * (std::conj(spectrum[n]) * other[n]).real();
  }
  EXPECT_NEAR(in_time, in_frequency, 32 * eps * GetParam() * GetParam());
}

TEST_P(RealFftOfSize, KeepsItsInput) {
  const auto samples = random_samples(GetParam());
  auto given = samples;
  RealFft fft(GetParam());
  std::vector<Complex> spectrum(static_cast<std::size_t>(fft.harmonics()));
  fft.forward(given, spectrum);
  EXPECT_EQ(given, samples);
  const auto kept = spectrum;
  fft.inverse(spectrum, given);
  EXPECT_EQ(spectrum, kept);
}

TEST_P(RealFftOfSize, GivesTheSameBitsAtAnyAlignment) {
  const auto samples = random_samples(GetParam());
  const auto expected = forward(samples);
  const std::size_t size = samples.size();
  RealFft fft(GetParam());
  std::vector<double> expected_back(size);
  fft.inverse(expected, expected_back);
  for (std::size_t shift = 0; shift < 4; ++shift) {
    std::vector<double> in(size + shift), real_out(2 * expected.size() + 4), back(size + shift);
    std::copy(samples.begin(), samples.end(), in.begin() + static_cast<std::ptrdiff_t>(shift));
    const std::span<Complex> out(reinterpret_cast<Complex*>(real_out.data() + shift), expected.size());
    fft.forward(std::span(in).subspan(shift), out);
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), out.begin())) << "shift " << shift;
    fft.inverse(out, std::span(back).subspan(shift));
    EXPECT_TRUE(std::equal(expected_back.begin(), expected_back.end(),
                           back.begin() + static_cast<std::ptrdiff_t>(shift)));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RealFftOfSize,
                         testing::Values(1, 2, 3, 4, 5, 7, 16, 63, 64, 97, 256, 1000, 1021));

TEST(RealFft, TakesNoImaginaryPartOfMeanAndNyquist) {
  RealFft fft(4);
  std::vector<double> with(4), without(4);
  fft.inverse(std::vector<Complex>{{1, 5}, {2, 3}, {4, -7}}, with);
  fft.inverse(std::vector<Complex>{1, {2, 3}, 4}, without);
  EXPECT_EQ(with, without);
}

TEST(RealFft, SurvivesAMove) {
  RealFft first(8);
  RealFft second(std::move(first));
  const auto samples = random_samples(8);
  std::vector<Complex> spectrum(5);
  second.forward(samples, spectrum);
  EXPECT_EQ(spectrum, forward(samples));
  RealFft third(3);
  third = std::move(second);
  EXPECT_EQ(third.size(), 8);
  third.forward(samples, spectrum);
  EXPECT_EQ(spectrum, forward(samples));
}

TEST(RealFft, PlansInSeveralThreadsAtOnce) {
  const auto samples = random_samples(60);
  const auto expected = forward(samples);
  std::vector<int> matches(4, 0);
  std::vector<std::thread> threads;
  for (int& match : matches)
    threads.emplace_back([&] {
      for (int repeat = 0; repeat < 50; ++repeat) match += forward(samples) == expected;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(matches, std::vector<int>(4, 50));
}

// Past 2^20 points the plans kept for later objects are given up; those in use stay.
TEST(RealFft, KeepsItsPlansWhenManyOtherSizesAreUsed) {
  const auto samples = random_samples(60);
  const auto expected = forward(samples);
  RealFft early(60);
  std::vector<Complex> spectrum(31);
  early.forward(samples, spectrum);
  for (int size = 1 << 18; size < (1 << 18) + 6; ++size) RealFft other(size);
  early.forward(samples, spectrum);
  EXPECT_EQ(spectrum, expected);
  EXPECT_EQ(forward(samples), expected);
}

std::string message_of(auto&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(RealFft, NamesWhatIsWrong) {
  EXPECT_EQ(message_of([] { RealFft fft(0); }), "RealFft: size is 0; it must be at least 1");
  RealFft fft(8);
  std::vector<double> samples(8);
  std::vector<Complex> spectrum(8);
  EXPECT_EQ(message_of([&] { fft.forward(samples, spectrum); }),
            "RealFft::forward: out has 8 entries; it must have 5");
  spectrum.resize(5);
  samples.resize(7);
  EXPECT_EQ(message_of([&] { fft.inverse(spectrum, samples); }),
            "RealFft::inverse: out has 7 entries; it must have 8");
}

}  // namespace
}  // namespace wavebalance::spectral
