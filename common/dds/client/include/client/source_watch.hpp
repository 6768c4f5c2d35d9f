#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace pelagos {

/// A process in the domain, as DDS names it: the GUID of its participant.
using ParticipantId = std::array<std::uint8_t, 16>;

/// What a sample is to a viewer.
enum class Standing {
  kFollowed,   ///< of the server that is followed
  kTakenOver,  ///< of a server that is followed from this sample on: what is known of the last one is of no use now
  kOther,      ///< of another server, while the followed one lives
  kIntruder,   ///< carries the followed server's source, but comes from another process
  kNobody,     ///< faulty, and not of the server that is followed
};

/// Which server a viewer follows, and whether it lives. Any sample is a sign of life. The first server that is heard is
/// followed; another one is followed once the first has been silent for kSilence. A source belongs to the process that
/// was heard with it first: another process that uses the same source must also wait until the first has left the
/// domain. Of one thread, but for last_heard().
class SourceWatch {
 public:
  using Clock = std::chrono::steady_clock;
  using IsPresent = std::function<bool(const ParticipantId&)>;
  static constexpr std::chrono::seconds kSilence{2};

  /// Who sent a sample.
  struct Sender {
    std::uint64_t source = 0;
    ParticipantId process{};
    [[nodiscard]] bool operator==(const Sender&) const = default;
  };

  /// @param is_present  whether a process is still in the domain; asked at most every quarter of a second
  explicit SourceWatch(IsPresent is_present) : is_present_(std::move(is_present)) {}

  /// @param valid  the sample has no fault. A faulty one is a sign of life, but nobody is followed because of it
  [[nodiscard]] Standing hear(const Sender& sender, bool valid, Clock::time_point now);

  /// When the followed server was heard last; nothing if none is followed.
  [[nodiscard]] std::optional<Clock::time_point> last_heard() const { return last_heard_; }

 private:
  [[nodiscard]] bool owner_has_left(Clock::time_point now);

  IsPresent is_present_;
  std::optional<Sender> followed_;
  std::optional<Clock::time_point> last_heard_, last_asked_;
};

}  // namespace pelagos
