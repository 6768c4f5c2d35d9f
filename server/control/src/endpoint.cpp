#include "control/endpoint.hpp"

#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>

#include <boost/asio/ip/address.hpp>
#include <charconv>

namespace pelagos {
namespace {

namespace ip = boost::asio::ip;

/// An IPv4 address that is written as one of IPv6 (::ffff:127.0.0.1) is the IPv4 address.
ip::address plain(const ip::address& address) {
  if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address;
  return ip::make_address_v4(ip::v4_mapped, address.to_v6());
}

/// The machine's own addresses beside loopback that a link at 0.0.0.0 or :: can be reached by.
std::string own_addresses(bool v6_too) {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return {};
  std::string text;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || (entry->ifa_flags & IFF_LOOPBACK) != 0) continue;
    const bool v4 = entry->ifa_addr->sa_family == AF_INET;
    if (!v4 && !(v6_too && entry->ifa_addr->sa_family == AF_INET6)) continue;
    char host[NI_MAXHOST] = {};
    const socklen_t size = v4 ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    if (::getnameinfo(entry->ifa_addr, size, host, sizeof host, nullptr, 0, NI_NUMERICHOST) != 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(host);
  }
  ::freeifaddrs(first);
  return text;
}

}  // namespace

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

std::string describe_reach(const std::string& host) {
  boost::system::error_code error;
  const ip::address address = plain(ip::make_address(host == "localhost" ? "127.0.0.1" : host, error));
  if (error || address.is_loopback()) return {};
  const std::string own = address.is_unspecified() ? own_addresses(address.is_v6()) : host;
  std::string text = "every machine that reaches " + (own.empty() ? "any address of this one" : own);
  if (address.is_unspecified() && !own.empty()) text += " (all addresses of this one)";
  return text +
         " can pause the sea and command wind, current and oil; no password protects it. Keep that network inside the "
         "simulator, or use --control 127.0.0.1:PORT, which only this machine can reach";
}

}  // namespace pelagos
