#include "source/frame_source.hpp"

namespace pelagos {
namespace {

class DdsSource final : public FrameSource {
 public:
  explicit DdsSource(const DdsSettings& settings) : receiver_(settings) {}
  std::unique_ptr<OceanFrame> take_newest() override { return receiver_.take_newest(); }
  void recycle(std::unique_ptr<OceanFrame> frame) override { receiver_.recycle(std::move(frame)); }
  bool wait_for_frame(std::chrono::milliseconds timeout) override { return receiver_.wait_for_frame(timeout); }
  std::optional<SceneInfo> scene_info() override { return receiver_.scene_info(); }
  std::uint64_t scene_revision() override { return receiver_.scene_revision(); }
  std::optional<ServerStatus> status() override { return receiver_.status(); }
  std::optional<WindSettings> wind() override { return receiver_.wind(); }
  std::shared_ptr<const OceanSlick> slick() override { return receiver_.slick(); }
  bool server_alive() override { return receiver_.server_alive(); }
  ReceiverCounters counters() override { return receiver_.counters(); }

 private:
  FrameReceiver receiver_;
};

}  // namespace

std::unique_ptr<FrameSource> make_dds_source(const DdsSettings& settings) {
  return std::make_unique<DdsSource>(settings);
}

}  // namespace pelagos
