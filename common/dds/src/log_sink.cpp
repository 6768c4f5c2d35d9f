#include "pelagos_dds/log_sink.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>

#include <memory>
#include <utility>

#include "dds_messages.hpp"
#include "text/printable.hpp"

namespace pelagos {

RateLimitedLog::RateLimitedLog(DdsLog log, int burst, std::chrono::steady_clock::duration window)
    : log_(std::move(log)), burst_(burst), window_(window) {}

void RateLimitedLog::write(std::string_view line) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (written_ == 0 || now - window_start_ >= window_) {
    if (held_back_ > 0 && log_) log_(std::to_string(held_back_) + " similar messages held back");
    held_back_ = 0;
    written_ = 0;
    window_start_ = now;
  }
  if (written_ >= burst_) {
    ++held_back_;
    ++suppressed_;
    return;
  }
  ++written_;
  if (log_) log_(line);
}

std::uint64_t RateLimitedLog::suppressed() const {
  const std::lock_guard lock(mutex_);
  return suppressed_;
}

namespace {

// The library has one sink for the whole process; so there is one place that holds what it calls.
struct Sink {
  std::mutex mutex;
  std::shared_ptr<RateLimitedLog> log;
  std::string* collected = nullptr;
};

Sink& process_sink() {
  static Sink sink;
  return sink;
}

// Called on threads of the library: nothing may be thrown out of here.
void receive_message(void*, const dds_log_data_t* data) {
  try {
    std::string_view line(data->message, data->size);
    while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.remove_suffix(1);
    Sink& sink = process_sink();
    std::shared_ptr<RateLimitedLog> log;
    {
      const std::lock_guard lock(sink.mutex);
      if (sink.collected != nullptr) {
        if (!sink.collected->empty()) sink.collected->append("; ");
        sink.collected->append(printable(line));
        return;
      }
      log = sink.log;
    }
    if (log) log->write("DDS: " + printable(line));
  } catch (...) {  // out of memory while logging: drop the line
  }
}

// Without a log of ours the library's own sink, which writes to stderr, stays in place.
void update_registration(const Sink& sink) {
  dds_set_log_sink(sink.log || sink.collected != nullptr ? receive_message : nullptr, nullptr);
}

}  // namespace

void install_dds_log(DdsLog log) {
  Sink& sink = process_sink();
  {
    const std::lock_guard lock(sink.mutex);
    sink.log = log ? std::make_shared<RateLimitedLog>(std::move(log)) : nullptr;
  }
  update_registration(sink);
}

MessageCollector::MessageCollector() {
  Sink& sink = process_sink();
  {
    const std::lock_guard lock(sink.mutex);
    sink.collected = &messages_;
  }
  update_registration(sink);
}

MessageCollector::~MessageCollector() {
  Sink& sink = process_sink();
  {
    const std::lock_guard lock(sink.mutex);
    sink.collected = nullptr;
  }
  update_registration(sink);
}

}  // namespace pelagos
