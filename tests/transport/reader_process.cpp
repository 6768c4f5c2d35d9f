// A viewer without a picture, for tests that stop or kill it: follows the frames of a domain, prints "frame N" for each
// one it takes, and ends after 60 s at the latest.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "client/frame_receiver.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  pelagos::FrameReceiver receiver({static_cast<std::uint32_t>(std::atoi(argv[1])), "", {}});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end) {
    if (!receiver.wait_for_frame(std::chrono::milliseconds(200))) continue;
    auto frame = receiver.take_newest();
    std::printf("frame %llu missed %llu\n", static_cast<unsigned long long>(frame->frame),
                static_cast<unsigned long long>(receiver.counters().missed));
    std::fflush(stdout);
    receiver.recycle(std::move(frame));
  }
  return 0;
}
