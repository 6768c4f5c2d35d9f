#include "pelagos_dds/receiver_thread.hpp"

#include <exception>
#include <utility>

namespace pelagos {

ReceiverThread::ReceiverThread(const DdsParticipant& participant, std::string what, RateLimitedLog& log, Pace pace)
    : what_(std::move(what)), log_(&log), pace_(pace), waitset_(participant) {}

ReceiverThread::~ReceiverThread() {
  if (!thread_.joinable()) return;
  stop_ = true;
  waitset_.wake();
  thread_.join();
}

void ReceiverThread::start(std::function<void()> round) {
  thread_ = std::thread([this, round = std::move(round)] { run(round); });
}

void ReceiverThread::run(const std::function<void()>& round) {
  while (!stop_) {
    waitset_.wait(pace_.poll);
    try {
      round();
    } catch (const std::exception& error) {
      log_->write("receiving " + what_ + " failed: " + error.what());
    }
    if (pace_.rest.count() > 0) std::this_thread::sleep_for(pace_.rest);
  }
}

}  // namespace pelagos
