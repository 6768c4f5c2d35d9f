#include "transport/clock_link.hpp"

#include <chrono>
#include <map>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/receiver_thread.hpp"
#include "values/token_bucket.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {

namespace {

constexpr ReceiverThread::Pace kPace{std::chrono::milliseconds(500), std::chrono::milliseconds(0)};
constexpr double kOfAll = 400.0, kOfAllAtOnce = 100.0;  // requests a second
constexpr double kOfClient = 10.0;                      // a second, and at once
constexpr std::size_t kMostClients = 64;                // that are told apart

}  // namespace

class ClockLink::Implementation {
 public:
  Implementation(const std::shared_ptr<DdsParticipant>& participant, std::uint64_t source,
                 std::function<std::int64_t()> steady_ns, const DdsLog& log)
      : participant_(participant),
        source_(source),
        steady_ns_(std::move(steady_ns)),
        log_(log),
        answers_(*participant_, topics::clock_answer()),
        requests_(*participant_, topics::clock_request()),
        thread_(*participant_, "requests for the clock", log_, kPace) {
    thread_.attach(requests_);
    thread_.start([this] { answer(); });
  }

 private:
  void answer() {
    const std::int64_t received = steady_ns_();
    requests_.take_all<pelagos_ClockRequestV1>([&](const pelagos_ClockRequestV1& request) {
      if (!may_ask(request.client)) return;
      pelagos_ClockAnswerV1 answer{source_, request.client, request.number, request.asked_ns, received, 0};
      answer.answered_ns = steady_ns_();
      if (!answers_.write(&answer)) log_.write("cannot publish clock_answer");
    });
  }

  bool may_ask(std::uint64_t client) {
    const auto now = TokenBucket::Clock::now();
    if (!all_.take(now)) return false;
    if (clients_.size() >= kMostClients && !clients_.contains(client))
      std::erase_if(clients_, [now](const auto& entry) { return entry.second.full(now); });
    if (clients_.size() >= kMostClients && !clients_.contains(client)) return true;
    return clients_.try_emplace(client, kOfClient, kOfClient).first->second.take(now);
  }

  std::shared_ptr<DdsParticipant> participant_;
  std::uint64_t source_;
  std::function<std::int64_t()> steady_ns_;
  RateLimitedLog log_;
  TokenBucket all_{kOfAll, kOfAllAtOnce};
  std::map<std::uint64_t, TokenBucket> clients_;
  DdsWriter answers_;
  DdsReader requests_;
  ReceiverThread thread_;
};

ClockLink::ClockLink(const std::shared_ptr<DdsParticipant>& participant, std::uint64_t source,
                     std::function<std::int64_t()> steady_ns, const DdsLog& log)
    : implementation_(std::make_unique<Implementation>(participant, source, std::move(steady_ns), log)) {}
ClockLink::~ClockLink() = default;

}  // namespace pelagos
