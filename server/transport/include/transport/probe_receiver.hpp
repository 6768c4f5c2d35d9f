#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelagos_dds/participant.hpp"
#include "text/refusal.hpp"
#include "values/command.hpp"

namespace pelagos {

/// What a bridge asked for: a SetProbe or RemoveProbe, or why it cannot be one.
struct ProbeRequest {
  std::uint32_t sender = 0;
  Command command;
  std::optional<Refusal> refusal;  ///< none: the command is good as far as it goes without the scene
};

/// How many requests are taken. Each one that is becomes a command, an event and a line in the command log, so somebody
/// who sends them without end would fill the disk.
struct ProbeLimits {
  double burst = 300.0;          ///< of one sender at once: all probes that there may be, and some again
  double per_second = 20.0;      ///< of one sender, sustained
  double all_burst = 600.0;      ///< of all together
  double all_per_second = 50.0;  ///< of all together, sustained
  std::size_t senders = 64;      ///< that are told from each other; the others share one budget
};

/// Takes requests for probes off `probe_request_v1`. It has no thread of its own: requests are rare.
class ProbeReceiver {
 public:
  /// Throws DdsError.
  explicit ProbeReceiver(const std::shared_ptr<DdsParticipant>& participant, const ProbeLimits& limits = {});
  ~ProbeReceiver();
  ProbeReceiver(const ProbeReceiver&) = delete;
  ProbeReceiver& operator=(const ProbeReceiver&) = delete;

  /// Fills `requests` with what has come since the last call, at most 256.
  void take(std::vector<ProbeRequest>& requests);

  /// Requests beyond the limits since the start. They are lost: their sender must ask again.
  [[nodiscard]] std::uint64_t dropped() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
