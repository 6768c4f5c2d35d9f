#pragma once

#include <vector>

#include "messages/field_reader.hpp"
#include "values/wave_settings.hpp"

namespace pelagos {

/// The waves in the field `wave` of a message, each checked by itself; faults are noted in the reader. That there are
/// some is for the caller, and what they are together for find_wave_refusal.
[[nodiscard]] std::vector<WaveSettings> read_waves(const FieldReader& reader);

}  // namespace pelagos
