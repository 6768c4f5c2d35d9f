#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>

namespace pelagos {

/// Check of an option that takes a real number: finite and from `low` to `high`. CLI::Range refuses what lies below or
/// above and so lets NaN through. A refusal names option, value and what is allowed, e.g.
/// "--tolerance: is nan; allowed: 1e-06 to 0.05".
class NumberFrom : public CLI::Validator {
 public:
  NumberFrom(double low, double high) {
    std::ostringstream allowed;
    allowed << low << " to " << high;
    description("FLOAT in [" + allowed.str() + "]");
    func_ = [low, high, text = allowed.str()](std::string& input) {
      double value = 0.0;
      const bool good = CLI::detail::lexical_cast(input, value) && value >= low && value <= high;  // NaN is neither
      return good ? std::string() : "is " + input + "; allowed: " + text;
    };
  }
};

}  // namespace pelagos
