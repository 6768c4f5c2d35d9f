#include "pelagos_dds/configuration.hpp"

#include <cstdlib>
#include <fstream>

namespace pelagos {

std::string_view loopback_configuration() {
  return R"(<CycloneDDS><Domain Id="any">
 <General>
  <Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces><AllowMulticast>false</AllowMulticast>
  <MaxMessageSize>65500B</MaxMessageSize><FragmentSize>60000B</FragmentSize>
 </General>
 <Discovery>
  <ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>40</MaxAutoParticipantIndex>
  <Peers><Peer Address="127.0.0.1"/></Peers>
 </Discovery>
 <Internal><SocketReceiveBufferSize min="default" max="8MB"/></Internal>
</Domain></CycloneDDS>)";
}

std::string resolve_configuration(const DdsSettings& settings) {
  constexpr std::uint32_t kLargestDomain = 230;  // the ports of 231 and above exceed 65535
  if (settings.domain > kLargestDomain) {
    throw DdsError("domain " + std::to_string(settings.domain) + " is out of range; allowed: 0 to 230");
  }
  if (!settings.config_file.empty()) {
    std::ifstream file(settings.config_file);
    if (!file || file.peek() == std::ifstream::traits_type::eof()) {
      throw DdsError("cannot read the DDS configuration file '" + settings.config_file + "', or it is empty");
    }
    return "file://" + settings.config_file;
  }
  if (const char* uri = std::getenv("CYCLONEDDS_URI"); uri != nullptr && *uri != '\0') return uri;
  return std::string(loopback_configuration());
}

bool is_built_in(const DdsSettings& settings) {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return settings.config_file.empty() && (uri == nullptr || *uri == '\0');
}

std::string describe_reach(const DdsReach& reach, const DdsSettings& settings) {
  if (!reach.beyond_loopback()) return {};
  std::string addresses;
  for (const std::string& address : reach.interfaces) addresses += (addresses.empty() ? "" : ", ") + address;
  if (reach.everywhere)
    addresses += addresses.empty() ? "any address of this one" : ", or any other address of this one,";
  std::string advice = ". Keep that network inside the simulator (docs/wire.md)";
  if (!is_built_in(settings)) {
    const std::string origin =
        settings.config_file.empty() ? "CYCLONEDDS_URI names one" : "--dds-config " + settings.config_file;
    advice += "; without a DDS configuration (" + origin + ") only this machine can reach it";
  }
  return "every machine that reaches " + addresses +
         " can send poses and requests for probes, and frames in this server's name; no password protects it unless "
         "that configuration sets up DDS Security" +
         advice;
}

std::optional<std::string> check_receive_buffer(const std::string& limit_file) {
  std::ifstream file(limit_file);
  long limit = 0;
  if (!(file >> limit) || limit >= kWantedReceiveBuffer) return std::nullopt;
  return "net.core.rmem_max is " + std::to_string(limit) + " bytes; whole frames may be lost below " +
         std::to_string(kWantedReceiveBuffer) +
         ". As root: sysctl -w net.core.rmem_max=8388608 (to keep it: /etc/sysctl.d/60-pelagos.conf)";
}

}  // namespace pelagos
