#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pelagos {

/// A fixed set of worker threads for fork-join loops. Work is cut into blocks that do not depend on the number of
/// threads; blocks are claimed dynamically, so results must depend on the block alone, never on who runs it.
class TaskPool {
 public:
  /// @param threads  total number of threads that work, the caller included; >= 1
  explicit TaskPool(int threads);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  [[nodiscard]] int thread_count() const;

  /// Runs body(block) for block = 0 .. blocks - 1 and returns when all are done. Not re-entrant.
  void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body);

  /// Runs body(begin, end) over [0, count) in blocks of `block_size`.
  template <class F>
  void for_each_range(std::size_t count, std::size_t block_size, F&& body) {
    const std::size_t blocks = (count + block_size - 1) / block_size;
    for_each_block(blocks, [&](std::size_t block) {
      const std::size_t begin = block * block_size;
      const std::size_t end = begin + block_size < count ? begin + block_size : count;
      body(begin, end);
    });
  }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelagos
