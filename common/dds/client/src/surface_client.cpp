#include "client/surface_client.hpp"

#include <utility>

#include "pelagos_dds/entities.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {

class SurfaceClient::Implementation {
 public:
  Implementation(std::shared_ptr<DdsParticipant> participant, std::uint32_t client)
      : participant_(std::move(participant)),
        client_(client),
        queries_(*participant_, topics::surface_query()),
        answers_(*participant_, topics::surface_answer()),
        waitset_(*participant_) {
    waitset_.attach(answers_);
  }

  Sent ask(const SurfaceQuery& query) {
    if (auto fault = find_fault(query)) return {0, std::move(fault)};
    const wire::SurfaceQuerySample sample(query, client_, ++number_, pelagos_FRAME_ENU);
    if (!queries_.write(&sample.get())) return {0, Refusal{"", "the DDS library refused the sample"}};
    return {number_, std::nullopt};
  }

  std::vector<SurfaceReply> take() {
    std::vector<SurfaceReply> replies;
    answers_.take_all<pelagos_SurfaceAnswerV1>([&](const pelagos_SurfaceAnswerV1& sample) {
      if (sample.client != client_) return;
      if (wire::find_fault(sample)) {
        ++refused_;
        return;
      }
      replies.push_back({sample.source, sample.query, wire::from_wire(sample)});
    });
    return replies;
  }

  std::optional<SurfaceReply> wait_for(std::uint64_t number, std::chrono::milliseconds timeout) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + timeout;
    for (;;) {
      for (SurfaceReply& reply : take())
        if (reply.number == number) return std::move(reply);
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
      if (left.count() <= 0) return std::nullopt;
      waitset_.wait(left);
    }
  }

  std::uint64_t refused_ = 0;
  std::shared_ptr<DdsParticipant> participant_;
  std::uint32_t client_;
  std::uint64_t number_ = 0;
  DdsWriter queries_;
  DdsReader answers_;
  DdsWaitSet waitset_;
};

SurfaceClient::SurfaceClient(std::shared_ptr<DdsParticipant> participant, std::uint32_t client)
    : implementation_(std::make_unique<Implementation>(std::move(participant), client)) {}
SurfaceClient::~SurfaceClient() = default;

SurfaceClient::Sent SurfaceClient::ask(const SurfaceQuery& query) { return implementation_->ask(query); }
std::vector<SurfaceReply> SurfaceClient::take() { return implementation_->take(); }
std::optional<SurfaceReply> SurfaceClient::wait_for(std::uint64_t number, std::chrono::milliseconds timeout) {
  return implementation_->wait_for(number, timeout);
}
std::uint64_t SurfaceClient::refused_samples() const { return implementation_->refused_; }
std::uint32_t SurfaceClient::servers() const { return implementation_->queries_.matched_readers(); }

}  // namespace pelagos
