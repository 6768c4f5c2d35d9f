#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "booms.hpp"
#include "film.hpp"
#include "oil/slick_element.hpp"

namespace pelagos {

/// Merges elements that cover each other: of each pair, the later into the earlier; an element takes part in one merge
/// a step. The order of the pairs counts, so that the result is the same in every run.
void merge_covering(std::span<const ElementPair> pairs, std::vector<SlickElement>& elements);

/// Merges nearest neighbours, closest (measured in their sizes) first, until at most `most` elements are left. Only
/// where it must, it merges across a boom.
void merge_down_to(std::size_t most, const Barriers& barriers, std::vector<SlickElement>& elements);

/// Splits elements with discs larger than `largest_radius` in four, side by side, of the same film: mass exactly,
/// centre and second moment as before. None whose parts would lie across a boom, none beyond `most` elements.
void split_large(double largest_radius, std::size_t most, const Barriers& barriers,
                 std::vector<SlickElement>& elements);

}  // namespace pelagos
