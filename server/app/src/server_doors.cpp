// Who can reach the server, and what is told of those who send what it does not take.

#include <fmt/format.h>

#include "control/endpoint.hpp"
#include "monotonic_clock.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "server.hpp"
#include "server_log.hpp"

namespace pelagos {
namespace {

constexpr std::int64_t kRefusalsIntervalNs = 10'000'000'000;  // between two events about poses
constexpr int kEventLines = 50;                               // of each kind of event, in ten seconds

}  // namespace

void Server::tell_open_links(const DdsParticipant& participant, const DdsSettings& dds) {
  std::vector<OpenLink> open;
  const std::string control = describe_reach(options_.control.host);
  if (!control.empty())
    open.push_back({"control " + to_string(Endpoint{options_.control.host, control_->port()}), control});
  const std::string network = describe_reach(reach_of(participant), dds);
  if (!network.empty()) open.push_back({fmt::format("DDS domain {}", options_.domain), network});
  for (const OpenLink& link : open) log_warning(link.link + " is open: " + link.reach);
  const std::scoped_lock lock(status_mutex_);
  status_.open_links = std::move(open);
}

void Server::fill_pose_counts(ServerStatus& status) const {
  const PoseCounters poses = poses_->counters();
  status.poses_accepted = poses.accepted;
  status.poses_refused = poses.refused_in_all();
  status.poses_corrected = poses.corrected;
  status.pose_refusals.clear();
  for (std::size_t k = 0; k < poses.refused.size(); ++k)
    if (poses.refused[k] > 0) status.pose_refusals.push_back({describe(static_cast<PoseFault>(k)), poses.refused[k]});
}

/// One event in ten seconds, so that an instructor hears of it; the log has the bodies and senders.
void Server::watch_refusals() {
  const std::int64_t now = monotonic_ns();
  if (now < next_refusals_ns_) return;
  const PoseCounters poses = poses_->counters();
  const std::uint64_t in_all = poses.refused_in_all() + poses.corrected;
  if (in_all == refusals_told_) return;
  refusals_told_ = in_all;
  next_refusals_ns_ = now + kRefusalsIntervalNs;
  std::string text =
      fmt::format("poses since the start: {} accepted, {} of them with the velocity of their places; {} refused",
                  poses.accepted, poses.corrected, poses.refused_in_all());
  for (std::size_t k = 0; k < poses.refused.size(); ++k)
    if (poses.refused[k] > 0) text += fmt::format("; {}: {}", poses.refused[k], describe(static_cast<PoseFault>(k)));
  announce("pose_refused", "server", text);
}

/// Likewise of requests for probes that came too fast.
void Server::watch_dropped_requests() {
  const std::uint64_t dropped = probe_requests_->dropped();
  const std::int64_t now = monotonic_ns();
  if (dropped == requests_dropped_ || now < next_dropped_ns_) return;
  next_dropped_ns_ = now + kRefusalsIntervalNs;
  announce("refused", "server",
           fmt::format("{} requests for probes came too fast and were not taken; allowed: 20 a second of a bridge, 300 "
                       "at once",
                       dropped - requests_dropped_));
  requests_dropped_ = dropped;
}

void Server::log_event(const Event& event) {
  const bool fault = event.kind == "refused" || event.kind == "pose_refused";
  const auto write = [fault](std::string_view line) { fault ? log_warning(line) : log_info(line); };
  const auto log = event_logs_.try_emplace(event.kind, write, kEventLines).first;
  log->second.write(fmt::format("event {} at step {}, t {:.3f} s, by {}: {}", event.sequence, event.step,
                                event.simulation_time, event.source, event.text));
}

}  // namespace pelagos
