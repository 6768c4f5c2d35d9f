#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace pelagos {

/// Check of an option that takes a real number: decimal, finite and from `low` to `high`. CLI::Range refuses what lies
/// below or above and so lets NaN through. A refusal names option, value and what is allowed, e.g.
/// "--tolerance: is nan; allowed: 1e-06 to 0.05". Both ends are in the help.
class NumberFrom : public CLI::Validator {
 public:
  NumberFrom(double low, double high);
};

/// The same for whole numbers.
class WholeFrom : public CLI::Validator {
 public:
  WholeFrom(long long low, long long high);
};

/// Check of an option that takes one of some words. A refusal offers the nearest.
class OneOf : public CLI::Validator {
 public:
  explicit OneOf(std::vector<std::string> words);
};

/// Check of an option that takes a folder, which has to be there.
class FolderThatExists : public CLI::Validator {
 public:
  FolderThatExists();
};

}  // namespace pelagos
