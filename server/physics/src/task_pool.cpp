#include "physics/task_pool.hpp"

#include <atomic>
#include <cassert>
#include <cstdint>
#include <thread>
#include <vector>

namespace pelagos {

namespace {

/// Spinning this long before sleeping bridges the gaps between the loops of one time step.
constexpr int kSpins = 1000;
/// A ticket holds the loop's number (24 bits), its blocks and the next unclaimed block (20 bits each): a worker that
/// wakes late can never claim a block of a loop that it has not seen.
constexpr int kBits = 20;
constexpr std::uint64_t kMask = (1ULL << kBits) - 1;

inline void relax() { __builtin_ia32_pause(); }

}  // namespace

struct TaskPool::State {
  alignas(64) std::atomic<std::uint64_t> ticket{0};
  alignas(64) std::atomic<std::size_t> completed{0};
  alignas(64) std::atomic<int> epoch{0};
  std::atomic<bool> stop{false};
  const std::function<void(std::size_t)>* body = nullptr;
  std::vector<std::thread> workers;

  /// Claims and runs blocks until none is left. The loop cannot end before a claimed block is done, so `body` is valid.
  void run_blocks() {
    for (std::uint64_t t = ticket.load(std::memory_order_acquire);;) {
      const std::uint64_t next = t & kMask, blocks = (t >> kBits) & kMask;
      if (next >= blocks) return;
      if (!ticket.compare_exchange_weak(t, t + 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      (*body)(static_cast<std::size_t>(next));
      if (completed.fetch_add(1, std::memory_order_acq_rel) + 1 == blocks) completed.notify_one();
      t = ticket.load(std::memory_order_acquire);
    }
  }

  void work() {
    for (int seen = 0;;) {
      for (int spin = 0; spin < kSpins && epoch.load(std::memory_order_acquire) == seen; ++spin) relax();
      epoch.wait(seen, std::memory_order_acquire);
      seen = epoch.load(std::memory_order_acquire);
      if (stop.load(std::memory_order_acquire)) return;
      run_blocks();
    }
  }

  void wake() {
    epoch.fetch_add(1, std::memory_order_acq_rel);
    epoch.notify_all();
  }
};

TaskPool::TaskPool(int threads) : state_(std::make_unique<State>()) {
  assert(threads >= 1);
  for (int i = 1; i < threads; ++i) state_->workers.emplace_back([state = state_.get()] { state->work(); });
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
  state.completed.store(0, std::memory_order_relaxed);
  const std::uint64_t loop = (state.ticket.load(std::memory_order_relaxed) >> (2 * kBits)) + 1;
  state.ticket.store((loop << (2 * kBits)) | (static_cast<std::uint64_t>(blocks) << kBits), std::memory_order_release);
  state.wake();
  state.run_blocks();
  // Only blocks that others claimed are waited for: a worker that has not woken yet holds nobody up.
  for (int spin = 0; spin < kSpins && state.completed.load(std::memory_order_acquire) != blocks; ++spin) relax();
  for (std::size_t done; (done = state.completed.load(std::memory_order_acquire)) != blocks;)
    state.completed.wait(done, std::memory_order_acquire);
}

}  // namespace pelagos
