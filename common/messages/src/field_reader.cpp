#include "messages/field_reader.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

namespace pelagos {

using google::protobuf::Message;
using google::protobuf::Reflection;

std::string format_number(double value) {
  std::array<char, 40> text{};
  const bool whole = std::isfinite(value) && value == std::floor(value) && std::fabs(value) < 1e15;
  std::snprintf(text.data(), text.size(), whole ? "%.0f" : "%.7g", value);
  return text.data();
}

std::string format_count(double value) {
  if (!(std::fabs(value) < 1e18)) return format_number(value);
  const std::string digits = std::to_string(static_cast<std::int64_t>(std::fabs(value)));
  std::string text = value < 0 ? "-" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

namespace {

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

std::string allowed_text(const Range& range) {
  std::string text = "allowed: " + format_number(range.min);
  text += range.max >= std::numeric_limits<double>::max() ? " or more" : " to " + format_number(range.max);
  if (*range.unit != '\0') text += std::string(" ") + range.unit;
  if (*range.reason != '\0') text += std::string(" (") + range.reason + ")";
  return text;
}

}  // namespace

FieldReader::FieldReader(const Message& message, TextRefusals& faults, std::string path,
                         const google::protobuf::TextFormat::ParseInfoTree* locations, int line)
    : message_(&message), faults_(&faults), path_(std::move(path)), locations_(locations), line_(line) {
  note_unknown_fields();
}

/// A message in binary form keeps the fields that its schema does not know, by number.
void FieldReader::note_unknown_fields() const {
  const auto& unknown = message_->GetReflection()->GetUnknownFields(*message_);
  std::set<int> numbers;
  for (int i = 0; i < unknown.field_count(); ++i) numbers.insert(unknown.field(i).number());
  for (const int number : numbers) {
    fault("", "field number " + std::to_string(number) + " is not known in " + message_->GetDescriptor()->name() +
                  "; is the sender newer than this program?");
  }
}

const FieldReader::Field& FieldReader::field(const char* name) const {
  const Field* found = message_->GetDescriptor()->FindFieldByName(name);
  if (found == nullptr) throw std::logic_error(message_->GetDescriptor()->full_name() + " has no field " + name);
  return *found;
}

bool FieldReader::has(const char* name) const {
  const auto& wanted = field(name);
  const auto& reflection = *message_->GetReflection();
  return wanted.is_repeated() ? reflection.FieldSize(*message_, &wanted) > 0 : reflection.HasField(*message_, &wanted);
}

std::string FieldReader::which(const char* oneof) const {
  const auto* descriptor = message_->GetDescriptor()->FindOneofByName(oneof);
  if (descriptor == nullptr) throw std::logic_error(message_->GetDescriptor()->full_name() + " has no oneof " + oneof);
  const Field* set = message_->GetReflection()->GetOneofFieldDescriptor(*message_, descriptor);
  return set == nullptr ? "" : set->name();
}

std::string FieldReader::path_of(const char* name) const {
  if (*name == '\0') return path_;
  return path_.empty() ? name : path_ + "." + name;
}

int FieldReader::line_of(const Field& descriptor, int index) const {
  if (locations_ == nullptr) return line_;
  const auto location = locations_->GetLocation(&descriptor, index);
  return location.line < 0 ? line_ : location.line + 1;
}

void FieldReader::fault(const Refusal& refusal) const {
  const std::size_t dot = refusal.field.find('.');
  if (dot == std::string::npos) return fault(refusal.field.c_str(), refusal.what);
  const std::string name = refusal.field.substr(0, refusal.field.find('[')), rest = refusal.field.substr(dot + 1);
  if (name.size() >= dot) return child(refusal.field.substr(0, dot).c_str()).fault(Refusal{rest, refusal.what});
  children(name.c_str()).at(std::stoul(refusal.field.substr(name.size() + 1))).fault(Refusal{rest, refusal.what});
}

void FieldReader::fault(const char* name, std::string what) const {
  int line = line_;
  if (*name != '\0') {
    const Field& descriptor = field(name);
    line = line_of(descriptor, descriptor.is_repeated() ? 0 : -1);
  }
  faults_->push_back({line, 0, {path_of(name), std::move(what)}});
}

bool FieldReader::check(const char* name, double value, const Range& range) const {
  if (value >= range.min && value <= range.max) return true;  // false for NaN
  fault(name, format_number(value) + " is out of range; " + allowed_text(range));
  return false;
}

bool FieldReader::read(const char* name, const Range& range, double& value) const {
  if (!has(name)) return false;
  const double given = message_->GetReflection()->GetDouble(*message_, &field(name));
  if (!check(name, given, range)) return false;
  value = given;
  return true;
}

bool FieldReader::read(const char* name, const Range& range, int& value) const {
  if (!has(name)) return false;
  const int given = message_->GetReflection()->GetInt32(*message_, &field(name));
  if (!check(name, given, range)) return false;
  value = given;
  return true;
}

bool FieldReader::read(const char* name, const Range& range, std::uint32_t& value) const {
  if (!has(name)) return false;
  const std::uint32_t given = message_->GetReflection()->GetUInt32(*message_, &field(name));
  if (!check(name, given, range)) return false;
  value = given;
  return true;
}

bool FieldReader::read(const char* name, std::uint64_t& value) const {
  if (!has(name)) return false;
  value = message_->GetReflection()->GetUInt64(*message_, &field(name));
  return true;
}

bool FieldReader::read(const char* name, bool& value) const {
  if (!has(name)) return false;
  value = message_->GetReflection()->GetBool(*message_, &field(name));
  return true;
}

bool FieldReader::read(const char* name, std::size_t max_length, std::string& value) const {
  if (!has(name)) return false;
  const std::string given = message_->GetReflection()->GetString(*message_, &field(name));
  if (given.empty() || given.size() > max_length || std::any_of(given.begin(), given.end(), is_control)) {
    fault(name, "has " + std::to_string(given.size()) + " bytes of UTF-8; allowed: 1 to " + std::to_string(max_length) +
                    ", none of them a control character");
    return false;
  }
  value = given;
  return true;
}

bool FieldReader::read(const char* name, const Range& range, Eigen::Vector3d& value) const {
  if (!has(name)) return false;
  const FieldReader components = child(name);
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  bool valid = true;
  const std::array<const char*, 3> axes{"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const char* axis = axes[static_cast<std::size_t>(i)];
    if (components.has(axis)) valid = components.read(axis, range, given[i]) && valid;
  }
  if (valid) value = given;
  return valid;
}

bool FieldReader::check_enum(const char* name, int number) const {
  const google::protobuf::EnumDescriptor& type = *field(name).enum_type();
  if (type.FindValueByNumber(number) != nullptr) return true;  // otherwise possible in binary form only
  fault(name, std::to_string(number) + " is none of the values of " + type.name());
  return false;
}

int FieldReader::read_enum(const char* name) const {
  const int number = message_->GetReflection()->GetEnumValue(*message_, &field(name));
  return check_enum(name, number) ? number : 0;
}

std::vector<int> FieldReader::read_enums(const char* name) const {
  const Field& descriptor = field(name);
  const auto& reflection = *message_->GetReflection();
  std::vector<int> numbers;
  for (int i = 0; i < reflection.FieldSize(*message_, &descriptor); ++i) {
    const int number = reflection.GetRepeatedEnumValue(*message_, &descriptor, i);
    if (!check_enum(name, number)) continue;
    if (std::find(numbers.begin(), numbers.end(), number) != numbers.end())
      fault(name, descriptor.enum_type()->FindValueByNumber(number)->name() + " is given twice; allowed: each once");
    else
      numbers.push_back(number);
  }
  return numbers;
}

bool FieldReader::require(const char* name) const {
  const Field& descriptor = field(name);
  const bool there =
      descriptor.is_repeated() ? message_->GetReflection()->FieldSize(*message_, &descriptor) > 0 : has(name);
  if (!there) fault(name, "is missing; it is required");
  return there;
}

FieldReader FieldReader::child(const char* name) const {
  const Field& descriptor = field(name);
  const auto* locations = locations_ != nullptr && has(name) ? locations_->GetTreeForNested(&descriptor, -1) : nullptr;
  return {message_->GetReflection()->GetMessage(*message_, &descriptor), *faults_, path_of(name), locations,
          line_of(descriptor, -1)};
}

std::vector<FieldReader> FieldReader::children(const char* name) const {
  const Field& descriptor = field(name);
  std::vector<FieldReader> entries;
  const int count = message_->GetReflection()->FieldSize(*message_, &descriptor);
  for (int i = 0; i < count; ++i) {
    entries.emplace_back(message_->GetReflection()->GetRepeatedMessage(*message_, &descriptor, i), *faults_,
                         path_of(name) + "[" + std::to_string(i) + "]",
                         locations_ != nullptr ? locations_->GetTreeForNested(&descriptor, i) : nullptr,
                         line_of(descriptor, i));
  }
  return entries;
}

}  // namespace pelagos
