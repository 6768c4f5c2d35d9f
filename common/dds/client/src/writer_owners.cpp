#include "writer_owners.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace pelagos {
namespace {

struct EndpointDeleter {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const { dds_builtintopic_free_endpoint(endpoint); }
};

ParticipantId ask(const DdsReader& reader, dds_instance_handle_t writer) {
  const std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDeleter> endpoint(
      dds_get_matched_publication_data(reader.get(), writer));
  ParticipantId id{};
  if (endpoint) std::copy_n(endpoint->participant_key.v, id.size(), id.begin());
  return id;
}

}  // namespace

ParticipantId WriterOwners::of(const DdsReader& reader, dds_instance_handle_t writer) {
  constexpr std::size_t kMost = 1024;  // writers come and go
  const auto found = known_.find(writer);
  if (found != known_.end()) return found->second;
  const ParticipantId id = ask(reader, writer);
  if (id == ParticipantId{}) return id;  // it may be known later
  if (known_.size() >= kMost) known_.clear();
  return known_.emplace(writer, id).first->second;
}

bool is_matched(const DdsReader& reader, const ParticipantId& process) {
  std::vector<dds_instance_handle_t> writers(256);
  const dds_return_t count = dds_get_matched_publications(reader.get(), writers.data(), writers.size());
  if (count > static_cast<dds_return_t>(writers.size())) return true;  // too many to look at: take it that it is there
  return std::any_of(writers.begin(), writers.begin() + std::max<dds_return_t>(count, 0),
                     [&](dds_instance_handle_t writer) { return ask(reader, writer) == process; });
}

}  // namespace pelagos
