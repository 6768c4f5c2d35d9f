#pragma once

#include <nlohmann/json.hpp>

#include "machine.hpp"

namespace pelagos {

/// Adds what a run's numbers depend on: threads, instruction set, processor.
inline void add_machine(nlohmann::ordered_json& json, int threads) {
  const Machine machine = describe_machine();
  json["threads"] = threads;
  json["instruction_set"] = machine.instruction_set;
  json["processor"] = machine.processor;
}

}  // namespace pelagos
