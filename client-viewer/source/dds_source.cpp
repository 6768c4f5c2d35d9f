#include "source/frame_source.hpp"

namespace pelagos {
namespace {

class DdsSource final : public FrameSource {
 public:
  DdsSource(const DdsSettings& settings, const LocalClocks& clocks) : clocks_(clocks), receiver_(settings, clocks) {}
  std::unique_ptr<OceanFrame> take_next() override { return receiver_.take_next(); }
  void recycle(std::unique_ptr<OceanFrame> frame) override { receiver_.recycle(std::move(frame)); }
  std::optional<SceneInfo> scene_info() override { return receiver_.scene_info(); }
  std::uint64_t scene_revision() override { return receiver_.scene_revision(); }
  std::optional<ServerStatus> status() override { return receiver_.status(); }
  std::optional<WindSettings> wind() override { return receiver_.wind(); }
  std::shared_ptr<const OceanSlick> slick_at(double time) override { return receiver_.slick_at(time); }
  std::int64_t now_ns() override { return clocks_.now().clock_ns; }
  std::optional<DueInstant> due_at(std::int64_t moment_ns) override { return receiver_.due_at(moment_ns); }
  ClockState clock_state() override { return receiver_.clock_state(); }
  void tell(const ViewerStatus& status) override { receiver_.tell(status); }
  bool server_alive() override { return receiver_.server_alive(); }
  ReceiverCounters counters() override { return receiver_.counters(); }

 private:
  LocalClocks clocks_;
  FrameReceiver receiver_;
};

}  // namespace

std::unique_ptr<FrameSource> make_dds_source(const DdsSettings& settings, const LocalClocks& clocks) {
  return std::make_unique<DdsSource>(settings, clocks);
}

}  // namespace pelagos
