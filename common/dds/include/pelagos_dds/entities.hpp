#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "pelagos_dds/configuration.hpp"

// RAII over the C API of Cyclone DDS. Constructors throw DdsError; everything that runs in a loop returns a status.

namespace pelagos {

/// Owns one entity and deletes it (and its children).
class DdsEntity {
 public:
  DdsEntity() = default;
  /// Takes over `handle`; if it is an error code, throws DdsError("cannot create <what>: ...").
  DdsEntity(dds_entity_t handle, const std::string& what);
  ~DdsEntity() { reset(); }
  DdsEntity(DdsEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  DdsEntity& operator=(DdsEntity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  DdsEntity(const DdsEntity&) = delete;
  DdsEntity& operator=(const DdsEntity&) = delete;

  [[nodiscard]] dds_entity_t get() const { return handle_; }
  void reset() noexcept;

 private:
  dds_entity_t handle_ = 0;
};

/// A process's membership of a domain. The first participant of a domain in a process configures the domain; the last
/// one takes it down. With a log in the settings, messages of the DDS library go there while this lives; the library
/// knows one log for the process, the latest.
class DdsParticipant {
 public:
  explicit DdsParticipant(const DdsSettings& settings);
  ~DdsParticipant();
  DdsParticipant(const DdsParticipant&) = delete;
  DdsParticipant& operator=(const DdsParticipant&) = delete;

  [[nodiscard]] dds_entity_t get() const { return participant_.get(); }
  [[nodiscard]] DdsReach reach() const;

 private:
  std::uint32_t domain_;
  bool logs_;
  DdsEntity participant_;
};

/// The part of a topic's quality of service that the project uses. Defaults: reliable, last value, volatile.
struct TopicQos {
  bool reliable = true;
  int depth = 1;                                  ///< KEEP_LAST, for each key
  bool transient_local = false;                   ///< a late reader gets the writer's last values
  int most_instances = 0;                         ///< > 0: of a reader; keys beyond are dropped, memory stays bounded
  std::chrono::milliseconds liveliness_lease{0};  ///< > 0: automatic liveliness with this lease
};

/// Name, type and quality of service of a topic: all that both ends must agree on.
struct TopicSpec {
  const char* name = nullptr;
  const dds_topic_descriptor_t* type = nullptr;
  TopicQos writer;
  TopicQos reader;
};

/// A topic with a writer on it. write() never waits for a reader (KEEP_LAST, no blocking time).
class DdsWriter {
 public:
  DdsWriter(const DdsParticipant& participant, const TopicSpec& spec);
  [[nodiscard]] dds_entity_t get() const { return writer_.get(); }
  /// False if the library refused the sample. `sample` must be of the topic's generated type.
  [[nodiscard]] bool write(const void* sample) const;
  /// Readers matched now; a process that died stays matched for up to 10 s.
  [[nodiscard]] std::uint32_t matched_readers() const;

 private:
  DdsEntity topic_;
  DdsEntity writer_;
};

/// Samples on loan from a reader; goes back when it is destroyed, which must be before its reader is.
template <class Type>
class DdsLoan {
 public:
  static constexpr std::size_t kMost = 32;  ///< samples in one loan

  DdsLoan() = default;
  ~DdsLoan() {
    if (count_ > 0) dds_return_loan(reader_, samples_, count_);
  }
  DdsLoan(const DdsLoan&) = delete;
  DdsLoan& operator=(const DdsLoan&) = delete;

  /// Takes up to kMost samples off `reader`. Only once.
  void take(dds_entity_t reader) {
    reader_ = reader;
    count_ = dds_take(reader, samples_, infos_, kMost, kMost);
  }
  [[nodiscard]] std::size_t size() const { return count_ > 0 ? static_cast<std::size_t>(count_) : 0; }
  /// Null where the sample carries no data, only a change of state.
  [[nodiscard]] const Type* data(std::size_t index) const {
    return infos_[index].valid_data ? static_cast<const Type*>(samples_[index]) : nullptr;
  }
  [[nodiscard]] const dds_sample_info_t& info(std::size_t index) const { return infos_[index]; }

 private:
  dds_entity_t reader_ = 0;
  dds_return_t count_ = 0;
  void* samples_[kMost] = {};
  dds_sample_info_t infos_[kMost] = {};
};

/// A topic with a reader on it.
class DdsReader {
 public:
  DdsReader(const DdsParticipant& participant, const TopicSpec& spec);
  [[nodiscard]] dds_entity_t get() const { return reader_.get(); }
  /// Writers that are alive by their liveliness.
  [[nodiscard]] std::uint32_t alive_writers() const;

  /// The participant that owns a writer (`publication_handle` of a sample's info); the writer's own handle where the
  /// writer has gone. Asks the library each time.
  [[nodiscard]] std::uint64_t participant_of(std::uint64_t writer) const;

  /// Calls use(const Type&), or use(const Type&, const dds_sample_info_t&), for each sample that waits. Bounded: at
  /// most `rounds` loans of 32 samples.
  template <class Type, class Use>
  void take_all(Use&& use, int rounds = 8) const {
    for (int round = 0; round < rounds; ++round) {
      DdsLoan<Type> loan;
      loan.take(get());
      for (std::size_t i = 0; i < loan.size(); ++i) {
        const Type* sample = loan.data(i);
        if (sample == nullptr) continue;
        if constexpr (std::is_invocable_v<Use, const Type&, const dds_sample_info_t&>) {
          use(*sample, loan.info(i));
        } else {
          use(*sample);
        }
      }
      if (loan.size() < DdsLoan<Type>::kMost) return;
    }
  }

 private:
  DdsEntity topic_;
  DdsEntity reader_;
};

/// Waits for data or changes of liveliness on readers, or for wake(). One thread waits.
class DdsWaitSet {
 public:
  explicit DdsWaitSet(const DdsParticipant& participant);
  /// `reader` must outlive the wait set or be detached with it; `status` is a mask of DDS_..._STATUS.
  void attach(const DdsReader& reader, std::uint32_t status = DDS_DATA_AVAILABLE_STATUS);
  /// Returns when something happened, after `timeout` at the latest.
  void wait(std::chrono::milliseconds timeout);
  /// Ends the present or next wait(). From any thread.
  void wake();

 private:
  DdsEntity waitset_;
  DdsEntity guard_;
};

}  // namespace pelagos
