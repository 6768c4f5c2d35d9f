#include "announcer.hpp"

#include <fmt/format.h>

#include "control/control_server.hpp"
#include "server_log.hpp"
#include "transport/frame_publisher.hpp"

namespace pelagos {

namespace {

constexpr int kEventLines = 50;  // of each kind of event, in ten seconds

}  // namespace

void Announcer::announce(const std::string& kind, const std::string& source, const std::string& text) {
  Event event;
  event.sequence = ++events_;
  event.step = step_;
  event.simulation_time = time_;
  event.kind = kind;
  event.source = source;
  event.text = text;
  log(event);
  control_.broadcast(event);
  publisher_.publish_event(event);
}

void Announcer::log(const Event& event) {
  const bool fault = event.kind == "refused" || event.kind == "pose_refused";
  const auto write = [fault](std::string_view line) { fault ? log_warning(line) : log_info(line); };
  const auto entry = logs_.try_emplace(event.kind, write, kEventLines).first;
  entry->second.write(fmt::format("event {} at step {}, t {:.3f} s, by {}: {}{}", event.sequence, event.step,
                                  event.simulation_time, event.source, event.kind == "refused" ? "refused: " : "",
                                  event.text));
}

}  // namespace pelagos
