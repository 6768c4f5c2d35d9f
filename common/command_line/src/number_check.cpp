#include "command_line/number_check.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "text/decimal.hpp"
#include "text/nearest_name.hpp"

namespace pelagos {
namespace {

std::string range_text(double low, double high) {
  std::ostringstream text;
  text << low << " to " << high;
  return text.str();
}

/// Refusal of a value; the reason stands in brackets where the value does not show it.
std::string refuse(const std::string& value, const std::string& reason, const std::string& allowed) {
  if (value.empty()) return "is empty; allowed: " + allowed;
  const bool plain = reason.empty() || reason == "not finite" || reason == "no number" || reason == "negative";
  return "is " + value + (plain ? "" : " (" + reason + ")") + "; allowed: " + allowed;
}

}  // namespace

NumberFrom::NumberFrom(double low, double high) {
  const std::string allowed = range_text(low, high);
  description("FLOAT in [" + allowed + "]");
  func_ = [low, high, allowed](std::string& input) {
    const std::string fault = fault_of_number(input, NumberKind::kReal);
    const double value = read_decimal(input).value_or(high + 1.0);
    return fault.empty() && value >= low && value <= high ? "" : refuse(input, fault, allowed);
  };
}

WholeFrom::WholeFrom(long long low, long long high) {
  const std::string allowed = std::to_string(low) + " to " + std::to_string(high);
  description("INT in [" + allowed + "]");
  func_ = [low, high, allowed](std::string& input) {
    const std::string fault = fault_of_number(input, NumberKind::kWhole);
    long long value = 0;
    std::istringstream text(input);  // decimal: std::dec is the default
    const bool good = fault.empty() && (text >> value) && value >= low && value <= high;
    return good ? "" : refuse(input, fault, allowed);
  };
}

FolderThatExists::FolderThatExists() {
  description("DIR");
  func_ = [](std::string& input) -> std::string {
    std::error_code error;
    if (std::filesystem::is_directory(input, error)) return "";
    return input.empty() ? "is empty; allowed: a folder" : "is " + input + "; there is no such folder";
  };
}

OneOf::OneOf(std::vector<std::string> words) {
  std::string allowed;
  for (const std::string& word : words) allowed += (allowed.empty() ? "" : ", ") + word;
  description("{" + allowed + "}");
  func_ = [words = std::move(words), allowed](std::string& input) -> std::string {
    if (std::find(words.begin(), words.end(), input) != words.end()) return "";
    const std::string nearest = nearest_name(input, words);
    return (input.empty() ? "is empty" : "is " + input) +
           (nearest.empty() ? "; allowed: " : "; did you mean " + nearest + "? Allowed: ") + allowed;
  };
}

}  // namespace pelagos
