#include "oil/slick_frame.hpp"

namespace pelagos {

OilAppearance appearance(double thickness) {
  if (!(thickness >= 0.04e-6)) return OilAppearance::kNone;
  if (thickness < 0.3e-6) return OilAppearance::kSheen;
  if (thickness < 5e-6) return OilAppearance::kRainbow;
  if (thickness < 50e-6) return OilAppearance::kMetallic;
  if (thickness <= 200e-6) return OilAppearance::kDiscontinuousTrue;
  return OilAppearance::kContinuousTrue;
}

SlickFrame make_frame(std::span<const SlickElement> elements) {
  SlickFrame frame;
  frame.discs.reserve(elements.size());
  for (const SlickElement& e : elements)
    frame.discs.push_back({static_cast<float>(e.position.x()), static_cast<float>(e.position.y()),
                           static_cast<float>(e.height), static_cast<float>(disc_radius(e)), static_cast<float>(e.film),
                           static_cast<float>(to_kilograms(e.mass)), static_cast<float>(e.water), appearance(e.film),
                           e.contained});
  return frame;
}

}  // namespace pelagos
