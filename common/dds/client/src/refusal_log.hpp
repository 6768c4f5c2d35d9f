#pragma once

#include <set>
#include <string>

#include "pelagos_dds/configuration.hpp"
#include "text/refusal.hpp"

namespace pelagos {

/// Tells of each kind of trouble once; whoever calls counts the rest.
class RefusalLog {
 public:
  explicit RefusalLog(DdsLog log) : log_(std::move(log)) {}

  /// A kind is a topic and a field, of whichever entry of a list.
  void tell(const std::string& topic, const Refusal& refusal);
  /// @param kind  a literal: there are few of them
  void tell_once(const char* kind, const std::string& text);

 private:
  DdsLog log_;
  std::set<std::string> told_;
};

}  // namespace pelagos
