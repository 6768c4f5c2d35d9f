#include "refusal_log.hpp"

namespace pelagos {
namespace {

/// The field without the number of its entry: "bodies[3].health" as "bodies.health".
std::string field_of_any_entry(const std::string& field) {
  const std::size_t open = field.find('['), close = field.find(']');
  return open == std::string::npos || close == std::string::npos ? field
                                                                 : field.substr(0, open) + field.substr(close + 1);
}

}  // namespace

void RefusalLog::tell(const std::string& topic, const Refusal& refusal) {
  if (told_.insert(topic + " " + field_of_any_entry(refusal.field)).second && log_)
    log_(topic + " refused: " + to_string(refusal) + " (more of this kind are counted, not told)");
}

void RefusalLog::tell_once(const char* kind, const std::string& text) {
  if (told_.insert(kind).second && log_) log_(text);
}

}  // namespace pelagos
