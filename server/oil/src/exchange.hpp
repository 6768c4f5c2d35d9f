#pragma once

#include <vector>

#include "oil/slick_element.hpp"
#include "oil/slick_layer.hpp"
#include "oil/slick_settings.hpp"

namespace pelagos {

/// Takes what lies above exchange.thickness out of the elements, in whole particle masses: the surplus of the elements
/// in each square of four particle widths (or of the largest disc's radius) is put together, so that a pile of small
/// elements counts as one.
[[nodiscard]] std::vector<ReturnedOil> take_surplus(const ParticleExchange& exchange, double oil_density,
                                                    std::vector<SlickElement>& elements);

}  // namespace pelagos
