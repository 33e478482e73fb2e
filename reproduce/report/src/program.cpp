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

struct Arguments {
  std::string name, output, scenes;
};

Arguments defaults(const std::vector<Step>& steps) {
  const std::string& paper = steps.at(0).identity.paper;
  return {"", "results/" + paper, std::string(WAVEBALANCE_SCENES_DIR) + "/" + paper};
}

const Step& find(const std::vector<Step>& steps, const std::string& name) {
  const auto found =
      std::find_if(steps.begin(), steps.end(), [&](const Step& step) { return step.name == name; });
  if (found == steps.end()) throw std::out_of_range("\"" + name + "\" is none of the steps");
  return *found;
}

void run(const Step& step, const std::string& program, const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  Artefact artefact(step.identity, arguments.output, arguments.scenes);
  artefact.made_by(program + " " + step.name);
  step.make(artefact);
  artefact.write(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

int fail(const Step& step, const std::exception& error, int code) {
  std::cerr << step.identity.stem << ": " << error.what() << "\n";
  return code;
}

}  // namespace

int run_program(int argc, const char* const* argv, const std::vector<Step>& steps) {
  Arguments arguments = defaults(steps);
  std::vector<std::string> names;
  std::string list = "Steps:";
  for (const Step& step : steps) {
    names.push_back(step.name);
    list += "\n  " + step.name + ": " + step.identity.number + ", " + step.identity.title;
  }
  const auto code =
      read_arguments(argc, argv, "Makes one figure or table of results/" + steps.at(0).identity.paper, list,
                     {{"name", &arguments.name, "the step to make", names},
                      {"--output", &arguments.output, "folder for the data and its picture or table"},
                      {"--scenes", &arguments.scenes, "folder of the scene files"}});
  if (code) return *code;
  const Step& step = find(steps, arguments.name);
  solvers::use_one_blas_thread();
  solvers::keep_freed_memory();
  try {
    run(step, std::filesystem::path(argv[0]).filename().string(), arguments);
    return 0;
  } catch (const NotConverged& error) {
    return fail(step, error, 3);
  } catch (const std::exception& error) {
    return fail(step, error, 2);
  }
}

}  // namespace wavebalance::report
