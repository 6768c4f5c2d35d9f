#include "server_log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <string>

#include "text/printable.hpp"

namespace pelagos {

void start_log(std::string_view level) {
  const auto logger = spdlog::stderr_color_mt("pelagos");
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
  logger->set_level(spdlog::level::from_str(std::string(level)));
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

namespace {

/// One line, whatever a station or a DDS peer has put into it.
std::string one_line(std::string_view line) { return printable(line, 8192); }

}  // namespace

void log_info(std::string_view line) { spdlog::info("{}", one_line(line)); }
void log_warning(std::string_view line) { spdlog::warn("{}", one_line(line)); }
void log_error(std::string_view line) { spdlog::error("{}", one_line(line)); }

}  // namespace pelagos
