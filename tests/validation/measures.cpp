#include "measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "physics/kernel.hpp"

namespace pelagos::validation {

namespace {

using Cell = std::pair<int, int>;

Cell cell_of(const Float4& p, double size) {
  return {static_cast<int>(std::floor(static_cast<double>(p.x) / size)),
          static_cast<int>(std::floor(static_cast<double>(p.z) / size))};
}

/// Takes the cells that hang together with `first` out of `cells`.
std::vector<Cell> take_connected(std::set<Cell>& cells, Cell first) {
  std::vector<Cell> found{first};
  cells.erase(first);
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dz = -1; dz <= 1; ++dz) {
        const auto next = cells.find({found[k].first + dx, found[k].second + dz});
        if (next == cells.end()) continue;
        found.push_back(*next);
        cells.erase(next);
      }
  return found;
}

std::span<const Float4> positions_of(const FluidState& state) {
  return {state.particles.position.data(), state.particles.count};
}

double cross(const Float4& o, const Float4& a, const Float4& b) {
  return static_cast<double>(a.x - o.x) * static_cast<double>(b.z - o.z) -
         static_cast<double>(a.z - o.z) * static_cast<double>(b.x - o.x);
}

}  // namespace

void LineFit::add(double x, double y) {
  ++count_;
  x_ += x;
  y_ += y;
  xx_ += x * x;
  xy_ += x * y;
}

double LineFit::slope() const {
  const auto n = static_cast<double>(count_);
  return (n * xy_ - x_ * y_) / (n * xx_ - x_ * x_);
}

double LineFit::at(double x) const {
  const auto n = static_cast<double>(count_);
  return (y_ + slope() * (n * x - x_)) / n;
}

double probe_pressure(const FluidState& state, std::span<const float> pressure, double x, double z, double width) {
  const FluidParameters& q = state.parameters;
  const CubicSpline kernel(q.support_radius);
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < state.particles.count; ++i) {
    const Float4& p = state.particles.position[i];
    const double distance = std::hypot(static_cast<double>(p.x) - x, static_cast<double>(p.z) - z);
    if (distance >= q.support_radius) continue;
    const auto w = static_cast<double>(kernel.value(static_cast<float>(distance)));
    weight += w;
    sum += w * static_cast<double>(pressure[i]);
  }
  // The kernel's integral over a plane: 2 pi sigma R^2 (2/20 - 8/320).
  const double plane = 2.0 * M_PI * static_cast<double>(kernel.sigma) * q.support_radius * q.support_radius * 0.075;
  return weight * q.volume() / width < 0.1 * plane ? 0.0 : sum / weight;
}

double front_position(const FluidState& state) {
  const double d = state.parameters.spacing;
  std::map<Cell, std::pair<int, float>> content;  // particles, largest x
  for (const Float4& p : positions_of(state)) {
    auto& [count, reach] = content.try_emplace(cell_of(p, d), 0, p.x).first->second;
    ++count;
    reach = std::max(reach, p.x);
  }
  std::set<Cell> cells;
  for (const auto& [cell, unused] : content) cells.insert(cells.end(), cell);
  int largest = 0;
  float front = 0.0F;
  while (!cells.empty()) {
    int count = 0;
    float reach = -std::numeric_limits<float>::max();
    for (const Cell& cell : take_connected(cells, *cells.begin())) {
      count += content[cell].first;
      reach = std::max(reach, content[cell].second);
    }
    if (count <= largest) continue;
    largest = count;
    front = reach;
  }
  return static_cast<double>(front) + 0.5 * d;
}

double hull_area(std::span<const Float4> positions) {
  std::vector<Float4> sorted(positions.begin(), positions.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Float4& a, const Float4& b) { return a.x != b.x ? a.x < b.x : a.z < b.z; });
  // Andrew's monotone chain: the lower hull, then the upper one.
  std::vector<Float4> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t begin = hull.size();
    for (const Float4& p : sorted) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  double area = 0.0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Float4 &a = hull[k], &b = hull[(k + 1) % hull.size()];
    area += 0.5 *
            (static_cast<double>(a.x) * static_cast<double>(b.z) - static_cast<double>(b.x) * static_cast<double>(a.z));
  }
  return area;
}

double covered_area(std::span<const Float4> positions, double spacing) {
  constexpr double kCells = 10.0;  // a spacing
  constexpr double kRadius = 7.5;  // in cells
  std::vector<std::uint64_t> covered;
  for (const Float4& p : positions) {
    const double x = static_cast<double>(p.x) / spacing * kCells, z = static_cast<double>(p.z) / spacing * kCells;
    for (int i = static_cast<int>(std::floor(x - kRadius)); i <= static_cast<int>(x + kRadius); ++i)
      for (int k = static_cast<int>(std::floor(z - kRadius)); k <= static_cast<int>(z + kRadius); ++k)
        if (std::hypot(i + 0.5 - x, k + 0.5 - z) <= kRadius)
          covered.push_back(static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32 |
                            static_cast<std::uint32_t>(k));
  }
  std::sort(covered.begin(), covered.end());
  const auto cells = std::unique(covered.begin(), covered.end()) - covered.begin();
  return static_cast<double>(cells) * spacing * spacing / (kCells * kCells);
}

double smallest_distance(const FluidState& state) {
  const std::vector<Float4>& x = state.particles.position;
  float smallest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < state.particles.count; ++i)
    for_each_neighbor(state.fluid_list, i, [&](std::size_t j) {
      if (j == i) return;
      const float dx = x[i].x - x[j].x, dy = x[i].y - x[j].y, dz = x[i].z - x[j].z;
      smallest = std::min(smallest, dx * dx + dy * dy + dz * dz);
    });
  return std::sqrt(static_cast<double>(smallest));
}

double surface_level(const FluidState& state) {
  const double d = state.parameters.spacing;
  std::map<int, float> highest;
  for (const Float4& p : positions_of(state)) {
    float& top = highest.try_emplace(cell_of(p, d).first, p.z).first->second;
    top = std::max(top, p.z);
  }
  double sum = 0.0;
  for (const auto& [column, top] : highest) sum += static_cast<double>(top);
  return sum / static_cast<double>(highest.size()) + 0.5 * d;
}

double mechanical_energy(WaterRun& run) {
  const StepReport report = run.measure();
  return report.kinetic_energy + report.potential_energy;
}

double rms_speed(const FluidParticles& particles) {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.count; ++i) {
    const Float4& v = particles.velocity[i];
    sum += static_cast<double>(v.x * v.x + v.y * v.y + v.z * v.z);
  }
  return std::sqrt(sum / static_cast<double>(particles.count));
}

double Curve::at(double t) const {
  const auto next = std::lower_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return value.front();
  if (next == time.end()) return value.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return value[k - 1] + share * (value[k] - value[k - 1]);
}

double Curve::reaches(double level) const {
  for (std::size_t k = 0; k < value.size(); ++k) {
    if (value[k] < level) continue;
    if (k == 0) return time[0];
    return time[k - 1] + (time[k] - time[k - 1]) * (level - value[k - 1]) / (value[k] - value[k - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::vector<double>> read_columns(const std::string& file, const std::string& series) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file);
  std::vector<std::vector<double>> columns;
  bool names_read = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (!std::exchange(names_read, true)) continue;
    std::stringstream cells(line);
    std::string cell;
    if (!series.empty() && (!std::getline(cells, cell, ',') || cell != series)) continue;
    for (std::size_t k = 0; std::getline(cells, cell, ','); ++k) {
      std::size_t used = 0;
      double value = 0.0;
      try {
        value = std::stod(cell, &used);
      } catch (const std::logic_error&) {
        used = 0;
      }
      if (used == 0 || used != cell.size())
        throw std::runtime_error(file + ':' + std::to_string(number) + ": \"" + cell + "\" is not a number");
      if (columns.size() <= k) columns.resize(k + 1);
      columns[k].push_back(value);
    }
  }
  return columns;
}

}  // namespace pelagos::validation
