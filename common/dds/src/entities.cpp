#include "pelagos_dds/entities.hpp"

#include <cstdlib>
#include <map>
#include <mutex>

#include "dds_messages.hpp"
#include "loopback_sockets.hpp"
#include "pelagos_dds/log_sink.hpp"
#include "pelagos_dds/participant.hpp"

namespace pelagos {
namespace {

// Domains that this process has joined. The library keeps such a table too, but an explicitly configured domain must be
// taken down by hand once its last participant has gone.
struct DomainTable {
  struct Entry {
    DdsEntity domain;
    int participants = 0;
    DdsReach reach;
  };
  std::mutex mutex;
  std::map<std::uint32_t, Entry> domains;
};

DomainTable& process_domains() {
  static DomainTable table;
  return table;
}

std::string failure_message(const DdsSettings& settings, dds_return_t code, const std::string& details) {
  std::string message = "cannot join DDS domain " + std::to_string(settings.domain) + ": ";
  message += details.empty() ? dds_strretcode(code) : details;
  if (!settings.config_file.empty()) {
    message += ". Check the interface and addresses in '" + settings.config_file + "'";
  } else if (std::getenv("CYCLONEDDS_URI") != nullptr) {
    message += ". Check the interface and addresses in the configuration that CYCLONEDDS_URI names";
  } else {
    message +=
        ". The loopback interface 'lo' must be up (ip link set lo up), and at most 41 processes can join a domain";
  }
  return message;
}

/// A domain, its participant, and whom its sockets reach.
struct Joined {
  DdsEntity domain, participant;  ///< the domain is empty where other code of this process had made it
  DdsReach reach;
};

Joined make_domain(const DdsSettings& settings, const std::string& configuration, bool keep_to_loopback) {
  MessageCollector collector;
  const SocketWatch watch(keep_to_loopback);
  Joined joined;
  const dds_entity_t domain = dds_create_domain(settings.domain, configuration.c_str());
  // PRECONDITION_NOT_MET: other code of this process made the domain; then it stays as it is.
  if (domain < 0 && domain != DDS_RETCODE_PRECONDITION_NOT_MET)
    throw DdsError(failure_message(settings, domain, collector.messages()));
  if (domain > 0) joined.domain = DdsEntity(domain, "domain");
  const dds_entity_t participant = dds_create_participant(settings.domain, nullptr, nullptr);
  if (participant < 0) throw DdsError(failure_message(settings, participant, collector.messages()));
  joined.participant = DdsEntity(participant, "participant");
  joined.reach = {watch.interfaces(), watch.listens_everywhere()};
  return joined;
}

/// A configuration that names loopback alone means it: only then are the sockets kept to it.
Joined make_domain(const DdsSettings& settings, const std::string& configuration) {
  const bool built_in = is_built_in(settings);
  Joined joined = make_domain(settings, configuration, built_in);
  if (built_in || !joined.domain.get() || !joined.reach.interfaces.empty()) return joined;
  joined.participant.reset();
  joined.domain.reset();
  return make_domain(settings, configuration, true);
}

DdsEntity join_domain(const DdsSettings& settings) {
  const std::string configuration = resolve_configuration(settings);
  DomainTable& table = process_domains();
  const std::lock_guard lock(table.mutex);
  if (const auto known = table.domains.find(settings.domain); known != table.domains.end()) {
    MessageCollector collector;
    const dds_entity_t participant = dds_create_participant(settings.domain, nullptr, nullptr);
    if (participant < 0) throw DdsError(failure_message(settings, participant, collector.messages()));
    ++known->second.participants;
    return DdsEntity(participant, "participant");
  }
  Joined joined = make_domain(settings, configuration);
  table.domains[settings.domain] = {std::move(joined.domain), 1, joined.reach};
  return std::move(joined.participant);
}

void leave_domain(std::uint32_t domain) {
  DomainTable& table = process_domains();
  const std::lock_guard lock(table.mutex);
  const auto found = table.domains.find(domain);
  if (found != table.domains.end() && --found->second.participants == 0) table.domains.erase(found);
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

Qos make_qos(const TopicQos& settings) {
  Qos qos(dds_create_qos());
  if (!qos) throw DdsError("out of memory");
  dds_qset_reliability(qos.get(), settings.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, settings.depth);
  dds_qset_durability(qos.get(), settings.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  // A late reader's history follows the durability service, not the history depth.
  if (settings.transient_local) {
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, settings.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (settings.liveliness_lease.count() > 0) {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, DDS_MSECS(settings.liveliness_lease.count()));
  }
  if (settings.most_instances > 0) {
    dds_qset_resource_limits(qos.get(), DDS_LENGTH_UNLIMITED, settings.most_instances, DDS_LENGTH_UNLIMITED);
  }
  // What a gone writer has written stays; instances of dead writers are purged soon, so that memory stays bounded.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  dds_qset_reader_data_lifecycle(qos.get(), DDS_SECS(10), DDS_SECS(10));
  return qos;
}

DdsEntity make_topic(const DdsParticipant& participant, const TopicSpec& spec) {
  return DdsEntity(dds_create_topic(participant.get(), spec.type, spec.name, nullptr, nullptr),
                   "topic " + std::string(spec.name));
}

}  // namespace

DdsEntity::DdsEntity(dds_entity_t handle, const std::string& what) : handle_(handle) {
  if (handle < 0) {
    handle_ = 0;
    throw DdsError("cannot create " + what + ": " + dds_strretcode(handle));
  }
}

void DdsEntity::reset() noexcept {
  if (handle_ > 0) dds_delete(handle_);
  handle_ = 0;
}

DdsParticipant::DdsParticipant(const DdsSettings& settings)
    : domain_(settings.domain), logs_(static_cast<bool>(settings.log)), participant_(join_domain(settings)) {
  if (settings.log) install_dds_log(settings.log);
}

DdsParticipant::~DdsParticipant() {
  participant_.reset();
  leave_domain(domain_);
  if (logs_) install_dds_log({});
}

DdsReach DdsParticipant::reach() const {
  DomainTable& table = process_domains();
  const std::lock_guard lock(table.mutex);
  const auto known = table.domains.find(domain_);
  return known == table.domains.end() ? DdsReach{} : known->second.reach;
}

DdsReach reach_of(const DdsParticipant& participant) { return participant.reach(); }

std::shared_ptr<DdsParticipant> join_dds(const DdsSettings& settings) {
  return std::make_shared<DdsParticipant>(settings);
}

DdsWriter::DdsWriter(const DdsParticipant& participant, const TopicSpec& spec)
    : topic_(make_topic(participant, spec)),
      writer_(dds_create_writer(participant.get(), topic_.get(), make_qos(spec.writer).get(), nullptr),
              "writer of " + std::string(spec.name)) {}

bool DdsWriter::write(const void* sample) const { return dds_write(writer_.get(), sample) == DDS_RETCODE_OK; }

std::uint32_t DdsWriter::matched_readers() const {
  dds_publication_matched_status_t status{};
  if (dds_get_publication_matched_status(writer_.get(), &status) != DDS_RETCODE_OK) return 0;
  return status.current_count;
}

DdsReader::DdsReader(const DdsParticipant& participant, const TopicSpec& spec)
    : topic_(make_topic(participant, spec)),
      reader_(dds_create_reader(participant.get(), topic_.get(), make_qos(spec.reader).get(), nullptr),
              "reader of " + std::string(spec.name)) {}

std::uint32_t DdsReader::alive_writers() const {
  dds_liveliness_changed_status_t status{};
  if (dds_get_liveliness_changed_status(reader_.get(), &status) != DDS_RETCODE_OK) return 0;
  return status.alive_count;
}

std::uint64_t DdsReader::participant_of(std::uint64_t writer) const {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader_.get(), writer);
  if (endpoint == nullptr) return writer;
  const std::uint64_t participant = endpoint->participant_instance_handle;
  dds_builtintopic_free_endpoint(endpoint);
  return participant;
}

DdsWaitSet::DdsWaitSet(const DdsParticipant& participant)
    : waitset_(dds_create_waitset(participant.get()), "wait set"),
      guard_(dds_create_guardcondition(participant.get()), "guard condition") {
  const dds_return_t code = dds_waitset_attach(waitset_.get(), guard_.get(), 0);
  if (code != DDS_RETCODE_OK) throw DdsError(std::string("cannot attach guard condition: ") + dds_strretcode(code));
}

void DdsWaitSet::attach(const DdsReader& reader, std::uint32_t status) {
  dds_return_t code = dds_set_status_mask(reader.get(), status);
  if (code == DDS_RETCODE_OK) code = dds_waitset_attach(waitset_.get(), reader.get(), reader.get());
  if (code != DDS_RETCODE_OK) throw DdsError(std::string("cannot attach reader: ") + dds_strretcode(code));
}

void DdsWaitSet::wait(std::chrono::milliseconds timeout) {
  dds_waitset_wait(waitset_.get(), nullptr, 0, DDS_MSECS(timeout.count()));
  bool was_set = false;
  dds_take_guardcondition(guard_.get(), &was_set);
}

void DdsWaitSet::wake() { dds_set_guardcondition(guard_.get(), true); }

}  // namespace pelagos

#if defined(__SANITIZE_THREAD__)
// The DDS library synchronizes with atomics that ThreadSanitizer cannot see in a library built without it. For every
// program that uses DDS.
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libddsc.so\nrace:libddsc.so\n"; }
#endif
