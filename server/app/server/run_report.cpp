#include "run_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "files/output_file.hpp"
#include "machine_json.hpp"
#include "values/wind.hpp"
#include "version/version.hpp"

namespace pelagos {

namespace {

using Json = nlohmann::ordered_json;

const char* describe(ServerEnd end) {
  switch (end) {
    case ServerEnd::kStopped:
      return "stopped";
    case ServerEnd::kDurationReached:
      return "duration_reached";
    case ServerEnd::kReplayEnded:
      return "replay_ended";
    case ServerEnd::kNumericalFault:
      return "numerical_fault";
  }
  return "";
}

Json speed(const ServerSummary& s) {
  return {{"wall_s", s.run.wall_s},
          {"simulated_s", s.run.simulated_s},
          {"steps", s.run.steps},
          {"real_time_factor", s.run.real_time_factor()},
          {"real_time_factor_lowest_second", s.lowest_real_time_factor},
          {"achievable_real_time_factor", s.run.achievable_real_time_factor()},
          {"step_ms_mean", s.run.step_ms()},
          {"step_ms_peak", s.run.step_ms_peak},
          {"time_step_s_mean", s.run.mean(s.run.simulated_s)},
          {"surface_ms_per_frame", s.surface_ms_mean}};
}

Json error(const ServerSummary& s) {
  return {{"density_error_mean", s.run.mean(s.run.density_error)},
          {"density_error_peak", s.run.density_error_peak},
          {"largest_density_peak", s.run.largest_density_peak},
          {"density_iterations_mean", s.run.mean(s.run.density_iterations)},
          {"divergence_iterations_mean", s.run.mean(s.run.divergence_iterations)},
          {"unconverged_steps", s.run.unconverged_steps},
          {"recoveries", s.status.recoveries}};
}

Json effort(const ServerSummary& s) {
  return {{"governed", s.status.governed},
          {"frame_budget_s", s.frame_budget},
          {"changes", s.effort_changes},
          {"over_budget", s.status.over_budget},
          {"max_step_s", s.status.effort.max_step},
          {"density_tolerance", s.status.effort.density_tolerance},
          {"divergence_tolerance", s.status.effort.divergence_tolerance}};
}

Json transport(const ServerSummary& s) {
  const PublisherCounters& p = s.publisher;
  return {{"frames_published", p.published},
          {"frames_dropped", p.dropped},
          {"frames_failed", p.failed},
          {"published_particles_last_frame", s.status.published_particles},
          {"bytes_per_particle", p.bytes_per_particle},
          {"handover_us_mean", p.handover_us_mean},
          {"handover_us_peak", p.handover_us_peak},
          {"pack_ms_mean", p.pack_ms_mean},
          {"publish_ms_mean", p.frame_ms_mean},
          {"poses_accepted", s.poses.accepted},
          {"poses_corrected", s.poses.corrected},
          {"poses_refused", s.poses.refused_in_all()}};
}

}  // namespace

std::string write_run_report(const std::string& file, const ServerSummary& s) {
  Json json;
  json["version"] = kVersion;
  json["scene"] = s.status.scene;
  json["end"] = describe(s.end);
  if (s.end == ServerEnd::kReplayEnded) json["replay"] = s.replay_differs ? "other bits" : "the same bits";
  json["particles"] = s.status.particles;
  json["boundary_particles"] = s.status.boundary_particles;
  json["hull_samples"] = s.hull_samples;
  add_machine(json, s.threads);
  json["peak_memory_bytes"] = peak_memory();
  json["state"] = {{"step", s.status.step},
                   {"simulation_time_s", s.status.simulation_time},
                   {"hash", fmt::format("{:016x}", s.state_hash)},
                   {"world_hash", fmt::format("{:016x}", s.world_hash)}};
  json["speed"] = speed(s);
  json["error"] = error(s);
  json["effort"] = effort(s);
  json["transport"] = transport(s);
  json["control"] = {{"requests", s.control.requests},
                     {"malformed", s.control.malformed},
                     {"oversize", s.control.oversize},
                     {"invalid", s.control.invalid}};
  if (s.status.wind)
    json["wind"] = {{"speed_m_s", s.status.wind->velocity.head<2>().norm()},
                    {"from_deg", wind_from_deg(s.status.wind->velocity)}};
  if (s.status.current)
    json["current"] = {{"speed_m_s", s.status.current->velocity.norm()},
                       {"to_deg", current_to_deg(s.status.current->velocity)}};
  if (s.status.command_log)
    json["command_log"] = {{"file", s.status.command_log->file},
                           {"lines_missing", s.status.command_log->waiting + s.status.command_log->lost}};
  const std::string fault = write_whole_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return fault.empty() ? "" : "--report: " + fault;
}

}  // namespace pelagos
