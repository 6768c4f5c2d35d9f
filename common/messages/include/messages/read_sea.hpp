#pragma once

#include "messages/field_reader.hpp"
#include "waves/wave_system.hpp"

namespace pelagos {

/// The sea in the fields `system`, `components`, `seed` and `shortest_length` of a message, each checked by itself;
/// faults are noted in the reader. That there are systems is for the caller, and what they are together for
/// find_sea_refusal.
[[nodiscard]] SeaSettings read_sea(const FieldReader& reader);

}  // namespace pelagos
