#include "wavebalance/report/program.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>

#include "command_line.hpp"
#include "wavebalance/report/artefact.hpp"
#include "wavebalance/solvers/linalg/blas_threads.hpp"
#include "wavebalance/solvers/linalg/freed_memory.hpp"

namespace wavebalance::report {
namespace {

void run(const Step& step, const std::string& program, const std::string& output, const std::string& scenes) {
  const auto start = std::chrono::steady_clock::now();
  Artefact artefact(step.identity, output, scenes);
  artefact.made_by(program + " " + step.name);
  step.make(artefact);
  artefact.write(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

int run_program(int argc, const char* const* argv, const std::vector<Step>& steps) {
  const std::string& paper = steps.at(0).identity.paper;
  std::string name, output = "results/" + paper, scenes = std::string(WAVEBALANCE_SCENES_DIR) + "/" + paper;
  std::vector<std::string> names;
  std::string list = "Steps:";
  for (const Step& step : steps) {
    names.push_back(step.name);
    list += "\n  " + step.name + ": " + step.identity.number + ", " + step.identity.title;
  }
  const auto code = read_arguments(argc, argv, "Makes one figure or table of results/" + paper, list,
                                   {{"name", &name, "the step to make", names},
                                    {"--output", &output, "folder for the data and its picture or table"},
                                    {"--scenes", &scenes, "folder of the scene files"}});
  if (code) return *code;
  const Step& step =
      *std::find_if(steps.begin(), steps.end(), [&](const Step& one) { return one.name == name; });
  solvers::use_one_blas_thread();
  solvers::keep_freed_memory();
  try {
    run(step, std::filesystem::path(argv[0]).filename().string(), output, scenes);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << step.identity.stem << ": " << error.what() << "\n";
    return dynamic_cast<const NotConverged*>(&error) ? 3 : 2;
  }
}

}  // namespace wavebalance::report
