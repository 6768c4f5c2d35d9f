#include "surface_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace pelagos {

namespace {

using Time = TokenBucket::Clock;

/// While queries wait for a boundary the desk looks that often for those that have been there. The simulation thread
/// wakes nobody: that could cost it its core.
constexpr std::chrono::milliseconds kPoll{1};

constexpr const char* kStopping = "the server is stopping";

}  // namespace

SurfaceDesk::SurfaceDesk(const SurfaceDeskLimits& limits)
    : limits_(limits), purse_(limits.share, limits.share_burst), all_(limits.all_per_second, limits.all_burst) {
  thread_ = std::thread([this] { run(); });
}

std::optional<Refusal> SurfaceDesk::ask(const SurfaceQuery& query, const std::string& client, TakeSurface take) {
  std::optional<Refusal> refusal = find_fault(query);
  if (!refusal) {
    const std::scoped_lock lock(mutex_);
    refusal = find_no_room(query, client);
    if (!refusal) {
      queue_.push_back({query, client, std::move(take)});
      ++waiting_[client];
      ++all_waiting_;
      ++unserved_;
    }
  }
  if (refusal)
    ++refused_;
  else
    asked_.notify_one();
  return refusal;
}

std::optional<Refusal> SurfaceDesk::find_no_room(const SurfaceQuery& query, const std::string& client) {
  if (closed_) return Refusal{"", kStopping};
  if (!started_.load())
    return Refusal{"", "the server still places and settles its water; ask when Status.starting is false"};
  if (const auto own = waiting_.find(client); own != waiting_.end() && own->second >= limits_.client_waiting)
    return Refusal{
        "", fmt::format("{} queries of {} wait for their answers; allowed: at most so many", own->second, client)};
  if (all_waiting_ >= limits_.all_waiting)
    return Refusal{"", fmt::format("{} queries wait for their answers; allowed: at most so many", all_waiting_)};
  const auto now = Time::now();
  const double cost = std::max(limits_.least_places, static_cast<double>(query.places.size()));
  TokenBucket& own = bucket_of(client, now);
  if (!own.has(now, cost))
    return Refusal{"", fmt::format("too many places are asked; allowed: {:.0f} a second for each client, {:.0f} at "
                                   "once, a query counts at least {:.0f}",
                                   limits_.client_per_second, limits_.client_burst, limits_.least_places)};
  if (!all_.take(now, cost))
    return Refusal{"", fmt::format("too many places are asked by all clients together; allowed: {:.0f} a second",
                                   limits_.all_per_second)};
  own.spend(cost);
  return std::nullopt;
}

TokenBucket& SurfaceDesk::bucket_of(const std::string& client, Time::time_point now) {
  if (buckets_.size() >= limits_.clients && !buckets_.contains(client))
    std::erase_if(buckets_, [now](const auto& entry) { return entry.second.full(now); });
  const bool room = buckets_.size() < limits_.clients || buckets_.contains(client);
  return buckets_.try_emplace(room ? client : std::string(), limits_.client_per_second, limits_.client_burst)
      .first->second;
}

std::optional<SurfaceDesk::Query> SurfaceDesk::take_next() {
  const std::scoped_lock lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  Query query = std::move(queue_.front());
  queue_.pop_front();
  --unserved_;
  return query;
}

void SurfaceDesk::serve(const World& world) {
  started_ = true;
  if (unserved_.load() == 0) return;
  std::shared_ptr<const SeaAround> sea;
  for (auto begin = Time::now(); purse_.has(begin, 0.0);) {
    std::optional<Query> query = take_next();
    if (!query) return;
    if (!sea) sea = std::make_shared<const SeaAround>(world.sea_around());
    Served served{std::move(*query), sea, {}};
    if (served.query.query.ahead == 0.0) served.particles = world.read_particles(served.query.query.places);
    {
      const std::scoped_lock lock(mutex_);
      served_.push_back(std::move(served));
    }
    const auto end = Time::now();
    purse_.spend(std::chrono::duration<double>(end - begin).count());
    begin = end;
  }
}

std::vector<SurfaceDesk::Served> SurfaceDesk::wait_for_served() {
  std::unique_lock lock(mutex_);
  while (!closed_ && served_.empty()) {
    if (all_waiting_ == 0)
      asked_.wait(lock);
    else
      asked_.wait_for(lock, kPoll);
  }
  return std::exchange(served_, {});
}

void SurfaceDesk::run() {
  for (;;) {
    const std::vector<Served> served = wait_for_served();
    if (served.empty()) return;  // closed
    for (const Served& one : served) answer(one);
  }
}

void SurfaceDesk::answer(const Served& served) {
  SurfaceNews news;
  try {
    news.answer = answer_query(*served.sea, served.query.query, served.particles);
  } catch (const std::exception& error) {  // out of memory
    news.refusal = std::string("the server failed at this query: ") + error.what();
  }
  ++(news.refusal.empty() ? answered_ : refused_);
  {
    const std::scoped_lock lock(mutex_);
    --all_waiting_;
    const auto own = waiting_.find(served.query.client);
    if (--own->second == 0) waiting_.erase(own);
  }
  served.query.take(news);
}

void SurfaceDesk::close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  asked_.notify_one();
  if (thread_.joinable()) thread_.join();
  std::deque<Query> left;
  {
    const std::scoped_lock lock(mutex_);
    left = std::exchange(queue_, {});
    unserved_ = 0;
    for (Served& served : served_) left.push_back(std::move(served.query));
    served_.clear();
  }
  for (const Query& query : left) {
    ++refused_;
    query.take({{}, kStopping});
  }
}

SurfaceQueryCounts SurfaceDesk::counts() const { return {answered_, refused_}; }

}  // namespace pelagos
