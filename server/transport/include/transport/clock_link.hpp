#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "pelagos_dds/participant.hpp"

namespace pelagos {

/// Tells viewers what the server's steady clock shows: answers `clock_request_v1` with `clock_answer_v1` at once, on a
/// thread of its own, which waits while nobody asks. A flood costs that thread alone: 100 requests are answered at
/// once, then 400 a second, and of one client 10, then 10 a second; others are not answered.
class ClockLink {
 public:
  /// @param source     of the server, as on its other topics
  /// @param steady_ns  the clock that the schedule is stamped with; called on the link's thread. Throws DdsError
  ClockLink(const std::shared_ptr<DdsParticipant>& participant, std::uint64_t source,
            std::function<std::int64_t()> steady_ns, const DdsLog& log = {});
  ~ClockLink();
  ClockLink(const ClockLink&) = delete;
  ClockLink& operator=(const ClockLink&) = delete;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
