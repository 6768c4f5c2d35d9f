#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pelagos {

/// A DDS entity could not be made, or the configuration cannot be used. Thrown at start-up only; the message says what
/// to do about it.
class DdsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Receives one line for people, without a newline. May be called from any thread.
using DdsLog = std::function<void(std::string_view line)>;

/// Which network to join, and how.
struct DdsSettings {
  std::uint32_t domain = 0;  ///< 0..230; above 100 the ports may collide with ephemeral ones
  std::string config_file;   ///< Cyclone DDS XML file; empty: environment CYCLONEDDS_URI, else loopback of this machine
  DdsLog log;                ///< warnings; may be empty
};

/// Cyclone DDS configuration for several processes on one machine: loopback, unicast, up to 41 processes a domain,
/// large fragments.
[[nodiscard]] std::string_view loopback_configuration();

/// The configuration that `settings` and the environment ask for, as dds_create_domain takes it.
/// Throws DdsError if a file is named that cannot be read, or the domain id is out of range.
[[nodiscard]] std::string resolve_configuration(const DdsSettings& settings);

/// Whether `settings` and the environment name no configuration, so that the one for loopback holds.
[[nodiscard]] bool is_built_in(const DdsSettings& settings);

/// Who can send to the sockets of a domain.
struct DdsReach {
  std::vector<std::string> interfaces;  ///< addresses beside loopback that the configuration uses
  bool everywhere = false;              ///< the receiving sockets listen on every address of this machine
  [[nodiscard]] bool beyond_loopback() const { return everywhere || !interfaces.empty(); }
};

/// In words: who can reach a domain, what they can do there, and what to do about it. Empty for loopback.
[[nodiscard]] std::string describe_reach(const DdsReach& reach, const DdsSettings& settings);

/// Socket receive buffer that whole frames need without losses, bytes.
inline constexpr long kWantedReceiveBuffer = 8 * 1024 * 1024;

/// A warning with its remedy if the host's limit on socket receive buffers (net.core.rmem_max) is too small for whole
/// frames; empty if it suffices or cannot be read.
[[nodiscard]] std::optional<std::string> check_receive_buffer(
    const std::string& limit_file = "/proc/sys/net/core/rmem_max");

}  // namespace pelagos
