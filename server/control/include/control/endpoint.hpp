#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace pelagos {

/// Where the instructors' link is, as written HOST:PORT.
struct Endpoint {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7410;
};

struct EndpointResult {
  std::optional<Endpoint> endpoint;
  std::string error;  ///< what is wrong and what is allowed, if there is no endpoint
};

/// Takes HOST:PORT, HOST (port 7410), :PORT (loopback) and [IPV6]:PORT.
[[nodiscard]] EndpointResult parse_endpoint(const std::string& text);
[[nodiscard]] std::string to_string(const Endpoint& endpoint);

/// In words: who can reach a link that listens at this numeric address, what they can do, and what to do about it.
/// Empty for addresses of loopback.
[[nodiscard]] std::string describe_reach(const std::string& host);

}  // namespace pelagos
