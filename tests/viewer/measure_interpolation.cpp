// Not a test: prints how far the particles of a running server are off their way between two frames, by each way of
// drawing them there. The server's frames are to come four times as often as those that are drawn between:
//   measure_interpolation DOMAIN SECONDS
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "client/frame_receiver.hpp"

namespace {

using namespace pelagos;

/// Particles of a frame by cells, to find the one at a place.
class Places {
 public:
  Places(const OceanFrame& frame, double cell) : frame_(frame), cell_(cell) {
    for (std::size_t i = 0; i < frame.particles.size(); ++i) cells_[key(world(i))].push_back(i);
  }
  [[nodiscard]] Eigen::Vector3d world(std::size_t i) const {
    return frame_.origin + frame_.particles[i].position.cast<double>();
  }
  /// The nearest particle, if no other is within twice its distance and it is within half a cell.
  [[nodiscard]] std::optional<std::size_t> at(const Eigen::Vector3d& place) const {
    double best = 1e9, second = 1e9;
    std::size_t found = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto cell = cells_.find(key(place + cell_ * Eigen::Vector3d(x, y, z)));
          if (cell == cells_.end()) continue;
          for (const std::size_t i : cell->second) {
            const double distance = (world(i) - place).norm();
            if (distance < best) {
              second = std::exchange(best, distance);
              found = i;
            } else {
              second = std::min(second, distance);
            }
          }
        }
    return best < 0.5 * cell_ && best < 0.5 * second ? std::optional(found) : std::nullopt;
  }

 private:
  [[nodiscard]] std::uint64_t key(const Eigen::Vector3d& p) const {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21 |
            (static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(p[axis] / cell_)) + (1 << 20)) & 0x1FFFFF);
    return key;
  }
  const OceanFrame& frame_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

struct Errors {
  std::vector<double> m;
  void print(const char* what) {
    if (m.empty()) return;
    std::sort(m.begin(), m.end());
    const auto at = [&](double part) {
      return 1e3 * m[static_cast<std::size_t>(part * static_cast<double>(m.size() - 1))];
    };
    std::printf("%-44s median %7.2f mm   99 %% %7.2f mm   most %8.2f mm   of %zu\n", what, at(0.5), at(0.99), at(1.0),
                m.size());
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  FrameReceiver receiver({static_cast<std::uint32_t>(std::atoi(argv[1])), "", {}});
  std::deque<std::unique_ptr<OceanFrame>> frames;
  Errors nearer, line, old;
  std::size_t lost = 0, all = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[2]));
  while (std::chrono::steady_clock::now() < end) {
    auto frame = receiver.take_next();
    if (!frame) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      continue;
    }
    if (!frames.empty() && frame->frame != frames.back()->frame + 1) frames.clear();
    frames.push_back(std::move(frame));
    if (frames.size() < 11) continue;
    // 0: a frame 50 ms older than 6; 6 and 10: those around; 8, 9: between.
    const double cell = receiver.scene_info() ? receiver.scene_info()->particle_spacing : 0.5;
    const OceanFrame &from = *frames[6], &to = *frames[10], &earlier = *frames[0];
    const double interval = to.simulation_time - from.simulation_time;
    const Places middle(*frames[8], cell), later(to, cell);
    for (std::size_t i = 0; i < from.particles.size(); i += 7) {
      const Eigen::Vector3d place = from.origin + from.particles[i].position.cast<double>(),
                            v = from.particles[i].velocity.cast<double>();
      const Eigen::Vector3d forward = place + 0.5 * interval * v;
      ++all;
      const auto truth = middle.at(forward);
      const auto other = later.at(place + interval * v);
      if (!truth || !other) {
        ++lost;
        continue;
      }
      nearer.m.push_back((forward - middle.world(*truth)).norm());
      line.m.push_back((0.5 * (place + later.world(*other)) - middle.world(*truth)).norm());
    }
    for (std::size_t i = 0; i < earlier.particles.size(); i += 7) {
      const double ahead = frames[8]->simulation_time - earlier.simulation_time;
      const Eigen::Vector3d place = earlier.origin + earlier.particles[i].position.cast<double>() +
                                    ahead * earlier.particles[i].velocity.cast<double>();
      if (const auto truth = middle.at(place)) old.m.push_back((place - middle.world(*truth)).norm());
    }
    for (int i = 0; i < 8; ++i) frames.pop_front();
  }
  nearer.print("nearer frame by velocity, half an interval");
  line.print("line between both frames (identities)");
  old.print("extrapolated from a frame 67 ms old");
  std::printf("without a match: %zu of %zu\n", lost, all);
  return 0;
}
