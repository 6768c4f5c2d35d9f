#include "oil/slick_oil.hpp"

#include <cstddef>

namespace pelagos {

namespace {

constexpr std::array<SlickOil, kOilKinds.size()> kTable{{
    {"gasoline", 731.53, 1.0695e-6, 61.8, true, 0.0},
    {"diesel", 852.98, 6.4383e-6, 34.3, true, 0.0},
    {"light crude", 827.99, 8.3788e-6, 39.2, false, 0.70},
    {"medium crude", 879.13, 40.449e-6, 29.3, false, 0.70},
    {"heavy crude", 963.57, 6148.9e-6, 15.2, false, 0.70},
    {"IFO 180", 967.0, 2.32 / 967.0, 14.7, true, 0.52},
    {"heavy fuel oil", 983.0, 45.0 / 983.0, 12.3, true, 0.52},
    {"bunker C", 989.0, 8.71 / 989.0, 11.4, true, 0.52},
}};

}  // namespace

const SlickOil& slick_oil(OilKind kind) { return kTable[static_cast<std::size_t>(kind)]; }

std::optional<OilKind> find_oil_kind(std::string_view name) {
  for (const OilKind kind : kOilKinds)
    if (slick_oil(kind).name == name) return kind;
  return {};
}

}  // namespace pelagos
