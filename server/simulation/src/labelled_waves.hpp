#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "physics/particles.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

/// A few labels at once (x, y: m from the moment's anchor; z: m above the mean level) and what the theory has there.
struct LabelBatch {
  static constexpr std::size_t kMost = 256;
  std::array<float, kMost> x, y, z, a, b, c;
  std::size_t count = 0;

  void clear() { count = 0; }
  void add(const Float4& label) {
    x[count] = label.x, y[count] = label.y, z[count] = label.z;
    ++count;
  }
  [[nodiscard]] bool full() const { return count == kMost; }
  /// a, b, c: the displacement from the label, m.
  void displace(const WaveMoment& moment);
  /// a, b, c: the velocity, m/s.
  void move(const WaveMoment& moment);
};

}  // namespace pelagos
