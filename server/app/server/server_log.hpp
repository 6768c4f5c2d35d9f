#pragma once

#include <string_view>

namespace pelagos {

/// Sets up the log: lines with time and level on standard error. Once, before anything logs.
void start_log(std::string_view level);

/// One line each; control characters in it are shown as escapes.
void log_info(std::string_view line);
void log_warning(std::string_view line);
void log_error(std::string_view line);

}  // namespace pelagos
