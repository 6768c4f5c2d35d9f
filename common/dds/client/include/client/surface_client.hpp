#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelagos_dds/configuration.hpp"
#include "text/refusal.hpp"
#include "values/surface_query.hpp"

namespace pelagos {

class DdsParticipant;

/// What a server answered to a query.
struct SurfaceReply {
  std::uint64_t source = 0;  ///< which run of which server: with several in the domain, each one answers
  std::uint64_t number = 0;  ///< of the query
  SurfaceNews news;          ///< with a refusal, there is no answer
};

/// Asks servers for the water's surface over DDS. Places and answers are in ENU. For one thread.
class SurfaceClient {
 public:
  /// @param client  any number that tells this program from others. Throws DdsError
  SurfaceClient(std::shared_ptr<DdsParticipant> participant, std::uint32_t client);
  ~SurfaceClient();
  SurfaceClient(const SurfaceClient&) = delete;
  SurfaceClient& operator=(const SurfaceClient&) = delete;

  /// Why a query was not sent, or under which number it was: 1, 2, 3, ...
  struct Sent {
    std::uint64_t number = 0;
    std::optional<Refusal> refusal;
  };
  [[nodiscard]] Sent ask(const SurfaceQuery& query);

  /// The replies that have come since the last call. A sample with a fault is left out and counted.
  [[nodiscard]] std::vector<SurfaceReply> take();
  /// Waits for the first reply to a query; replies to others are let go. Nothing after `timeout`: no server runs, it
  /// still settles its water, or a packet was lost.
  [[nodiscard]] std::optional<SurfaceReply> wait_for(std::uint64_t number, std::chrono::milliseconds timeout);

  [[nodiscard]] std::uint64_t refused_samples() const;
  /// Servers that would hear a query now.
  [[nodiscard]] std::uint32_t servers() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pelagos
