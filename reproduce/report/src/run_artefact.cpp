#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>

#include "wavebalance/report/artefact.hpp"

namespace wavebalance::report {
namespace {

int fail(const Identity& identity, const std::exception& error, int code) {
  std::cerr << identity.stem << ": " << error.what() << "\n";
  return code;
}

}  // namespace

int run_artefact(int argc, char** argv, const Identity& identity,
                 const std::function<void(Artefact&)>& make) {
  std::string output = "results/" + identity.paper;
  std::string scenes = std::string(WAVEBALANCE_SCENES_DIR) + "/" + identity.paper;
  CLI::App app(identity.number + ": " + identity.title);
  app.add_option("--output", output, "folder for " + identity.stem + ".csv and its picture or table")
      ->capture_default_str();
  app.add_option("--scenes", scenes, "folder of the paper's scene files")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const auto start = std::chrono::steady_clock::now();
    Artefact artefact(identity, output, scenes);
    make(artefact);
    artefact.write(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return 0;
  } catch (const NotConverged& error) {
    return fail(identity, error, 3);
  } catch (const std::exception& error) {
    return fail(identity, error, 2);
  }
}

}  // namespace wavebalance::report
