#pragma once

#include "physics/pair_passes.hpp"

namespace pelagos {

/// Sizes the arrays of the gradients for the present lists.
/// @param corrected  whether the corrected gradients of the neighbours are kept, too
void reserve_gradients(const PairData& data, bool corrected, Gradients& gradients);

}  // namespace pelagos
