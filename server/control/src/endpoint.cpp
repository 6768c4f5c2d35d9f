#include "control/endpoint.hpp"

#include <charconv>

namespace pelagos {

EndpointResult parse_endpoint(const std::string& text) {
  const auto refuse = [&] {
    return EndpointResult{std::nullopt, "\"" + text +
                                            "\" is no address; allowed: HOST:PORT with a port of 0 to 65535, "
                                            "e.g. 127.0.0.1:7410 or [::1]:7410"};
  };
  Endpoint endpoint;
  std::string host = text;
  std::string port;
  if (!text.empty() && text.front() == '[') {
    const std::size_t end = text.find(']');
    if (end == std::string::npos) return refuse();
    host = text.substr(1, end - 1);
    port = text.substr(end + 1);
    if (host.empty() || (!port.empty() && port.front() != ':')) return refuse();
    if (!port.empty() && port.size() == 1) return refuse();
    if (!port.empty()) port.erase(0, 1);
  } else if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.empty()) return refuse();
  }
  if (host.empty() && port.empty()) return refuse();
  if (host.size() > 255 || host.find_first_of(" \t\r\n/") != std::string::npos) return refuse();
  if (!host.empty()) endpoint.host = host;
  if (!port.empty()) {
    const char* end = port.data() + port.size();
    const auto [stop, error] = std::from_chars(port.data(), end, endpoint.port);
    if (error != std::errc() || stop != end) return refuse();
  }
  return {endpoint, ""};
}

std::string to_string(const Endpoint& endpoint) {
  const bool ipv6 = endpoint.host.find(':') != std::string::npos;
  return (ipv6 ? "[" + endpoint.host + "]" : endpoint.host) + ":" + std::to_string(endpoint.port);
}

}  // namespace pelagos
