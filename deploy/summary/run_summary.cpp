#include "run_summary.hpp"

#include <array>
#include <cstdio>
#include <optional>

#include "machine_facts.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

using nlohmann::ordered_json;
using Pointer = ordered_json::json_pointer;

constexpr double kRealTime = 0.995;  ///< of real time: less is not 1.00 in two digits

/// The number at a place such as "/speed/step_ms_mean"; empty if there is none.
std::optional<double> number(const ordered_json& json, const char* place) {
  const Pointer pointer(place);
  if (!json.contains(pointer) || !json.at(pointer).is_number()) return std::nullopt;
  return json.at(pointer).get<double>();
}

double number_or_zero(const ordered_json& json, const char* place) { return number(json, place).value_or(0.0); }

std::string text(const ordered_json& json, const char* place) {
  const Pointer pointer(place);
  return json.contains(pointer) && json.at(pointer).is_string() ? json.at(pointer).get<std::string>() : "";
}

/// Collects "what: is VALUE, should be ALLOWED".
class Faults {
 public:
  void require_positive(const ordered_json& json, const char* place, const std::string& owner) {
    const auto value = number(json, place);
    if (!value) {
      list_.push_back(owner + ": reports no " + place);
    } else if (!(*value > 0.0)) {
      list_.push_back(owner + ": " + place + " is " + std::to_string(*value) + ", should be above 0");
    }
  }
  void require(bool good, std::string fault) {
    if (!good) list_.push_back(std::move(fault));
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

std::string name_of(const ordered_json& channel) { return "viewer " + text(channel, "/channel"); }

void judge_channel(const ordered_json& channel, Faults& faults) {
  const std::string name = name_of(channel);
  faults.require_positive(channel, "/frames_drawn", name);
  faults.require_positive(channel, "/pictures_written", name);
  for (const auto& error : channel.value("errors", ordered_json::array()))
    faults.require(false, name + ": " + error.dump());
}

std::string format(const char* pattern, auto... values) {
  std::array<char, 300> line{};
  std::snprintf(line.data(), line.size(), pattern, values...);
  return line.data();
}

ordered_json picture_list(const RunFiles& files) {
  ordered_json list = ordered_json::array();
  for (const PictureFile& picture : files.pictures) {
    list.push_back(
        {{"file", picture.name}, {"width", picture.width}, {"height", picture.height}, {"bytes", picture.bytes}});
  }
  return list;
}

}  // namespace

std::vector<std::string> find_failures(const RunFiles& files) {
  Faults faults;
  for (const char* place : {"/particles", "/speed/real_time_factor", "/speed/step_ms_mean",
                            "/transport/frames_published", "/transport/poses_accepted"}) {
    faults.require_positive(files.server, place, "server");
  }
  for (const ordered_json& channel : files.channels) judge_channel(channel, faults);
  faults.require(!files.channels.empty(), "no viewer left a report");
  faults.require(
      files.pictures.size() == files.channels.size(),
      std::to_string(files.pictures.size()) + " pictures of " + std::to_string(files.channels.size()) + " channels");
  faults.require(files.poses.sent > 0, "bridge: sent no pose");
  faults.require(files.poses.failed == 0, "bridge: " + std::to_string(files.poses.failed) + " poses could not be sent");
  faults.require(number_or_zero(files.status_after, "/wind/speed") > number_or_zero(files.status_before, "/wind/speed"),
                 "control: the wind did not rise");
  return faults.take();
}

std::vector<std::string> find_shortfalls(const RunFiles& files) {
  Faults faults;
  const double factor = number_or_zero(files.server, "/speed/real_time_factor");
  faults.require(factor >= kRealTime, format("server: the sea ran at %.2f of real time, should be 1.00: the machine is "
                                             "too slow for the scene, or other programs use its cores",
                                             factor));
  const double dropped = number_or_zero(files.server, "/transport/frames_dropped");
  faults.require(dropped == 0.0, format("server: %.0f frames dropped before they were sent, should be 0", dropped));
  const char* const cause = factor >= kRealTime
                                ? "socket buffers that are too small lose them (see docs/operators.md)"
                                : "the sea is slower than real time, so the processor has too much to do";
  for (const ordered_json& channel : files.channels) {
    const double missed = number_or_zero(channel, "/gaps"), received = number_or_zero(channel, "/frames_received");
    faults.require(missed == 0.0, name_of(channel) + format(": missed %.0f of %.0f frames, should be 0; %s", missed,
                                                            missed + received, cause));
  }
  return faults.take();
}

ordered_json summarise(const RunFiles& files, const RunFacts& facts, const std::vector<std::string>& faults) {
  return {
      {"version", kVersion},
      {"scene", text(files.server, "/scene")},
      {"scene_file", facts.scene_file},
      {"dds_domain", facts.domain},
      {"seconds", facts.seconds},
      {"wall_seconds", facts.wall_seconds},
      {"machine", machine_facts()},
      {"server", files.server},
      {"viewers", files.channels},
      {"bridge", {{"poses_sent", files.poses.sent}, {"poses_failed", files.poses.failed}}},
      {"control",
       {{"wind_before", files.status_before.value("wind", ordered_json())},
        {"wind_after", files.status_after.value("wind", ordered_json())},
        {"status_before", files.status_before},
        {"status_after", files.status_after}}},
      {"pictures", picture_list(files)},
      {"faults", faults},
  };
}

std::string describe(const ordered_json& summary) {
  const ordered_json& server = summary.at("server");
  const ordered_json& control = summary.at("control");
  std::string lines;
  lines += format("server     %.0f particles, %.2f of real time (%.2f achievable), %.1f ms a step\n",
                  number_or_zero(server, "/particles"), number_or_zero(server, "/speed/real_time_factor"),
                  number_or_zero(server, "/speed/achievable_real_time_factor"),
                  number_or_zero(server, "/speed/step_ms_mean"));
  lines += format("density    error %.3f %% mean, %.3f %% peak\n",
                  100.0 * number_or_zero(server, "/error/density_error_mean"),
                  100.0 * number_or_zero(server, "/error/density_error_peak"));
  lines +=
      format("frames     %.0f published, %.0f dropped, %.0f B a particle, hand-over %.3f ms\n",
             number_or_zero(server, "/transport/frames_published"), number_or_zero(server, "/transport/frames_dropped"),
             number_or_zero(server, "/transport/bytes_per_particle"),
             1e-3 * number_or_zero(server, "/transport/handover_us_mean"));
  lines += format("bridge     %.0f poses sent, %.0f accepted\n", number_or_zero(summary, "/bridge/poses_sent"),
                  number_or_zero(server, "/transport/poses_accepted"));
  lines += format("wind       %.1f m/s before, %.1f m/s after\n", number_or_zero(control, "/status_before/wind/speed"),
                  number_or_zero(control, "/status_after/wind/speed"));
  for (const ordered_json& viewer : summary.at("viewers")) {
    const auto latency = number(viewer, "/latency_ms/p50");
    lines += format("viewer     %-10s %4.0f frames drawn, %.1f a second, %.0f ms each, %s\n",
                    text(viewer, "/channel").c_str(), number_or_zero(viewer, "/frames_drawn"),
                    number_or_zero(viewer, "/fps"), number_or_zero(viewer, "/frame_ms_mean"),
                    latency ? format("%.0f ms behind the sea", *latency).c_str() : "latency not known");
  }
  return lines;
}

}  // namespace pelagos
