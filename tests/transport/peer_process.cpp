// The other side, for tests that stop or kill it. Ends after 60 s at the latest.
//   pelagos-test-peer viewer DOMAIN   follows the frames, prints "frame N missed M" for each one that it takes, with
//                                 "no server" or "server" behind it
//   pelagos-test-peer server DOMAIN   publishes a frame every 20 ms
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "loopback.hpp"

namespace {

using namespace pelagos;
using Clock = std::chrono::steady_clock;

void run_viewer(const DdsSettings& settings, Clock::time_point end) {
  FrameReceiver receiver(settings);
  while (Clock::now() < end) {
    if (!receiver.wait_for_frame(std::chrono::milliseconds(200))) continue;
    auto frame = receiver.take_newest();
    std::printf("frame %llu missed %llu %s\n", static_cast<unsigned long long>(frame->frame),
                static_cast<unsigned long long>(receiver.counters().missed),
                receiver.server_alive() ? "server" : "no server");
    std::fflush(stdout);
    receiver.recycle(std::move(frame));
  }
}

void run_server(const DdsSettings& settings, Clock::time_point end) {
  FramePublisher publisher(join_dds(settings), test_scene());
  for (std::uint64_t frame = 0; Clock::now() < end; ++frame) {
    publisher.submit(test_snapshot(publisher, frame, 100));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const DdsSettings settings{static_cast<std::uint32_t>(std::atoi(argv[2])), "", [](std::string_view line) {
                               std::fprintf(stderr, "%.*s\n", static_cast<int>(line.size()), line.data());
                             }};
  const auto end = Clock::now() + std::chrono::seconds(60);
  try {
    std::string(argv[1]) == "server" ? run_server(settings, end) : run_viewer(settings, end);
    return 0;
  } catch (const DdsError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
