#include "transport/probe_receiver.hpp"

#include <cmath>
#include <utility>

#include "pelagos_dds/entities.hpp"
#include "wire/convert.hpp"
#include "wire/topics.hpp"

namespace pelagos {

namespace {

constexpr int kRounds = 8;  // of 32 samples: the simulation waits meanwhile

std::string fault_of(const pelagos_ProbeRequestV1& sample) {
  if (sample.probe == 0) return "probe is 0; allowed: 1 or more";
  const pelagos_Vector3& x = sample.position;
  if (!sample.remove && !std::isfinite(x.x + x.y + x.z)) return "position is not finite";
  return {};
}

}  // namespace

class ProbeReceiver::Implementation {
 public:
  explicit Implementation(std::shared_ptr<DdsParticipant> participant)
      : participant_(std::move(participant)), reader_(*participant_, topics::probe_request()) {}

  void take(std::vector<ProbeRequest>& requests) const {
    requests.clear();
    reader_.take_all<pelagos_ProbeRequestV1>(
        [&](const pelagos_ProbeRequestV1& sample) {
          ProbeRequest& request = requests.emplace_back();
          request.sender = sample.sender;
          request.fault = fault_of(sample);
          request.command =
              sample.remove ? Command(RemoveProbe{sample.probe}) : Command(SetProbe{wire::from_wire(sample)});
        },
        kRounds);
  }

 private:
  std::shared_ptr<DdsParticipant> participant_;
  DdsReader reader_;
};

ProbeReceiver::ProbeReceiver(const std::shared_ptr<DdsParticipant>& participant)
    : implementation_(std::make_unique<Implementation>(participant)) {}
ProbeReceiver::~ProbeReceiver() = default;

void ProbeReceiver::take(std::vector<ProbeRequest>& requests) { implementation_->take(requests); }

}  // namespace pelagos
