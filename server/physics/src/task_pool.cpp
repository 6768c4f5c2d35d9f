#include "physics/task_pool.hpp"

#include <hwy/cache_control.h>

#include <atomic>
#include <cassert>
#include <cstdint>
#include <thread>
#include <vector>

namespace pelagos {

namespace {

/// Spinning this long before sleeping bridges the gaps between the loops of one time step.
constexpr int kSpins = 1000;
/// A ticket holds a loop's number (24 bits), the end of a range of its blocks and the next unclaimed one (20 bits
/// each): a worker that wakes late can never claim a block of a loop that it has not seen.
constexpr int kBits = 20;
constexpr std::uint64_t kMask = (1ULL << kBits) - 1;

struct alignas(64) Ticket {
  std::atomic<std::uint64_t> value{0};
};

}  // namespace

struct TaskPool::State {
  explicit State(std::size_t threads) : tickets(threads) {}

  std::vector<Ticket> tickets;  ///< one range of blocks for each thread
  alignas(64) std::atomic<std::size_t> completed{0};
  alignas(64) std::atomic<int> epoch{0};
  std::atomic<bool> stop{false};
  std::uint64_t loop = 0;
  std::size_t blocks = 0;
  const std::function<void(std::size_t)>* body = nullptr;
  std::vector<std::thread> workers;

  /// Claims and runs blocks of one range until none is left. The loop cannot end before a claimed block is done, so
  /// `body` and `blocks` are valid.
  void drain(std::atomic<std::uint64_t>& ticket) {
    for (std::uint64_t t = ticket.load(std::memory_order_acquire);;) {
      const std::uint64_t next = t & kMask, end = (t >> kBits) & kMask;
      if (next >= end) return;
      if (!ticket.compare_exchange_weak(t, t + 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      const std::size_t all = blocks;  // once the block is done, the next loop may be dealt
      (*body)(static_cast<std::size_t>(next));
      if (completed.fetch_add(1, std::memory_order_acq_rel) + 1 == all) completed.notify_one();
      t = ticket.load(std::memory_order_acquire);
    }
  }

  /// A thread works on its own range first, so that the same data stay with the same core from loop to loop, and then
  /// helps the others.
  void run_blocks(std::size_t self) {
    for (std::size_t k = 0; k < tickets.size(); ++k) drain(tickets[(self + k) % tickets.size()].value);
  }

  void work(std::size_t self) {
    for (int seen = 0;;) {
      for (int spin = 0; spin < kSpins && epoch.load(std::memory_order_acquire) == seen; ++spin) hwy::Pause();
      epoch.wait(seen, std::memory_order_acquire);
      seen = epoch.load(std::memory_order_acquire);
      if (stop.load(std::memory_order_acquire)) return;
      run_blocks(self);
    }
  }

  /// Hands out the blocks in equal ranges.
  void deal(std::size_t count) {
    blocks = count;
    completed.store(0, std::memory_order_relaxed);
    ++loop;
    for (std::size_t k = 0; k < tickets.size(); ++k) {
      const std::uint64_t begin = count * k / tickets.size(), end = count * (k + 1) / tickets.size();
      tickets[k].value.store((loop << (2 * kBits)) | (end << kBits) | begin, std::memory_order_release);
    }
  }

  void wake() {
    epoch.fetch_add(1, std::memory_order_acq_rel);
    epoch.notify_all();
  }
};

TaskPool::TaskPool(int threads) : state_(std::make_unique<State>(static_cast<std::size_t>(threads))) {
  assert(threads >= 1);
  for (std::size_t i = 1; i < static_cast<std::size_t>(threads); ++i)
    state_->workers.emplace_back([state = state_.get(), i] { state->work(i); });
}

TaskPool::~TaskPool() {
  state_->stop.store(true, std::memory_order_release);
  state_->wake();
  for (std::thread& worker : state_->workers) worker.join();
}

int TaskPool::thread_count() const { return static_cast<int>(state_->workers.size()) + 1; }

void TaskPool::for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body) {
  assert(blocks <= kMask);
  State& state = *state_;
  if (state.workers.empty() || blocks <= 1) {
    for (std::size_t block = 0; block < blocks; ++block) body(block);
    return;
  }
  state.body = &body;
  state.deal(blocks);
  state.wake();
  state.run_blocks(0);
  // Only blocks that others claimed are waited for: a worker that has not woken yet holds nobody up.
  for (int spin = 0; spin < kSpins && state.completed.load(std::memory_order_acquire) != blocks; ++spin) hwy::Pause();
  for (std::size_t done; (done = state.completed.load(std::memory_order_acquire)) != blocks;)
    state.completed.wait(done, std::memory_order_acquire);
}

}  // namespace pelagos
