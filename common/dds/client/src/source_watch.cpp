#include "client/source_watch.hpp"

namespace pelagos {

Standing SourceWatch::hear(const Sender& sender, bool valid, Clock::time_point now) {
  const bool same_source = followed_ && followed_->source == sender.source;
  if (followed_ == sender) {
    last_heard_ = now;
    return Standing::kFollowed;
  }
  if (!valid) return Standing::kNobody;
  const bool silent = !last_heard_ || now - *last_heard_ >= kSilence;
  if (!silent || (same_source && !owner_has_left(now))) return same_source ? Standing::kIntruder : Standing::kOther;
  followed_ = sender;
  last_heard_ = now;
  last_asked_.reset();
  return Standing::kTakenOver;
}

bool SourceWatch::owner_has_left(Clock::time_point now) {
  constexpr std::chrono::milliseconds kPause{250};  // a flood of samples must not ask each time
  if (last_asked_ && now - *last_asked_ < kPause) return false;
  last_asked_ = now;
  return !is_present_(followed_->process);
}

}  // namespace pelagos
