#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_limits.hpp"
#include "bench_queries.hpp"
#include "bench_run.hpp"
#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "command_line/stop_signals.hpp"
#include "files/asset_folder.hpp"
#include "files/output_file.hpp"
#include "machine_json.hpp"
#include "physics/neighbor_search.hpp"
#include "scene/read_scene.hpp"
#include "solver_names.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_stop(int) { stop_requested.store(true); }

struct RunArguments {
  std::string scene_file;
  std::vector<std::string> assets;
  std::optional<std::string> solver;
  std::optional<double> tolerance, spacing;
  std::string json_file, instruction_set;
  BenchOptions options;
  int limit_steps = 100;  ///< of `limits`, before it measures
  int query_steps = 30;   ///< of `queries`, while it measures
};

/// What both subcommands know.
void add_common_options(CLI::App& command, RunArguments& arguments) {
  command.add_option("--scene", arguments.scene_file, "Scene file")->required();
  command.add_option("--assets", arguments.assets, "Folder with meshes, or with meshes/, that scenes name; repeatable")
      ->allow_extra_args(false)
      ->check(FolderThatExists());
  command.add_option("--spacing", arguments.spacing, "Particle spacing, m (default: the scene's)")
      ->check(NumberFrom(1e-3, 100.0));
  command.add_option("--threads", arguments.options.threads, "Threads (default: all)")->check(WholeFrom(1, 256));
  command.add_option("--instruction-set", arguments.instruction_set, "Use no more than this")
      ->check(OneOf({"baseline", "sse4", "avx2", "avx512"}));
  command.add_option("--json", arguments.json_file, "Write the result there (default: standard output)");
}

void add_run_options(CLI::App& run, RunArguments& arguments) {
  add_common_options(run, arguments);
  run.add_option("--solver", arguments.solver, "Solver (default: the scene's)")->check(OneOf(solver_names()));
  run.add_option(
         "--tolerance", arguments.tolerance,
         "Tolerance of both constraints, density and divergence; fraction of the rest density (default: the scene's)")
      ->check(NumberFrom(1e-6, 0.05));
  CLI::Option* seconds =
      run.add_option("--seconds", arguments.options.seconds, "Simulated seconds")->check(NumberFrom(1e-3, 1e6));
  run.add_option("--steps", arguments.options.steps, "So many time steps instead of --seconds")
      ->check(WholeFrom(1, 100000000))
      ->excludes(seconds);
  run.add_flag("--surface", arguments.options.surface, "Also extract the surface at each frame, as the server does");
}

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

nlohmann::ordered_json to_json(const Scene& scene, const RunArguments& arguments, const BenchResult& r) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(r.steps, 1));
  nlohmann::ordered_json json;
  json["scene"] = scene.name;
  json["solver"] = solver_name(scene.solver);
  json["tolerance"] = scene.solver.density.tolerance;
  json["divergence_tolerance"] = scene.solver.divergence.tolerance;
  json["spacing"] = scene.particle_spacing;
  json["particles"] = r.particles;
  json["boundary_particles"] = r.boundary_particles;
  add_machine(json, arguments.options.threads);
  json["steps"] = r.steps;
  if (r.stopped) json["stopped"] = true;
  json["simulated_s"] = r.simulated_s;
  json["wall_s"] = r.wall_s;
  json["ms_per_step"] = r.wall_s * 1e3 / steps;
  json["wall_s_per_simulated_s"] = r.wall_s / r.simulated_s;
  json["density_iterations_mean"] = r.density_iterations_mean;
  json["divergence_iterations_mean"] = r.divergence_iterations_mean;
  json["density_error_mean"] = r.density_error_mean;
  json["density_error_peak"] = r.density_error_peak;
  json["largest_density_peak"] = r.largest_density_peak;
  json["energy_rise_peak"] = r.energy_rise_peak;
  json["unconverged_steps"] = r.unconverged_steps;
  json["outside_peak"] = r.outside_peak;
  json["not_finite_peak"] = r.not_finite_peak;
  json["ns_per_pair_pass"] = r.ns_per_pair_pass;
  json["peak_memory_bytes"] = r.peak_memory_bytes;
  for (std::size_t s = 0; s < kStageCount; ++s)
    if (r.stages_ms[s] > 0.0) json["stages_ms"][kStageNames[s]] = r.stages_ms[s];
  json["saved_state"] = {{"bytes", r.state_bytes}, {"save_ms", r.save_ms}, {"load_ms", r.load_ms}};
  json["state_hash"] = hash_text(r.state_hash);
  json["world_hash"] = hash_text(r.world_hash);
  return json;
}

/// The scene with what the command line changes; nothing if it cannot be read (reported).
std::optional<Scene> prepare_scene(const RunArguments& arguments) {
  SceneReadOptions options;
  options.particle_spacing = arguments.spacing;
  options.asset_roots = mesh_folders(arguments.assets);
  SceneResult read = read_scene_file(arguments.scene_file, options);
  if (!read) {
    std::cerr << "pelagos-bench: cannot use the scene:\n" << read.report() << '\n';
    return std::nullopt;
  }
  Scene scene = *read.scene;
  if (arguments.solver && !choose_solver(*arguments.solver, scene.solver)) return std::nullopt;
  if (arguments.tolerance) scene.solver.density.tolerance = scene.solver.divergence.tolerance = *arguments.tolerance;
  return scene;
}

/// To the file, or to standard output without one. Returns false if it cannot be written (reported).
bool write_json(const nlohmann::ordered_json& json, const std::string& file_name) {
  const std::string text = json.dump(2);
  if (file_name.empty()) {
    std::cout << text << std::endl;
    if (!std::cout) std::cerr << "pelagos-bench: cannot write to standard output: check the space left\n";
    return static_cast<bool>(std::cout);
  }
  const std::string fault = write_whole_file(file_name, text + "\n");
  if (!fault.empty()) std::cerr << "pelagos-bench: --json: " << fault << '\n';
  return fault.empty();
}

/// Whether the result can be written: tried before the run. False is said.
bool try_output(const std::string& file_name) {
  const std::string fault = file_name.empty() ? "" : fault_of_output_file(file_name);
  if (!fault.empty()) std::cerr << "pelagos-bench: --json " << file_name << ": " << fault << '\n';
  return fault.empty();
}

/// Returns false if this machine lacks the instruction set asked for (reported).
bool choose_instruction_set(const std::string& name) {
  if (name.empty() || limit_instruction_set(name.c_str())) return true;
  std::cerr << "pelagos-bench: --instruction-set " << name << ": this machine has no such set\n";
  return false;
}

int limits(RunArguments& arguments) {
  if (!try_output(arguments.json_file) || !choose_instruction_set(arguments.instruction_set)) return 1;
  const std::optional<Scene> scene = prepare_scene(arguments);
  if (!scene) return 1;
  const BenchLimits r = measure_limits(*scene, arguments.options.threads, arguments.limit_steps);
  nlohmann::ordered_json json;
  json["scene"] = scene->name;
  json["particles"] = r.particles;
  json["slots"] = r.slots;
  add_machine(json, arguments.options.threads);
  json["multiply_add_gflops"] = r.multiply_add_gflops;
  json["memory_read_gb_s"] = r.memory_read_gb_s;
  json["pass_bytes"] = r.pass_bytes;
  json["cached_read_gb_s"] = r.cached_read_gb_s;
  json["gather_ns_per_slot"] = r.gather_ns_per_slot;
  return write_json(json, arguments.json_file) ? 0 : 1;
}

int queries(RunArguments& arguments) {
  if (!try_output(arguments.json_file) || !choose_instruction_set(arguments.instruction_set)) return 1;
  const std::optional<Scene> scene = prepare_scene(arguments);
  if (!scene) return 1;
  const BenchQueries r = measure_queries(*scene, arguments.options.threads, arguments.query_steps);
  nlohmann::ordered_json json;
  json["scene"] = scene->name;
  json["particles"] = r.particles;
  add_machine(json, arguments.options.threads);
  json["places"] = r.places;
  json["step_ms"] = r.step_ms;
  json["first_read_ms"] = r.first_read_ms;
  json["next_read_ms"] = r.next_read_ms;
  for (const BenchQueries::Waves& waves : r.waves)
    json["waves"].push_back(
        {{"components", waves.components}, {"within_1_km_ms", waves.near_ms}, {"within_20_km_ms", waves.far_ms}});
  return write_json(json, arguments.json_file) ? 0 : 1;
}

int run(RunArguments& arguments) {
  on_stop_signals(request_stop);
  if (!try_output(arguments.json_file) || !choose_instruction_set(arguments.instruction_set)) return 1;
  const std::optional<Scene> scene = prepare_scene(arguments);
  if (!scene) return 1;
  const bool terminal = isatty(STDERR_FILENO) == 1;
  int shown = -1;
  const auto progress = [&](double part) {
    const int percent = static_cast<int>(part * 100.0);
    if (!terminal || percent == shown) return;
    shown = percent;
    std::fprintf(stderr, "\r%s: %3d %%", scene->name.c_str(), percent);
  };
  arguments.options.stop = &stop_requested;
  const BenchResult result = run_bench(*scene, arguments.options, progress);
  if (terminal) std::fputs("\r\033[K", stderr);
  for (const std::string& note : result.start_notes) std::cerr << "pelagos-bench: start: " << note << '\n';
  if (result.unconverged_steps > 0)
    std::cerr << "pelagos-bench: " << result.unconverged_steps << " of " << result.steps
              << " steps missed a tolerance; see density_error_mean for what that costs, and raise the scene's "
                 "solver.*.max_iterations or the tolerance\n";
  if (!write_json(to_json(*scene, arguments, result), arguments.json_file)) return 1;
  if (result.stopped) {
    std::cerr << "pelagos-bench: stopped by a signal after " << result.steps << " steps; the result is of these\n";
    return 1;
  }
  return result.not_finite_peak == 0 ? 0 : 3;  // as pelagos-server; 2 is a wrong command line
}

}  // namespace
}  // namespace pelagos

int main(int argc, char** argv) {
  CLI::App app{
      "Speed and error of the physics, without network or pacing.\n"
      "Example: pelagos-bench run --scene scenes/dam_break.scene --tolerance 1e-3 --seconds 2",
      "pelagos-bench"};
  app.set_version_flag("--version", std::string("pelagos-bench ") + pelagos::kVersion);
  app.require_subcommand(1);
  pelagos::RunArguments arguments;
  arguments.options.threads = pelagos::describe_machine().hardware_threads;
  CLI::App& run = *app.add_subcommand("run", "Advance a scene and print speed and error as JSON");
  pelagos::add_run_options(run, arguments);
  CLI::App& limits = *app.add_subcommand(
      "limits", "Measure what this machine does at best with the scene's data: arithmetic, reading, gathering");
  pelagos::add_common_options(limits, arguments);
  limits.add_option("--steps", arguments.limit_steps, "Time steps before the measurement (default: 100)")
      ->check(pelagos::WholeFrom(1, 1000000));
  CLI::App& queries = *app.add_subcommand(
      "queries", "Measure what a query of the surface with 1,000 places costs: particles, and 40 and 200 waves");
  pelagos::add_common_options(queries, arguments);
  queries.add_option("--steps", arguments.query_steps, "Time steps in which it measures (default: 30)")
      ->check(pelagos::WholeFrom(1, 1000000));
  if (const auto status = pelagos::parse_command_line(app, argc, argv)) return *status;
  try {
    if (queries.parsed()) return pelagos::queries(arguments);
    return limits.parsed() ? pelagos::limits(arguments) : pelagos::run(arguments);
  } catch (const std::exception& error) {
    std::cerr << "pelagos-bench: " << error.what() << '\n';
    return 1;
  }
}
