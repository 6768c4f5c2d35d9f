#pragma once

#include "messages/field_reader.hpp"
#include "values/probe.hpp"

namespace pelagos {

/// A SetProbe message; faults are noted in the reader.
[[nodiscard]] SetProbe read_set_probe(const FieldReader& reader);

}  // namespace pelagos
