#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "film.hpp"
#include "oil/response.hpp"
#include "oil/slick_element.hpp"
#include "oil/slick_state.hpp"

namespace pelagos {

/// Where an element ends that wanted to go from one place to another.
struct HeldMove {
  Eigen::Vector2d position;
  bool held = false;                    ///< a boom stopped it
  std::uint32_t boom = 0, segment = 0;  ///< the one that stopped it, see Barriers::lines()
  double side = 1.0;                    ///< of that segment: +1 left of it, -1 right
};

/// All booms, by name. A boom is placed and taken away without the others; searches look at boxes of booms, of
/// stretches of booms, and then at segments.
class Barriers {
 public:
  struct Segment {
    Eigen::Vector2d begin, along, normal;  ///< along and normal (to the left) are unit vectors
    double length;
  };
  /// A stretch of a boom, or all of it.
  struct Box {
    Eigen::Vector2d min, max;
    std::uint32_t begin, end;  ///< segments
  };
  struct Line {
    std::string name;
    Box box;
    std::vector<Box> stretches;
    std::vector<Segment> segments;
    bool closed;
  };

  /// Places a boom, or puts it in the place of the one of that name.
  void set(const std::string& name, const Boom& boom);
  void remove(const std::string& name);
  void build(const std::map<std::string, BoomState>& booms);
  [[nodiscard]] bool empty() const { return lines_.empty(); }
  [[nodiscard]] std::span<const Line> lines() const { return lines_; }  ///< in the order of their names

  /// Marks the elements whose film may reach a boom; the others are quick to pass. To be called once a step.
  void mark_near(std::span<const SlickElement> elements);

  /// A boom lies between the places of two elements (numbers as marked).
  [[nodiscard]] bool separates(std::uint32_t i, std::uint32_t j, const Eigen::Vector2d& a,
                               const Eigen::Vector2d& b) const {
    return (near_[i] != 0 || near_[j] != 0) && crossed(a, b);
  }
  [[nodiscard]] bool crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  /// The move of an element that stays on its side of every boom and `clearance` away from it; it slides along.
  [[nodiscard]] HeldMove hold(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double clearance) const;

  /// The place lies inside a closed boom.
  [[nodiscard]] bool enclosed(const Eigen::Vector2d& place) const;

 private:
  std::vector<Line> lines_;
  std::vector<std::uint8_t> near_;
};

/// What an element does at a boom in this step.
struct BoomContact {
  std::uint32_t element, boom, segment;
  double side;
  Eigen::Vector2d water_velocity;
};

/// Lets oil at the booms pass under them over dt (see Boom). Leaked oil is pooled at its segment, contained as long as
/// it is there, and surfaces behind the boom as an element when a quarter of a mean element has come together.
void leak_under_booms(const Barriers& barriers, std::span<const BoomContact> contacts, double oil_density,
                      double water_density, double dt, std::vector<SlickElement>& elements,
                      std::map<std::string, BoomState>& booms);

/// Marks the oil that booms hold: what touches one, what is inside a closed one, and what lies behind these without
/// getting on: moved by less than half its free drift and connected to them by overlapping discs.
/// @param stuck  of each element: it got on by less than half its free drift
void mark_contained(const Barriers& barriers, std::span<const BoomContact> contacts,
                    std::span<const ElementPair> touching, std::span<const std::uint8_t> stuck,
                    std::span<SlickElement> elements);

}  // namespace pelagos
