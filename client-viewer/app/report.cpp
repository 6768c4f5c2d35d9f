#include "app/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/picture.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

using nlohmann::ordered_json;

double rounded(double value) { return std::round(value * 1000.0) / 1000.0; }

/// Mean and percentiles; null without samples.
ordered_json distribution(std::vector<double> samples) {
  if (samples.empty()) return nullptr;
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double part) {
    return rounded(samples[static_cast<std::size_t>(part * static_cast<double>(samples.size() - 1))]);
  };
  double sum = 0.0;
  for (const double sample : samples) sum += sample;
  const double mean = rounded(sum / static_cast<double>(samples.size()));
  return {{"mean", mean}, {"p50", at(0.5)}, {"p99", at(0.99)}, {"max", at(1.0)}};
}

ordered_json clock_difference(const Latency& latency) {
  const std::optional<double> seconds = latency.clock_difference();
  return seconds ? ordered_json(rounded(*seconds)) : ordered_json(nullptr);
}

ordered_json clock_error(const ClockState& clock) {
  return clock.error >= 0.0 ? ordered_json(rounded(1e3 * clock.error)) : ordered_json(nullptr);
}

}  // namespace

const char* name_of(ViewerClock clock) {
  switch (clock) {
    case ViewerClock::kArrival:
      return "arrival";
    case ViewerClock::kMeasured:
      return "measured";
    case ViewerClock::kHost:
      return "host";
    case ViewerClock::kNone:
      break;
  }
  return "none";
}

void write_report(const RunReport& report, const std::filesystem::path& file) {
  const double drawn = static_cast<double>(std::max<std::uint64_t>(report.frames_drawn, 1));
  const double pictures = static_cast<double>(std::max<std::uint64_t>(report.pictures_written, 1));
  ordered_json passes;
  for (std::size_t i = 0; i < kPassNames.size(); ++i) passes[kPassNames[i]] = rounded(report.pass_ms_sum[i] / drawn);
  const ordered_json root = {
      {"channel", report.channel},
      {"scene", report.scene},
      {"version", kVersion},
      {"gl_renderer", report.renderer},
      {"width", report.width},
      {"height", report.height},
      {"frames_drawn", report.frames_drawn},
      {"fps", report.seconds > 0.0 ? rounded(static_cast<double>(report.frames_drawn) / report.seconds) : 0.0},
      {"seconds", rounded(report.seconds)},
      {"seconds_without_server", rounded(report.seconds_without_server)},
      {"frame_ms_mean", rounded(report.frame_ms_sum / drawn)},
      {"pass_ms_mean", passes},
      {"picture_ms_mean", rounded(report.picture_ms_sum / pictures)},
      {"latency_ms", distribution(report.latency.from_server())},
      {"latency_from_arrival_ms", distribution(report.latency.from_arrival())},
      {"clock_difference_s", clock_difference(report.latency)},
      {"delay_ms", rounded(1e3 * report.delay)},
      {"skew_ms", distribution(report.skew_ms)},
      {"pictures_held", report.pictures_held},
      {"clock", name_of(report.clock.clock)},
      {"clock_offset_s", 1e-9 * static_cast<double>(report.clock.offset_ns)},
      {"clock_error_ms", clock_error(report.clock)},
      {"paused", report.paused},
      {"frames_received", report.counters.received},
      {"gaps", report.counters.missed},
      {"frame_jumps", report.counters.jumps},
      {"frames_repeated", report.counters.repeated},
      {"frames_replaced", report.counters.replaced},
      {"frames_refused", report.counters.refused},
      {"frames_foreign", report.counters.foreign},
      {"samples_intruding", report.counters.intruding},
      {"others_refused", report.counters.others_refused},
      {"slicks_received", report.counters.slicks},
      {"slicks_refused", report.counters.slicks_refused},
      {"pictures_written", report.pictures_written},
      {"last_picture", report.last_picture},
      {"errors", report.errors},
  };
  write_file(file, root.dump(2) + "\n");
}

}  // namespace pelagos
