// The command `wavebalance`. Only this file includes CLI11, which compiles longer than the rest of the
// command.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <exception>
#include <new>

#include "command/commands.hpp"
#include "files/contains.hpp"
#include "scene/spelling.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/solvers/linalg/blas_threads.hpp"
#include "wavebalance/solvers/linalg/freed_memory.hpp"

namespace {

using namespace wavebalance::app;

constexpr const char* description =
    "Periodic vibrations of structures with contact, friction and impacts, by harmonic balance (Fourier)\n"
    "and wavelet balance (Haar, Daubechies, B-spline). A scene is a TOML file with the structure, the\n"
    "contacts, the forcing, the time discretisation and the analysis.";

std::string footer() {
  return "A scene (the bar of Jones & Legrand 2014, case 1; `wavebalance keys` explains every key):\n\n" +
         write_scene(example_scene()) +
         "\nCommands to start with. They read the scene from case.toml, and `wavebalance init --output case.toml`\n"
         "writes one of a bar there. `init matrices` and `init blade` write scenes of other structures.\n\n"
         "  wavebalance check case.toml\n"
         "  wavebalance run case.toml --output results/case\n"
         "  wavebalance run case.toml --output results/haar --set time.trial=haar --set time.functions=64\n"
         "  wavebalance run case.toml --output results/reference --set analysis.type=time_stepping\n"
         "  wavebalance run case.toml --output results/next --start-from results/case --set forcing.frequency=155\n"
         "  wavebalance compare case.toml --output results/compare     # which basis, how many functions?\n"
         "  wavebalance study study.toml --output results/study        # the scene over values of its keys\n"
         "  wavebalance run case.toml --output results/rigid --set contact.law=rigid \\\n"
         "    --unset contact.constant --unset contact.exponent\n\n"
         "The scene of a nonlinear mode has analysis.type = \"nonlinear_mode\" and neither [forcing] nor [time].\n"
         "One is reproduce/scenes/laxalde_legrand_2010/rod.toml.\n\n"
         "`run` writes report.html to read in a browser, summary.json, a table (response.csv, sweep.csv or\n"
         "backbone.csv), a picture (SVG) and the scene as it was solved. Either all of these files appear or\n"
         "none. They replace files of an earlier run in the same folder; other files stay. Without gnuplot no\n"
         "picture is written.\n\n"
         "Exit codes:\n"
         "  0    The scene is solved.\n"
         "  2    The input is wrong, or the output cannot be written. Nothing is written.\n"
         "  3    The solution has not converged. The results are written, with \"converged\": false.\n"
         "  130  The command was interrupted (Ctrl-C). Sweeps, searches for motions, comparisons and studies write\n"
         "       what they have, with the status \"interrupted\". Other analyses write nothing. A second Ctrl-C ends\n"
         "       all of them at once, and nothing is written.";
}

void add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
              const std::string& type, const std::string& help) {
  command.add_option(name, values, help + "; may be given more than once")
      ->type_name(type)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_scene(CLI::App& command, RunArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "scene file (TOML)")->required();
  add_list(command, "--set", arguments.overrides, "KEY=VALUE",
           "section.key=value instead of the value in the file");
  add_list(command, "--unset", arguments.removed, "KEY", "leave section.key of the file out, before --set");
  command
      .add_option("--analysis", arguments.analysis,
                  "another analysis.type; keys of the file that do not belong to it are left out")
      ->type_name("TYPE");
}

void add_threads(CLI::App& command, int& threads, const std::string& help) {
  const auto check = [](const std::string& text) -> std::string {
    constexpr int most = 1024;
    int value = -1;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec == std::errc() && read.ptr == end && value >= 0 && value <= most) return "";
    return "\"" + text + "\": expected a whole number from 0 to " + std::to_string(most) +
           "; 0: one per core";
  };
  command.add_option("--threads", threads, help)->type_name("N")->check(CLI::Validator(check, ""));
}

void add_start(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--start-from", arguments.start_from,
                  "start near a motion of an earlier run: its folder, or DIR/motion_peak.csv of a sweep")
      ->type_name("DIR");
}

void add_copy_inputs(CLI::App& command, RunArguments& arguments) {
  command.add_flag(
      "--copy-inputs", arguments.copy_inputs,
      "copy matrices and other files that the scene names into the results, which can then be moved");
}

void add_output(CLI::App& command, std::filesystem::path& output,
                const std::string& help = "folder of the results, made if missing") {
  command.add_option("--output,-o", output, help)->required();
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet,-q", quiet, "print only warnings and errors");
}

void add_report(CLI::App& command, bool& report) {
  command.add_flag("!--no-report", report, "write no report.html");
}

void add_compare(CLI::App& command, CompareArguments& arguments) {
  add_scene(command, arguments.run);
  add_start(command, arguments.run);
  add_output(command, arguments.run.output);
  command
      .add_option("--pairs", arguments.pairs,
                  "pairs of bases, fourier:fourier,haar:fourier; default: every admissible pair of "
                  "fourier, haar, bspline and daubechies6, and two of daubechies10")
      ->type_name("TRIAL:WEIGHT,...");
  command
      .add_option(
          "--error", arguments.error,
          "error that decides: displacement, force or both (the larger one); default: both, where the "
          "force has an error")
      ->type_name("NAME");
  command.add_option("--budget", arguments.budget, "time for the whole comparison; default: 10")
      ->type_name("SECONDS");
  add_threads(command, arguments.run.threads, "pairs solved in parallel; default: one per core");
  add_copy_inputs(command, arguments.run);
  add_report(command, arguments.run.report);
  add_quiet(command, arguments.run.quiet);
}

void add_study(CLI::App& command, StudyArguments& arguments) {
  command.add_option("STUDY", arguments.study, "study file (TOML), see app/STUDIES.md")->required();
  add_output(command, arguments.output,
             "folder of the results, made if missing; a study that was started there continues");
  add_threads(command, arguments.threads,
              "runs solved in parallel; default: one per core, with mpirun one per process");
  add_report(command, arguments.report);
  add_quiet(command, arguments.quiet);
}

void add_overlay(CLI::App& command, OverlayArguments& arguments) {
  command.add_option("DIR", arguments.folders, "folders of results of `wavebalance run`, of one structure")
      ->required();
  add_output(command, arguments.output, "folder of the picture, made if missing");
  command
      .add_option(
          "--quantity", arguments.quantity,
          "max, min, max_abs or rms of the displacement of contacts, or the vibration of an output, as \"row 19\"; "
          "default: the first output where all have it, else max")
      ->type_name("NAME");
  add_quiet(command, arguments.quiet);
}

void add_init(CLI::App& command, InitArguments& arguments) {
  command.add_option("KIND", arguments.kind, joined(starter_kinds()) + "; default: bar");
  command
      .add_option("--output,-o", arguments.output,
                  "the scene file; default: KIND.toml; no file is overwritten")
      ->type_name("FILE");
}

void add_convert(CLI::App& command, ConvertArguments& arguments) {
  command
      .add_option(
          "FILES", arguments.files,
          "matrices, loads and a dof map of CalculiX, Abaqus, Ansys, LS-DYNA or Nastran; job.pch#KAAX is one "
          "matrix of a file")
      ->required();
  add_output(command, arguments.output, "folder of the files, made if missing; no file is overwritten");
}

void add_keys(CLI::App& command, std::vector<std::string>& filters, bool& names) {
  command.add_option(
      "FILTER", filters,
      "a section (contact), a key (contact.gap) or a choice (structure.type=matrices), which leaves "
      "out keys that do not apply; several sections and keys are all listed");
  command.add_flag("--names", names, "only the names, each with its choices");
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// Throws std::invalid_argument if the first argument is neither an option nor one of the commands.
void check_command(const CLI::App& app, int argc, char** argv) {
  const std::vector<std::string> names = names_of_commands(app);
  if (argc < 2)
    throw std::invalid_argument(
        "no command; there are " + joined(names) +
        "; `wavebalance init` writes a scene to start from, `wavebalance --help` explains");
  if (argv[1][0] == '-') return;
  const std::string name = argv[1];
  if (contains(names, name)) return;
  const std::string nearest = name.ends_with(".toml") ? "run " + name
                              : name == "help"        ? "--help"
                                                      : closest(name, names);
  throw std::invalid_argument("unknown command " + name + "; there are " + joined(names) +
                              (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

/// The error in the arguments, the option that was probably meant, and where to read on.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string nearest, misspelt;
  for (int i = 1; i < argc; ++i)
    if (const std::string word = argv[i]; word.starts_with("--") && !contains(options, word))
      misspelt = word, nearest = closest(word, options);
  const std::string name = parsed.empty() ? "wavebalance" : "wavebalance " + command.get_name();
  const std::string what = nearest.empty()
                               ? std::string(error.what())
                               : "there is no option " + misspelt + " (did you mean " + nearest + "?)";
  return what + "; `" + name + " --help` lists its options";
}

int dispatch(int argc, char** argv) {
  CLI::App app(description, "wavebalance");
  RunArguments arguments;
  app.set_version_flag("--version", "wavebalance " + std::string(version()));
  app.footer(footer);
  app.require_subcommand(1);
  CLI::App& run = *app.add_subcommand("run", "solve a scene and write its results");
  add_scene(run, arguments);
  add_output(run, arguments.output);
  add_start(run, arguments);
  run.add_option("--max-memory", arguments.max_memory,
                 "refuse a scene that is expected to need more; default: the memory of the machine")
      ->type_name("GB")
      ->check(CLI::PositiveNumber);
  add_threads(run, arguments.threads,
              "harmonics condensed in parallel, with the same digits; default: one per core");
  add_copy_inputs(run, arguments);
  add_report(run, arguments.report);
  add_quiet(run, arguments.quiet);
  run.add_flag("--verbose,-v", arguments.verbose, "print all values of summary.json, not sentences");
  CLI::App& check = *app.add_subcommand("check", "validate a scene and describe the problem");
  add_scene(check, arguments);
  CompareArguments comparison;
  CLI::App& compare = *app.add_subcommand("compare", "which basis and how many functions for this scene");
  add_compare(compare, comparison);
  OverlayArguments drawing;
  CLI::App& overlay =
      *app.add_subcommand("overlay", "draw responses and modes of one structure over each other");
  add_overlay(overlay, drawing);
  StudyArguments over;
  CLI::App& study = *app.add_subcommand("study", "solve a scene over a grid, a list or samples of its keys");
  add_study(study, over);
  std::vector<std::string> filters;
  bool names = false;
  CLI::App& keys = *app.add_subcommand("keys", "list every key of a scene: meaning, unit, range, default");
  add_keys(keys, filters, names);
  InitArguments start;
  CLI::App& init = *app.add_subcommand("init", "write a commented scene to start from");
  add_init(init, start);
  ConvertArguments conversion;
  CLI::App& convert = *app.add_subcommand("convert", "write matrices of other codes as Matrix Market files");
  add_convert(convert, conversion);
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help, version
    throw std::invalid_argument(usage_text(app, error, argc, argv));
  }
  take_analysis(arguments);
  take_analysis(comparison.run);
  if (keys.parsed()) return print(names ? key_names_text() : selected_keys_text(filters));
  if (init.parsed()) return init_scene(start);
  if (convert.parsed()) return convert_files(conversion);
  if (compare.parsed()) return compare_scene(comparison);
  if (overlay.parsed()) return overlay_results(drawing);
  if (study.parsed()) return solve_study(over);
  return check.parsed() ? check_scene(arguments) : run_scene(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  wavebalance::solvers::keep_freed_memory();
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file size limit is then an error of the write, reported like a full disk
  wavebalance::solvers::use_one_blas_thread();
  try {
    return dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("wavebalance: not enough memory for this scene\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "wavebalance: %s\n", error.what());
  }
  return wavebalance::app::bad_input;
}
