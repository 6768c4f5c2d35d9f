#include "refusals.hpp"

namespace pelagos {

void Refusals::tell(const std::string& topic, const wire::SampleFault& fault) {
  if (told_.insert(topic + " " + fault.field).second && log_)
    log_(topic + " refused: " + fault.text + " (more of this kind are counted, not told)");
}

void Refusals::tell_once(const char* kind, const std::string& text) {
  if (told_.insert(kind).second && log_) log_(text);
}

}  // namespace pelagos
