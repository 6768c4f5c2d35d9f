#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "pelagos_dds/entities.hpp"
#include "schedule/clock_offset.hpp"
#include "wire/convert.hpp"

namespace pelagos {

/// Asks servers for their steady clock: four times a second until eight answers have come, then once a second. Of one
/// thread.
class ClockExchange {
 public:
  ClockExchange(const DdsParticipant& participant, std::uint64_t client);

  /// A round of the thread. @param steady_ns  reads the clock here
  void ask_if_due(const std::function<std::int64_t()>& steady_ns);
  /// The stamps of an answer to a request of this viewer that has not been answered yet; else nothing.
  [[nodiscard]] std::optional<ClockStamps> match(const pelagos_ClockAnswerV1& answer, std::int64_t now_ns);
  /// Another server is asked from now on.
  void restart();

 private:
  struct Request {
    std::uint64_t number;
    std::int64_t asked_ns;
  };
  DdsWriter requests_;
  std::uint64_t client_, number_ = 0;
  std::size_t answers_ = 0;
  std::deque<Request> open_;
  std::optional<std::int64_t> last_asked_ns_;
};

}  // namespace pelagos
