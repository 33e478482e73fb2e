// Only this file includes CLI11, which compiles longer than the rest of the report.
#include "command_line.hpp"

#include <CLI/CLI.hpp>

namespace wavebalance::report {

std::optional<int> read_arguments(int argc, const char* const* argv, const std::string& description,
                                  const std::string& footer, const std::vector<Argument>& arguments) {
  CLI::App app(description);
  app.footer(footer);
  for (const Argument& argument : arguments) {
    CLI::Option& option = *app.add_option(argument.name, *argument.value, argument.help);
    if (argument.name.starts_with("-"))
      option.capture_default_str();
    else
      option.required();
    if (!argument.allowed.empty()) option.check(CLI::IsMember(argument.allowed));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return std::nullopt;
}

}  // namespace wavebalance::report
