#include "fields/field_difference.hpp"

namespace pelagos {

void FieldCompare::text(const std::string& value) {
  size(value.size());
  if (difference_) return;
  const std::size_t bytes = std::min(value.size(), other_.size());
  if (bytes == value.size() && std::memcmp(value.data(), other_.data(), bytes) == 0) {
    other_ = other_.subspan(bytes);
    return;
  }
  note("", '"' + value + '"', '"' + std::string(reinterpret_cast<const char*>(other_.data()), bytes) + '"');
}

std::string FieldCompare::place(std::size_t scalar, std::size_t count, std::size_t each) {
  std::string text;
  if (count > each) text += "[" + std::to_string(scalar / each) + "]";
  if (each == 1) return text;
  const std::size_t part = scalar % each;
  return text + (each <= 4 ? std::string(".") + "xyzw"[part] : "(" + std::to_string(part) + ")");
}

void FieldCompare::note(const std::string& place, const std::string& one, const std::string& other) {
  FieldDifference found;
  for (const std::string& part : path_) found.field += (found.field.empty() || part.front() == '[' ? "" : ".") + part;
  found.field += place;
  found.one = one;
  found.other = other;
  difference_ = std::move(found);
}

}  // namespace pelagos
