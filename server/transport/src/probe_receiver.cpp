#include "transport/probe_receiver.hpp"

#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "text/characters.hpp"
#include "values/token_bucket.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {

namespace {

constexpr int kRounds = 8;  // of 32 samples: the simulation waits meanwhile

/// A character that moves what is written after it, or is none.
bool is_unfit_for_names(const Character& c) {
  const auto within = [&](char32_t first, char32_t last) { return c.code >= first && c.code <= last; };
  return !c.valid || c.code < 0x20 || within(0x7f, 0x9f) || within(0x2028, 0x202e) || within(0x2066, 0x2069);
}

std::optional<Refusal> find_fault_of_name(std::string_view name) {
  for (std::size_t at = 0; at < name.size();) {
    const Character character = character_at(name, at);
    if (is_unfit_for_names(character))
      return Refusal{"name", "has at byte " + std::to_string(at + 1) + " " + describe_character(character) +
                                 "; allowed: up to 64 bytes of UTF-8, none of them a control character"};
    at += character.bytes;
  }
  return std::nullopt;
}

std::optional<Refusal> find_fault(const pelagos_ProbeRequestV1& sample) {
  if (sample.probe == 0) return Refusal{"probe", "is 0; allowed: 1 or more"};
  if (sample.remove) return std::nullopt;
  const pelagos_Vector3& x = sample.position;
  const std::pair<const char*, double> parts[] = {{"position.x", x.x}, {"position.y", x.y}, {"position.z", x.z}};
  for (const auto& [field, value] : parts)
    if (!std::isfinite(value)) return Refusal{field, "is " + std::to_string(value) + "; allowed: a finite number, m"};
  return find_fault_of_name(sample.name);
}

}  // namespace

class ProbeReceiver::Implementation {
 public:
  Implementation(std::shared_ptr<DdsParticipant> participant, const ProbeLimits& limits)
      : limits_(limits),
        all_(limits.all_per_second, limits.all_burst),
        participant_(std::move(participant)),
        reader_(*participant_, topics::probe_request()) {}

  void take(std::vector<ProbeRequest>& requests) {
    requests.clear();
    reader_.take_all<pelagos_ProbeRequestV1>(
        [&](const pelagos_ProbeRequestV1& sample) {
          if (!afford(sample.sender)) return;
          ProbeRequest& request = requests.emplace_back();
          request.sender = sample.sender;
          request.refusal = find_fault(sample);
          const bool nameless = find_fault_of_name(sample.name).has_value();
          request.command =
              sample.remove ? Command(RemoveProbe{sample.probe}) : Command(SetProbe{wire::from_wire(sample)});
          if (auto* set = std::get_if<SetProbe>(&request.command); set != nullptr && nameless)
            set->probe.name = "probe " + std::to_string(sample.probe);  // it is shown with the refusal
        },
        kRounds);
  }

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  bool afford(std::uint32_t sender) {
    const auto now = TokenBucket::Clock::now();
    if (!senders_.contains(sender) && senders_.size() >= limits_.senders) sender = 0;
    TokenBucket& own = senders_.try_emplace(sender, limits_.per_second, limits_.burst).first->second;
    if (!own.has(now) || !all_.has(now)) {
      ++dropped_;
      return false;
    }
    own.spend();
    all_.spend();
    return true;
  }

  ProbeLimits limits_;
  TokenBucket all_;
  std::unordered_map<std::uint32_t, TokenBucket> senders_;
  std::uint64_t dropped_ = 0;
  std::shared_ptr<DdsParticipant> participant_;
  DdsReader reader_;
};

ProbeReceiver::ProbeReceiver(const std::shared_ptr<DdsParticipant>& participant, const ProbeLimits& limits)
    : implementation_(std::make_unique<Implementation>(participant, limits)) {}
ProbeReceiver::~ProbeReceiver() = default;

void ProbeReceiver::take(std::vector<ProbeRequest>& requests) { implementation_->take(requests); }
std::uint64_t ProbeReceiver::dropped() const { return implementation_->dropped(); }

}  // namespace pelagos
