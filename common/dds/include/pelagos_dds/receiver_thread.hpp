#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "pelagos_dds/entities.hpp"
#include "pelagos_dds/log_sink.hpp"

namespace pelagos {

/// A thread that waits for samples on readers and takes them, until it is destroyed. The last member of what owns it:
/// the readers and all that a round touches must outlive it.
class ReceiverThread {
 public:
  struct Pace {
    std::chrono::milliseconds poll{500};  ///< a round is made so often where nothing comes
    std::chrono::milliseconds rest{0};    ///< between two rounds, so that a flood is taken in batches
  };

  /// @param what  is received, for the log: "poses"   @param log  must outlive the thread
  ReceiverThread(const DdsParticipant& participant, std::string what, RateLimitedLog& log, Pace pace);
  ~ReceiverThread();
  ReceiverThread(const ReceiverThread&) = delete;
  ReceiverThread& operator=(const ReceiverThread&) = delete;

  /// Before the start, or out of a round.
  void attach(const DdsReader& reader) { waitset_.attach(reader); }
  /// From now on the thread calls `round` after each arrival. An exception out of it, as when memory runs out, is
  /// logged: what that round would have taken is lost.
  void start(std::function<void()> round);

 private:
  void run(const std::function<void()>& round);

  std::string what_;
  RateLimitedLog* log_;
  Pace pace_;
  DdsWaitSet waitset_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace pelagos
