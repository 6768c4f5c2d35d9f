#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "rigid/body_shape.hpp"
#include "rigid/hydrostatics.hpp"
#include "values/scene.hpp"

namespace pelagos {

/// A volume and where it lies.
struct PartVolume {
  double volume = 0.0;                               ///< m^3
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< m^4, body axes: volume times centre
};

/// The room in a body that water reaches over a rim only, or not at all: the hold of an open boat, a tank in a hull.
/// Body axes; the rim is that of the upright body.
///
/// Cells of half a spacing (larger ones in a large body: at most 150,000) fill the box around the body. A cell belongs
/// to the hold if every way to it from outside leads over a higher place (priority flood, Barnes et al. 2014, in three
/// dimensions) and its hollow is at least a spacing deep. Plates thinner than a cell close a way as well: each step is
/// checked against the mesh.
class Hold {
 public:
  Hold() = default;
  /// @param shape    of a closed mesh; must outlive the hold's copies of its surface
  /// @param spacing  of the particles, m
  Hold(const BodyShape& shape, double spacing);

  [[nodiscard]] bool empty() const { return rooms_.empty(); }
  [[nodiscard]] double volume() const { return volume_; }  ///< m^3, up to the rim

  /// The part of it below a plane.
  [[nodiscard]] PartVolume below(const WaterPlane& water) const;

  /// Whether a point that is not in the plating lies in the hold.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const { return is_in(point, kHold); }

  /// Marks as dry what the water at the start does not reach from outside.
  /// @param is_water   whether a point (body axes) is where water starts if nothing keeps it out
  /// @param is_poured  whether it is where the scene puts water into the hold itself
  void dry_out(const std::function<bool(const Eigen::Vector3d&)>& is_water,
               const std::function<bool(const Eigen::Vector3d&)>& is_poured);
  /// Whether a point lies in a part of the hold that starts dry.
  [[nodiscard]] bool is_dry(const Eigen::Vector3d& point) const { return any_dry_ && is_in(point, kDry); }

 private:
  static constexpr std::uint8_t kFree = 1, kHold = 2, kDry = 4, kNear = 8, kReached = 16;

  struct Room {
    Eigen::Vector3f centre;
    float volume;  ///< m^3, of the cell's part that is free
  };
  [[nodiscard]] std::size_t index(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(cell[0]);
  }
  [[nodiscard]] std::array<int, 3> cell_of(std::size_t index) const;
  [[nodiscard]] Eigen::Vector3d centre_of(const std::array<int, 3>& cell) const {
    return first_ + size_ * Eigen::Vector3d(cell[0], cell[1], cell[2]);
  }
  [[nodiscard]] bool is_within(const std::array<int, 3>& cell) const;
  [[nodiscard]] bool is_border(const std::array<int, 3>& cell) const;
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  [[nodiscard]] bool is_in(const Eigen::Vector3d& point, std::uint8_t flag) const;
  /// Calls visit(index, cell) for the free cells beside one that can be reached from it.
  template <class Visit>
  void for_each_way(const std::array<int, 3>& cell, Visit&& visit) const;
  void lay_cells(const BodyShape& shape, double spacing);
  [[nodiscard]] std::vector<float> spill_heights() const;
  void mark_hollows(const std::vector<float>& spill, double least_depth);
  void collect_rooms();

  std::shared_ptr<const MeshQuery> surface_;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();  ///< m, centre of the first cell
  double size_ = 0.0;                                ///< m, of a cell
  std::array<int, 3> count_{};
  std::vector<std::uint8_t> cells_;  ///< flags
  std::vector<float> depth_;         ///< m, from the surface, of cells near it: negative inside; while being made
  std::vector<Room> rooms_;
  double volume_ = 0.0;
  bool any_dry_ = false;
};

}  // namespace pelagos
