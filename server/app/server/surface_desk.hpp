#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "simulation/surface_query.hpp"
#include "simulation/world.hpp"
#include "values/surface_query.hpp"
#include "values/token_bucket.hpp"

namespace pelagos {

/// How much of the surface may be asked. A query counts as many places as it has, at least `least_places`.
struct SurfaceDeskLimits {
  double client_per_second = 40'000.0;  ///< places of one client, sustained
  double client_burst = 10'000.0;       ///< places of one client at once
  double all_per_second = 80'000.0;     ///< places of all together, sustained
  double all_burst = 20'000.0;
  double least_places = 100.0;
  std::size_t client_waiting = 4;  ///< queries of one client that wait for their answers
  std::size_t all_waiting = 32;
  std::size_t clients = 64;   ///< that are told from each other; the others share one budget
  double share = 0.05;        ///< of the simulation thread's time that queries may take
  double share_burst = 0.02;  ///< s of it at once
};

/// Answers queries of the surface. They wait here for a step boundary, where the simulation thread copies the sea
/// around and reads the particles at the places in the patch, both of one instant. The desk's own thread does the rest:
/// waves, blend and hand-over. So a query costs the simulation little, and nothing where nobody asks; queries change
/// nothing and are not logged. One way for all queries: those that need no particles wait for the boundary too, a step
/// at most, and all readings of an answer are of the time that it states.
class SurfaceDesk {
 public:
  explicit SurfaceDesk(const SurfaceDeskLimits& limits = {});
  ~SurfaceDesk() { close(); }
  SurfaceDesk(const SurfaceDesk&) = delete;
  SurfaceDesk& operator=(const SurfaceDesk&) = delete;

  /// From any thread; `take` is called on the desk's own. @return why the query is not taken: with a field, a value is
  /// wrong; without, it cannot be answered now
  [[nodiscard]] std::optional<Refusal> ask(const SurfaceQuery& query, const std::string& client, TakeSurface take);

  /// The simulation's thread, between two steps: takes what waits, as far as the share of its time allows.
  void serve(const World& world);

  /// Those who wait are told that there is no answer; nobody is served from now on. Not from two threads at once.
  void close();

  [[nodiscard]] SurfaceQueryCounts counts() const;

 private:
  struct Query {
    SurfaceQuery query;
    std::string client;
    TakeSurface take;
  };
  /// A query with what the simulation thread had for it.
  struct Served {
    Query query;
    std::shared_ptr<const SeaAround> sea;
    std::vector<SurfaceReading> particles;
  };

  [[nodiscard]] std::optional<Refusal> find_no_room(const SurfaceQuery& query, const std::string& client);
  [[nodiscard]] TokenBucket& bucket_of(const std::string& client, TokenBucket::Clock::time_point now);
  [[nodiscard]] std::optional<Query> take_next();
  void run();
  [[nodiscard]] std::vector<Served> wait_for_served();
  void answer(const Served& served);

  const SurfaceDeskLimits limits_;
  TokenBucket purse_;  ///< s; of the simulation's thread
  std::atomic<bool> started_ = false;
  std::atomic<std::size_t> unserved_ = 0;  ///< all that serve() looks at where nobody asks
  std::atomic<std::uint64_t> answered_ = 0, refused_ = 0;

  mutable std::mutex mutex_;  ///< of what follows; held for an instant
  std::condition_variable asked_;
  bool closed_ = false;
  TokenBucket all_;
  std::map<std::string, TokenBucket> buckets_;
  std::map<std::string, std::size_t> waiting_;  ///< queries of each client without an answer
  std::size_t all_waiting_ = 0;
  std::deque<Query> queue_;
  std::vector<Served> served_;

  std::thread thread_;
};

}  // namespace pelagos
