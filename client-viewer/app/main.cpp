#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>

#include "app/options.hpp"
#include "app/run.hpp"
#include "channels/rig.hpp"
#include "command_line/stop_signals.hpp"
#include "source/frame_source.hpp"
#include "text/printable.hpp"

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);
extern "C" void request_stop(int) { stop_requested = true; }

int run(const pelagos::Options& options) {
  using namespace pelagos;
  const Rig rig = load_rig(options.rig);
  const Channel* channel = rig.find(options.channel);
  if (channel == nullptr) {
    std::fprintf(stderr, "pelagos-viewer: --channel: is %s; allowed by %s: %s\n", options.channel.c_str(),
                 options.rig.c_str(), rig.channel_names().c_str());
    return 2;
  }
  DdsSettings dds;
  dds.domain = options.domain;
  dds.config_file = options.dds_config;
  dds.log = [](std::string_view line) { std::fprintf(stderr, "pelagos-viewer: DDS: %s\n", printable(line).c_str()); };
  LocalClocks clocks;
  clocks.trust_host = options.trust_host;
  if (options.clock_error != 0.0)
    clocks.steady_ns = [error = static_cast<std::int64_t>(1e9 * options.clock_error)] {
      return LocalClocks{}.now().clock_ns + error;
    };
  const std::unique_ptr<FrameSource> source =
      options.synthetic ? make_synthetic_source() : make_dds_source(dds, clocks);
  return options.headless ? run_headless(options, *channel, *source, stop_requested)
                          : run_window(options, *channel, *source, stop_requested);
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = 0;
  try {
    const auto options = pelagos::read_options(argc, argv, exit_code);
    if (!options) return exit_code;
    pelagos::on_stop_signals(request_stop);
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told like a full disk
    return run(*options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pelagos-viewer: %s\n", pelagos::printable_lines(error.what()).c_str());
    return 1;
  }
}
