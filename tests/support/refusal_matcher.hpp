#pragma once

#include <gmock/gmock.h>

#include <string>

#include "text/refusal.hpp"

namespace pelagos::test {

/// A refusal whose line, field and what, holds a text.
MATCHER_P(Says, text, "") { return to_string(arg).find(text) != std::string::npos; }

}  // namespace pelagos::test
