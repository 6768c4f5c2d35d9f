// What a sort by cell costs on one thread and on two, cut into more and more chunks: time_sort

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <vector>

#include "physics/grid.hpp"
#include "waves/splitmix.hpp"

namespace {

using namespace pelagos;

constexpr int kRounds = 30;

/// A lattice of `side` x `side` x `side` / 8 points at a spacing of 1 m, each moved by up to half of that.
std::vector<Float4> make_sea(int side) {
  SplitMix64 random(1);
  const auto near = [&](int at) { return static_cast<float>(at) + static_cast<float>(random.next_unit()) - 0.5F; };
  std::vector<Float4> points;
  for (int z = 0; z < side / 8; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) points.push_back({near(x), near(y), near(z), 0.0F});
  return points;
}

void shuffle(std::vector<Float4>& points) {
  SplitMix64 random(2);
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[static_cast<std::size_t>(random.next_unit() * static_cast<double>(i))]);
}

/// In the order of the cells where each point was a tenth of a spacing ago: as a time step leaves them.
void sort_as_a_step_ago(CellGrid& grid, TaskPool& pool, std::vector<Float4>& points) {
  SplitMix64 random(3);
  std::vector<std::uint32_t> order;
  grid.sort(pool, points, order);
  std::vector<Float4> sorted(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    sorted[k] = points[order[k]];
    sorted[k].x += static_cast<float>(0.2 * random.next_unit() - 0.1);
    sorted[k].z += static_cast<float>(0.2 * random.next_unit() - 0.1);
  }
  points = sorted;
}

/// Shortest and middle of some rounds, ms.
struct Times {
  double shortest, middle;
};
Times measure(CellGrid& grid, TaskPool& pool, const std::vector<Float4>& points, std::size_t chunks) {
  std::vector<double> times;
  std::vector<std::uint32_t> order;
  for (int round = 0; round < kRounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    grid.sort(pool, points, order, chunks);
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(times.begin(), times.end());
  return {times.front(), times[times.size() / 2]};
}

}  // namespace

int main() {
  std::printf("ms a sort, the shortest and the middle one of %d\n", kRounds);
  std::printf("points  order  threads  chunks  shortest  middle\n");
  for (const int side : {64, 128, 192}) {
    const auto size = static_cast<float>(side);
    CellGrid grid({{-2.0F, -2.0F, -2.0F}, {size + 2.0F, size + 2.0F, size / 4.0F + 2.0F}}, 2.0);
    for (const char* order : {"step", "none"})
      for (const int threads : {1, 2}) {
        TaskPool pool(threads);
        std::vector<Float4> points = make_sea(side);
        if (order[0] == 's')
          sort_as_a_step_ago(grid, pool, points);
        else
          shuffle(points);
        for (const std::size_t chunks : {1U, 2U, 4U, 8U, 16U}) {
          const Times times = measure(grid, pool, points, chunks);
          std::printf("%7zu  %s  %d  %2zu  %7.3f  %7.3f\n", points.size(), order, threads, chunks, times.shortest,
                      times.middle);
        }
      }
  }
}
