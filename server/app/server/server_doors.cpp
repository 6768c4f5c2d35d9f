// Who can reach the server.

#include <fmt/format.h>

#include "control/endpoint.hpp"
#include "server.hpp"
#include "server_log.hpp"

namespace pelagos {

std::vector<OpenLink> Server::find_open_links(const DdsParticipant& participant, const DdsSettings& dds) const {
  std::vector<OpenLink> open;
  const std::string control = describe_reach(options_.control.host);
  if (!control.empty())
    open.push_back({"control " + to_string(Endpoint{options_.control.host, control_->port()}), control});
  const std::string network = describe_reach(reach_of(participant), dds);
  if (!network.empty()) open.push_back({fmt::format("DDS domain {}", options_.domain), network});
  for (const OpenLink& link : open) log_warning(link.link + " is open: " + link.reach);
  return open;
}

}  // namespace pelagos
