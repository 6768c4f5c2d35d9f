#pragma once

#include <set>
#include <string>

#include "pelagos_dds/configuration.hpp"
#include "wire/sample_fault.hpp"

namespace pelagos {

/// Tells of each kind of trouble once; whoever calls counts the rest.
class Refusals {
 public:
  explicit Refusals(DdsLog log) : log_(std::move(log)) {}

  /// A kind of fault is a topic and a field.
  void tell(const std::string& topic, const wire::SampleFault& fault);
  /// @param kind  a literal: there are few of them
  void tell_once(const char* kind, const std::string& text);

 private:
  DdsLog log_;
  std::set<std::string> told_;
};

}  // namespace pelagos
