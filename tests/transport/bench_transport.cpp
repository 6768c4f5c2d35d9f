// Measures the wire: hand-over, packing and publishing with viewers in processes of their own. Prints numbers, asserts
// nothing.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "child_process.hpp"
#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "loopback.hpp"
#include "packing/particle_codec.hpp"

namespace pelagos {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

std::vector<SurfaceParticle> make_particles(std::size_t count) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::vector<SurfaceParticle> particles(count);
  for (SurfaceParticle& particle : particles) {
    particle.position = {10.0F * unit(generator), 10.0F * unit(generator), unit(generator)};
    particle.orientation = Eigen::Quaternionf(unit(generator), unit(generator), unit(generator), 1.0F).normalized();
    particle.semi_axes = {0.6F, 0.5F, 0.3F + 0.1F * unit(generator)};
    particle.velocity = 3.0F * Eigen::Vector3f(unit(generator), unit(generator), unit(generator));
  }
  return particles;
}

template <class Work>
double best_ms(Work&& work) {
  double best = 1e9;
  for (int i = 0; i < 50; ++i) {
    const auto begin = Clock::now();
    work();
    best = std::min(best, Milliseconds(Clock::now() - begin).count());
  }
  return best;
}

void measure_codec(const std::vector<SurfaceParticle>& particles) {
  std::vector<std::uint8_t> records;
  std::vector<SurfaceParticle> unpacked;
  PackReport report;
  const double pack_ms = best_ms([&] { report = pack_particles(particles, 0.5F, records); });
  const double unpack_ms = best_ms([&] { (void)unpack_particles(records, report.scales, unpacked); });
  std::printf("codec: pack %.3f ms, unpack %.3f ms (best of 50)\n", pack_ms, unpack_ms);
}

/// Frames that a reader's output shows, and its last count of missed ones.
void count_frames(const std::string& text, int& frames, int& missed) {
  for (std::size_t at = text.find("missed "); at != std::string::npos; at = text.find("missed ", at + 1)) {
    ++frames;
    missed = std::atoi(text.c_str() + at + 7);
  }
}

void measure_publisher(const std::vector<SurfaceParticle>& particles, int viewers, int frames, double rate) {
  const auto participant = join_dds(test_settings());
  FramePublisher publisher(participant, test_scene());
  std::vector<std::unique_ptr<ChildProcess>> readers;
  for (int i = 0; i < viewers; ++i) {
    readers.push_back(std::make_unique<ChildProcess>(
        std::vector<std::string>{PELAGOS_TEST_PEER, "viewer", std::to_string(test_settings().domain)}));
  }
  const bool all_there = eventually([&] { return publisher.viewers() == static_cast<std::uint32_t>(viewers); });
  std::printf("viewers: %d%s\n", viewers, all_there ? "" : " (not all have come)");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));

  double copy_ms = 0.0;
  const auto start = Clock::now();
  for (int i = 0; i < frames; ++i) {
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(static_cast<double>(i) / rate)));
    const auto begin = Clock::now();
    auto snapshot = publisher.acquire();
    snapshot->frame = static_cast<std::uint64_t>(i);
    snapshot->particles = particles;
    snapshot->bodies.resize(1);
    copy_ms += Milliseconds(Clock::now() - begin).count();
    publisher.submit(std::move(snapshot));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));

  const PublisherCounters counters = publisher.counters();
  std::printf("hand-over: mean %.1f us, peak %.1f us; filling the snapshot by a copy: mean %.1f us\n",
              counters.handover_us_mean, counters.handover_us_peak, 1000.0 * copy_ms / frames);
  std::printf("publisher thread: mean %.3f ms a frame, peak %.3f ms, of which packing %.3f ms\n",
              counters.frame_ms_mean, counters.frame_ms_peak, counters.pack_ms_mean);
  std::printf(
      "%.2f bytes a particle with header and bodies; submitted %llu, published %llu, dropped %llu, failed %llu\n",
      counters.bytes_per_particle, static_cast<unsigned long long>(counters.submitted),
      static_cast<unsigned long long>(counters.published), static_cast<unsigned long long>(counters.dropped),
      static_cast<unsigned long long>(counters.failed));
  for (const auto& reader : readers) {
    int seen = 0;
    int missed = 0;
    for (;;) {
      const std::string text = reader->read_output(std::chrono::milliseconds(100));
      if (text.empty()) break;
      count_frames(text, seen, missed);
    }
    std::printf("viewer: took %d frames, missed %d\n", seen, missed);
  }
}

}  // namespace
}  // namespace pelagos

int main(int argc, char** argv) {
  CLI::App app{"Measures the wire: hand-over, packing and publishing with viewers in processes of their own.",
               "pelagos-bench-transport"};
  std::size_t count = 10000;
  int viewers = 3, frames = 300;
  double rate = 30.0;
  app.add_option("particles", count, "Of a frame (default: 10000)")->check(pelagos::WholeFrom(1, 1000000));
  app.add_option("viewers", viewers, "Processes that read (default: 3)")->check(pelagos::WholeFrom(0, 32));
  app.add_option("frames", frames, "To send (default: 300)")->check(pelagos::WholeFrom(1, 1000000));
  app.add_option("rate", rate, "Frames a second (default: 30)")->check(pelagos::NumberFrom(0.1, 1000.0));
  if (const auto status = pelagos::parse_command_line(app, argc, argv)) return *status;
  const auto particles = pelagos::make_particles(count);
  std::printf("%zu particles\n", count);
  pelagos::measure_codec(particles);
  pelagos::measure_publisher(particles, viewers, frames, rate);
  return 0;
}
