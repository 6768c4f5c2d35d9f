#include "physics/task_pool.hpp"

#include <atomic>
#include <cassert>
#include <thread>
#include <vector>

namespace pelagos {

namespace {

/// Spinning this long before sleeping bridges the gaps between the loops of one time step.
constexpr int kSpins = 2000;

inline void relax() { __builtin_ia32_pause(); }

}  // namespace

struct TaskPool::State {
  std::atomic<std::uint64_t> generation{0};
  std::atomic<std::size_t> next_block{0};
  std::atomic<int> busy{0};
  std::atomic<bool> stop{false};
  std::size_t blocks = 0;
  const std::function<void(std::size_t)>* body = nullptr;
  std::vector<std::thread> workers;

  void run_blocks() {
    for (std::size_t block; (block = next_block.fetch_add(1, std::memory_order_relaxed)) < blocks;) (*body)(block);
  }

  void work() {
    std::uint64_t seen = 0;
    for (;;) {
      for (int spin = 0; spin < kSpins && generation.load(std::memory_order_acquire) == seen; ++spin) relax();
      generation.wait(seen, std::memory_order_acquire);
      seen = generation.load(std::memory_order_acquire);
      if (stop.load(std::memory_order_acquire)) return;
      run_blocks();
      if (busy.fetch_sub(1, std::memory_order_acq_rel) == 1) busy.notify_one();
    }
  }
};

TaskPool::TaskPool(int threads) : state_(std::make_unique<State>()) {
  assert(threads >= 1);
  for (int i = 1; i < threads; ++i) state_->workers.emplace_back([state = state_.get()] { state->work(); });
}

TaskPool::~TaskPool() {
  state_->stop.store(true, std::memory_order_release);
  state_->generation.fetch_add(1, std::memory_order_acq_rel);
  state_->generation.notify_all();
  for (std::thread& worker : state_->workers) worker.join();
}

int TaskPool::thread_count() const { return static_cast<int>(state_->workers.size()) + 1; }

void TaskPool::for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body) {
  if (blocks == 0) return;
  State& state = *state_;
  if (state.workers.empty() || blocks == 1) {
    for (std::size_t block = 0; block < blocks; ++block) body(block);
    return;
  }
  state.blocks = blocks;
  state.body = &body;
  state.next_block.store(0, std::memory_order_relaxed);
  state.busy.store(static_cast<int>(state.workers.size()), std::memory_order_relaxed);
  state.generation.fetch_add(1, std::memory_order_acq_rel);
  state.generation.notify_all();
  state.run_blocks();
  for (int spin = 0; spin < kSpins && state.busy.load(std::memory_order_acquire) != 0; ++spin) relax();
  for (int left; (left = state.busy.load(std::memory_order_acquire)) != 0;)
    state.busy.wait(left, std::memory_order_acquire);
}

}  // namespace pelagos
