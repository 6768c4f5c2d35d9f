#include "clock_exchange.hpp"

#include <algorithm>

#include "wire/topics.hpp"

namespace pelagos {

namespace {

constexpr std::int64_t kSoonNs = 240'000'000, kLaterNs = 1'000'000'000;
constexpr std::size_t kFirstAnswers = 8;
constexpr std::size_t kMostOpen = 4;

}  // namespace

ClockExchange::ClockExchange(const DdsParticipant& participant, std::uint64_t client)
    : requests_(participant, topics::clock_request()), client_(client) {}

void ClockExchange::ask_if_due(const std::function<std::int64_t()>& steady_ns) {
  const std::int64_t now = steady_ns();
  const std::int64_t pause = answers_ < kFirstAnswers ? kSoonNs : kLaterNs;
  if (last_asked_ns_ && now - *last_asked_ns_ < pause) return;
  if (requests_.matched_readers() == 0) return;
  last_asked_ns_ = now;
  open_.push_back({++number_, steady_ns()});
  if (open_.size() > kMostOpen) open_.pop_front();
  const pelagos_ClockRequestV1 request{client_, number_, open_.back().asked_ns};
  (void)requests_.write(&request);  // one that is lost is made again
}

std::optional<ClockStamps> ClockExchange::match(const pelagos_ClockAnswerV1& answer, std::int64_t now_ns) {
  if (answer.client != client_) return std::nullopt;
  const auto request = std::find_if(open_.begin(), open_.end(), [&](const Request& open) {
    return open.number == answer.number && open.asked_ns == answer.asked_ns;
  });
  if (request == open_.end()) return std::nullopt;
  open_.erase(request);
  ++answers_;
  return ClockStamps{answer.asked_ns, answer.received_ns, answer.answered_ns, now_ns};
}

void ClockExchange::restart() {
  answers_ = 0;
  open_.clear();
  last_asked_ns_.reset();
}

}  // namespace pelagos
