#pragma once

#include <cstdint>
#include <memory>

#include "pelagos_dds/participant.hpp"
#include "values/surface_query.hpp"

namespace pelagos {

/// Takes queries of the surface off `surface_query_v1` on a thread of its own, has them answered by somebody else, and
/// writes the answers to `surface_answer_v1`. A flood costs that thread, not the simulation: of those who are refused
/// twenty a second are told.
class SurfaceLink {
 public:
  /// @param source  of the server, as on its other topics
  /// @param ask     called on the link's thread; `take` may be called on any, also after the link is gone. Clients are
  ///                called "bridge 3". Throws DdsError
  SurfaceLink(std::shared_ptr<DdsParticipant> participant, std::uint64_t source, AskSurface ask, DdsLog log = {});
  ~SurfaceLink();
  SurfaceLink(const SurfaceLink&) = delete;
  SurfaceLink& operator=(const SurfaceLink&) = delete;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
