#pragma once

#include <optional>

#include "messages/field_reader.hpp"
#include "values/wind_change.hpp"

namespace pelagos {

/// Reads a `Wind` message (proto/wind.proto states the ranges); faults are noted in the reader.
[[nodiscard]] WindChange read_wind_change(const FieldReader& reader);
/// The same as a whole wind: what is left out has its default, and the mean must be given.
/// @return the wind; to be used only if no fault was noted
[[nodiscard]] WindSettings read_wind(const FieldReader& reader);

}  // namespace pelagos
