#include "transport/surface_link.hpp"

#include <chrono>
#include <string>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/receiver_thread.hpp"
#include "values/token_bucket.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {

namespace {

constexpr ReceiverThread::Pace kPace{std::chrono::milliseconds(500), std::chrono::milliseconds(1)};
constexpr double kRefusalsPerSecond = 20.0;

/// The writer outlives the link for as long as an answer is on its way.
struct AnswerWriter {
  AnswerWriter(std::shared_ptr<DdsParticipant> in, std::uint64_t of, DdsLog to)
      : participant(std::move(in)), source(of), log(std::move(to)), writer(*participant, topics::surface_answer()) {}

  void write(const SurfaceNews& news, const wire::ReceivedSurfaceQuery& to) {
    const wire::SurfaceAnswerSample sample(news, to, source);
    if (!writer.write(&sample.get())) log.write("cannot publish surface_answer");
  }

  std::shared_ptr<DdsParticipant> participant;
  std::uint64_t source;
  RateLimitedLog log;
  DdsWriter writer;
};

}  // namespace

class SurfaceLink::Implementation {
 public:
  Implementation(const std::shared_ptr<DdsParticipant>& participant, std::uint64_t source, AskSurface ask,
                 const DdsLog& log)
      : ask_(std::move(ask)),
        answers_(std::make_shared<AnswerWriter>(participant, source, log)),
        queries_(*participant, topics::surface_query()),
        thread_(*participant, "queries of the surface", answers_->log, kPace) {
    thread_.attach(queries_);
    thread_.start([this] { take_queries(); });
  }

 private:
  void take_queries() {
    queries_.take_all<pelagos_SurfaceQueryV1>(
        [&](const pelagos_SurfaceQueryV1& sample) { ask(wire::from_wire(sample)); });
  }

  void ask(wire::ReceivedSurfaceQuery received) {
    const auto query = std::make_shared<const wire::ReceivedSurfaceQuery>(std::move(received));
    const auto refusal = ask_(query->query, "bridge " + std::to_string(query->client),
                              [answers = answers_, query](const SurfaceNews& news) { answers->write(news, *query); });
    if (!refusal || !refusals_.take(TokenBucket::Clock::now())) return;
    answers_->write({{}, query->fault.empty() ? to_string(*refusal) : query->fault}, *query);
  }

  AskSurface ask_;
  std::shared_ptr<AnswerWriter> answers_;
  TokenBucket refusals_{kRefusalsPerSecond, kRefusalsPerSecond};
  DdsReader queries_;
  ReceiverThread thread_;
};

SurfaceLink::SurfaceLink(std::shared_ptr<DdsParticipant> participant, std::uint64_t source, AskSurface ask, DdsLog log)
    : implementation_(std::make_unique<Implementation>(participant, source, std::move(ask), log)) {}
SurfaceLink::~SurfaceLink() = default;

}  // namespace pelagos
