#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "values/scene.hpp"

namespace pelagos {

/// Names of solvers as the command line knows them.
[[nodiscard]] const std::vector<std::string>& solver_names();

/// Sets scheme and method by name; another scheme brings its own defaults. False if there is none of that name.
[[nodiscard]] bool choose_solver(std::string_view name, SolverSettings& solver);

/// The name of a scene's choice.
[[nodiscard]] std::string solver_name(const SolverSettings& solver);

}  // namespace pelagos
