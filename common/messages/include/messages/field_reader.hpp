#pragma once

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/nearest_name.hpp"
#include "text/refusal.hpp"

namespace pelagos {

/// One thing that is wrong with a message from outside, and where its text has it.
struct TextRefusal {
  int line = 0;     ///< from 1; 0 where there is no text
  int column = 0;   ///< from 1; 0 where it does not help
  Refusal refusal;  ///< its field is a path, e.g. "water.block[1].max"
};
using TextRefusals = std::vector<TextRefusal>;

/// The finite numbers that a field may hold, both ends included.
struct Range {
  double min = 0.0;
  double max = 0.0;
  const char* unit = "";    ///< "m", "s", ... "" for none
  const char* reason = "";  ///< appended to the refusal, where the range does not explain itself
};

/// Short decimal text of a number: 1e+09 as 1000000000, 0.1 as 0.1.
[[nodiscard]] std::string format_number(double value);
/// A count for people: 1,000,000,000.
[[nodiscard]] std::string format_count(double value);

/// Reads the fields of one Protobuf message by name, and notes every fault with its path and line instead of stopping
/// at the first. A target is assigned only from a field that is present and valid: it keeps its default otherwise.
/// Names must exist in the message's schema (a wrong one is a programming error and throws std::logic_error).
class FieldReader {
 public:
  /// @param path       of this message; "" at the top
  /// @param locations  where its fields stand in the text; nullptr without a text
  /// @param line       of this message in the text, for what is missing from it
  FieldReader(const google::protobuf::Message& message, TextRefusals& faults, std::string path = "",
              const google::protobuf::TextFormat::ParseInfoTree* locations = nullptr, int line = 0);

  [[nodiscard]] bool has(const char* name) const;
  /// The field that is set of a oneof; empty if none is.
  [[nodiscard]] std::string which(const char* oneof) const;

  // Each returns whether the field is present and valid.
  bool read(const char* name, const Range& range, double& value) const;
  bool read(const char* name, const Range& range, int& value) const;
  bool read(const char* name, const Range& range, std::uint32_t& value) const;
  bool read(const char* name, std::uint64_t& value) const;
  bool read(const char* name, bool& value) const;
  bool read(const char* name, std::size_t max_length, std::string& value) const;
  /// A Vector whose components all lie in the range.
  bool read(const char* name, const Range& range, Eigen::Vector3d& value) const;
  /// The number of an enum's value; 0 if absent.
  [[nodiscard]] int read_enum(const char* name) const;
  /// Those of a repeated enum, in their order, each once at most.
  [[nodiscard]] std::vector<int> read_enums(const char* name) const;

  /// Notes a fault if the field is absent. @return whether it is there
  bool require(const char* name) const;

  /// A message field; an empty one if it is absent.
  [[nodiscard]] FieldReader child(const char* name) const;
  /// All entries of a repeated message field.
  [[nodiscard]] std::vector<FieldReader> children(const char* name) const;

  /// Notes a fault of a field of this message, or of the message itself (name "").
  void fault(const char* name, std::string what) const;
  /// Notes what does not fit: its field may be a path, as in "pulse.width" or "wave[2].length".
  void fault(const Refusal& refusal) const;
  [[nodiscard]] std::size_t fault_count() const { return faults_->size(); }

 private:
  using Field = google::protobuf::FieldDescriptor;
  [[nodiscard]] const Field& field(const char* name) const;
  [[nodiscard]] std::string path_of(const char* name) const;
  [[nodiscard]] int line_of(const Field& field, int index) const;
  [[nodiscard]] bool check_enum(const char* name, int number) const;
  bool check(const char* name, double value, const Range& range) const;
  void note_unknown_fields() const;

  const google::protobuf::Message* message_;
  TextRefusals* faults_;
  std::string path_;
  const google::protobuf::TextFormat::ParseInfoTree* locations_;
  int line_;
};

}  // namespace pelagos
