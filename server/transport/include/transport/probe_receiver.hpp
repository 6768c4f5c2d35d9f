#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pelagos_dds/participant.hpp"
#include "values/command.hpp"

namespace pelagos {

/// What a bridge asked for: a SetProbe or RemoveProbe, or why it cannot be one.
struct ProbeRequest {
  std::uint32_t sender = 0;
  Command command;
  std::string fault;  ///< empty: the command is good as far as it goes without the scene
};

/// Takes requests for probes off `probe_request_v1`. It has no thread of its own: requests are rare.
class ProbeReceiver {
 public:
  /// Throws DdsError.
  explicit ProbeReceiver(const std::shared_ptr<DdsParticipant>& participant);
  ~ProbeReceiver();
  ProbeReceiver(const ProbeReceiver&) = delete;
  ProbeReceiver& operator=(const ProbeReceiver&) = delete;

  /// Fills `requests` with what has come since the last call, at most 256.
  void take(std::vector<ProbeRequest>& requests);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
