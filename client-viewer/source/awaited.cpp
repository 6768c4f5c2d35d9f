#include "source/awaited.hpp"

namespace pelagos {

std::string awaited(FrameSource& source, std::uint32_t domain) {
  if (const auto scene = source.scene_info())
    return "the first frame of scene \"" + scene->scene + "\" (its server has sent none yet)";
  if (const auto status = source.status())
    return "scene \"" + status->scene + "\": its server is starting, it places and settles the water";
  return "a server on DDS domain " + std::to_string(domain);
}

}  // namespace pelagos
