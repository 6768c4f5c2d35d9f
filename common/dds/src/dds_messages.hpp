#pragma once

#include <string>

namespace pelagos {

/// While it lives, messages of the DDS library are collected instead of written, so that an error can carry them.
/// One at a time (the caller holds the lock of the domain table).
class MessageCollector {
 public:
  MessageCollector();
  ~MessageCollector();
  MessageCollector(const MessageCollector&) = delete;
  MessageCollector& operator=(const MessageCollector&) = delete;

  /// Valid once no DDS call is running.
  [[nodiscard]] const std::string& messages() const { return messages_; }

 private:
  std::string messages_;
};

}  // namespace pelagos
