#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <optional>

namespace pelagos {

/// Reads the command line of any program of the project. Help and version are printed to `out`. Mistakes are told on
/// `err`, each with the wrong word and what is allowed, e.g. "pelagos-server: unknown option --sceen; did you mean
/// --scene?". All numbers are decimal, also with zeros in front (CLI11 by itself takes 010 as octal).
/// @param app  named as the program
/// @return the program's exit status, 0 or 2; nothing: go on
[[nodiscard]] std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv, std::ostream& out,
                                                    std::ostream& err);
/// The same on standard output and standard error.
[[nodiscard]] std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace pelagos
