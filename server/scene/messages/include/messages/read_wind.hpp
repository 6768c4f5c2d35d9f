#pragma once

#include <optional>

#include "messages/field_reader.hpp"
#include "values/wind.hpp"

namespace pelagos {

/// Reads a `Wind` message (proto/wind.proto states the ranges); faults are noted in the reader.
/// @param present  the wind whose values fields that are left out keep, direction included; nullopt: defaults, and the
///                 mean must be given in full
/// @return the wind; to be used only if no fault was noted
[[nodiscard]] WindSettings read_wind(const FieldReader& reader, const std::optional<WindSettings>& present);

}  // namespace pelagos
