// Runs an entry function over a folder of seeds and over seeded mutations of them: replay FOLDER MUTATIONS.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz.hpp"

namespace {

std::vector<std::string> read_seeds(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(folder), {});
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> seeds) : seeds_(std::move(seeds)) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    for (std::size_t i = 1 + below(5); i > 0; --i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator_);
  }

  std::string piece() {
    static const std::vector<std::string> numbers{"0",          "-1",   "1e308", "1e-320", "nan", "inf",
                                                  "2147483648", "1e18", "\"",    "[",      "]",   "=",
                                                  "\n",         "%%",   "0x7f",  "\xff"};
    if (below(2) == 0) return numbers[below(numbers.size())];
    const std::string& other = seeds_[below(seeds_.size())];
    const std::size_t begin = below(other.size() + 1);
    return other.substr(begin, below(40));
  }

  void change(std::string& text) {
    const std::size_t place = below(text.size() + 1);
    switch (below(4)) {
      case 0:
        if (place < text.size()) text[place] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(place, piece());
        break;
      case 2:
        text.erase(place, below(20));
        break;
      default:
        text.replace(place, below(12), piece());
    }
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 generator_{20140817};
};

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FOLDER MUTATIONS\n", argv[0]);
    return 2;
  }
  const auto seeds = read_seeds(argv[1]);
  require(!seeds.empty(), "the folder holds seeds");
  for (const auto& seed : seeds) run(seed);
  Mutator mutator(seeds);
  const int mutations = std::stoi(argv[2]);
  for (int i = 0; i < mutations; ++i) run(mutator.next());
  std::printf("%zu seeds and %d mutations\n", seeds.size(), mutations);
  return 0;
}
