#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "rigid/sea_panels.hpp"
#include "values/body.hpp"
#include "values/current.hpp"
#include "waves/wave_field.hpp"

namespace pelagos {

// The undisturbed sea at the hull of a body: what carries bodies where there are no particles.
//
// The theory is that of the open edges (open_sea.hpp): water that rests at the label (X, Z) is at X + D(X, Z, t), and
// labels Z = const are isobars. So the head of the water at a place x is -Z(x), static and dynamic pressure together;
// X is found from x by repeated substitution. A triangle is cut where the head is zero, and over what is wet the head
// is linear between its corners:
//   F = -rho g int head n dA ,  M = -rho g int head (r x n) dA          (Froude-Krylov force and moment)

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The sea around a patch, at one instant.
struct CarryingSea {
  const WaveField* waves = nullptr;  ///< never null
  const Current* current = nullptr;  ///< null: none runs
  double time = 0.0;                 ///< s
  double density = 0.0;              ///< kg/m^3
  double gravity = 0.0;              ///< m/s^2
};

/// How much a place (m, world, horizontal) counts, 0..1.
using PlaceShare = std::function<double(const Eigen::Vector2d&)>;

/// World axes, moments about the reference point; forces along x, y, z, then moments about them. All of it counts with
/// the share of its place.
struct SeaLoad {
  Vector6d force = Vector6d::Zero();  ///< N, N m, Froude-Krylov
  double wetted = 0.0;                ///< m^2, of the hull
  /// The rigid motion nearest to the water's at the wetted hull, at the reference point; its turn is that of the
  /// slopes of the vertical velocity. m/s, rad/s; m/s^2, rad/s^2.
  Vector6d water = Vector6d::Zero(), water_rate = Vector6d::Zero();
  double waterplane = 0.0;                     ///< m^2
  std::array<double, 2> waterplane_moments{};  ///< m^4, about the body's x and y through the point
  Vector6d drag = Vector6d::Zero();            ///< N, N m, quadratic, of the relative motion
  Matrix6d drag_rate = Matrix6d::Zero();       ///< by which it falls as the body is faster
};

/// Works out loads; keeps its arrays.
class SeaLoader {
 public:
  /// @param panels  body axes    @param state  of the body's origin    @param about  m, world: the reference point
  [[nodiscard]] SeaLoad load(const SeaPanels& panels, const BodyState& state, const Eigen::Vector3d& about,
                             const CarryingSea& sea, const PlaceShare& share);

  /// Of drag on a panel that moves along its normal. A plate across the flow has two sides: 1.0 in all (Hoerner 1965
  /// has 1.0 to 1.2 for plates and boxes).
  static constexpr double kDragOfSide = 0.5;
  /// Substitutions for the label; waves shorter than so many panel edges are left out.
  static constexpr int kSubstitutions = 6;
  static constexpr double kShortestWave = 4.0;

 private:
  struct Corner {
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< m, from the reference point
    double head = 0.0, share = 0.0;                 ///< m, 0..1
  };
  /// What of a panel is under water: nothing, a triangle or a quadrangle; the water's motion at the panel.
  struct WetPanel {
    std::array<Corner, 4> corner;
    std::size_t count = 0;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
  };
  struct WetPart {
    double area;  ///< m^2, by its share
    Eigen::Vector3d arm, velocity, acceleration;
  };
  /// Of the reference point.
  struct HullMotion {
    Eigen::Matrix3d turn;  ///< body to world
    Eigen::Vector3d velocity, angular_velocity;
  };
  void find_water(const SeaPanels& panels, const BodyState& state, const CarryingSea& sea);
  [[nodiscard]] WetPanel wet_part(const std::array<std::uint32_t, 3>& triangle, const Eigen::Vector3d& about) const;
  void add_panel(const WetPanel& panel, const HullMotion& hull, const CarryingSea& sea, SeaLoad& load);
  static void add_drag(const WetPart& part, const Eigen::Vector3d& normal, const HullMotion& hull, double density,
                       SeaLoad& load);
  void fit_water(SeaLoad& load) const;

  std::vector<Eigen::Vector3d> place_;  ///< m, world
  std::vector<float> x_, y_, z_, a_, b_, c_, px_, py_, pz_, ax_, ay_, az_, pressure_;
  std::vector<double> head_, share_;
  std::vector<Eigen::Vector3d> velocity_, acceleration_;
  std::vector<WetPart> wet_;
};

}  // namespace pelagos
