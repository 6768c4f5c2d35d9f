#pragma once

#include "messages/field_reader.hpp"
#include "values/current.hpp"

namespace pelagos {

/// Reads a `Current` message (proto/current.proto states the ranges); faults are noted in the reader.
/// @return the current; to be used only if no fault was noted
[[nodiscard]] CurrentSettings read_current(const FieldReader& reader);

}  // namespace pelagos
