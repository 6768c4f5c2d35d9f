#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "waves/wave_components.hpp"
#include "waves/wave_moment.hpp"

namespace pelagos {

/// A set of components that replaces all earlier ones: its share grows from 0 at `start` to 1 after `seconds` as
///   s(q) = 6 q^5 - 15 q^4 + 10 q^3 ,
/// whose first and second derivatives vanish at both ends.
struct WaveLayer {
  std::vector<WaveComponent> components;
  double start = 0.0;    ///< s, simulation time
  double seconds = 0.0;  ///< <= 0: at once

  /// 0..1 at a time, s.
  [[nodiscard]] double share_at(double time) const;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("components", self.components);
    visit("start", self.start);
    visit("seconds", self.seconds);
  }
};

/// The waves of an open sea as a sum of linear components, a value that may be copied and asked on any thread. Server
/// and viewer hold the same one. The components carry both wave number and frequency (see wave_number); the field takes
/// them as they are.
///
/// Layers: at any time the share of layer i is s_i (1 - s_{i+1}) (1 - s_{i+2}) ..., so that the shares add up to 1 and
/// height, velocity and acceleration stay continuous, also when a layer comes before the last one is there in full.
class WaveField {
 public:
  /// A flat sea of mean level 0.
  WaveField() = default;
  /// @param level  m, world z of the mean level   @param depth  m, > 0; kInfiniteDepth: deep water
  WaveField(std::vector<WaveComponent> components, double level, double depth = kInfiniteDepth);

  /// @param layers  1 to kMostLayers, in order of their starts. The first one fills what the others leave: it has no
  /// start
  [[nodiscard]] static WaveField of_layers(std::vector<WaveLayer> layers, double level, double depth = kInfiniteDepth);

  /// From `time` on blends into other components over `seconds` (0: at once). Layers that no longer count then are
  /// dropped. @return false, and nothing has changed, where kMostLayers blends still run and this is to be one more
  [[nodiscard]] bool exchange(std::vector<WaveComponent> components, double time, double seconds);

  /// s, simulated: from when on exchange() takes another sea.
  [[nodiscard]] double open_from() const;

  /// All waves at `time`, for places about `anchor` (m, world).
  [[nodiscard]] WaveMoment at(double time, const Eigen::Vector2d& anchor) const;

  /// The sea that the field is, or is blending into.
  [[nodiscard]] std::span<const WaveComponent> components() const { return layers_.back().components; }
  [[nodiscard]] std::span<const WaveLayer> layers() const { return layers_; }  ///< oldest first, never empty
  [[nodiscard]] double level() const { return level_; }
  [[nodiscard]] double depth() const { return depth_; }

  static constexpr std::size_t kMostLayers = 8;
  /// Whether it has layers, and not too many, as all fields have that were not read from bytes.
  [[nodiscard]] bool sound() const { return !layers_.empty() && layers_.size() <= kMostLayers; }

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("layers", self.layers_);
    visit("level", self.level_);
    visit("depth", self.depth_);
  }

 private:
  std::vector<WaveLayer> layers_ = std::vector<WaveLayer>(1);
  double level_ = 0.0, depth_ = kInfiniteDepth;
};

}  // namespace pelagos
