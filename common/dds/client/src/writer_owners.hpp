#pragma once

#include <map>

#include "client/source_watch.hpp"
#include "pelagos_dds/entities.hpp"

namespace pelagos {

/// Which process each writer belongs to. Of one thread.
class WriterOwners {
 public:
  /// The process of the writer of a sample that `reader` took; all zeros for a writer that has gone already.
  [[nodiscard]] ParticipantId of(const DdsReader& reader, dds_instance_handle_t writer);

 private:
  std::map<dds_instance_handle_t, ParticipantId> known_;
};

/// Whether a process has a writer that `reader` is matched with: it stays so for up to 10 s after the process has died.
[[nodiscard]] bool is_matched(const DdsReader& reader, const ParticipantId& process);

}  // namespace pelagos
