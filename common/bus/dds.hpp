#pragma once
/// Thin C++ layer over the C API of Cyclone DDS: handles that clean up, error codes as exceptions, typed
/// topics. Only the sources of common/bus include this.

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "amp_fsi.h"
#include "common/bus/peers/credentials.hpp"

namespace fsi::bus {

/// Passes a handle or count through; a negative result becomes an internal error saying what was being done.
dds_return_t checked(dds_return_t result, const std::string& doing);

/// Move-only owner of one DDS entity.
class Entity {
 public:
  Entity() = default;
  Entity(dds_entity_t handle, const std::string& doing) : handle_(checked(handle, doing)) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// The kinds of topics. Everything is keyless but telemetry, whose key is the sender, and pictures: the
/// sender and the quantity.
enum class Delivery {
  lock_step,  ///< reliable, volatile, last 8: one writer, one reader, one sample per step
  lasting,    ///< reliable, late joiners get the last samples: abort, control; what hears hello, welcome
  newest,     ///< the same, but only the last sample of each sender: who says hello, welcome
  passing,    ///< reliable, nothing for late joiners: waiting
  listening,  ///< best effort, newest only: telemetry, pictures
  asking,     ///< best effort, last 16: watch
};

Qos writer_qos(Delivery delivery);
Qos reader_qos(Delivery delivery);

/// Handle of the run's domain, shared by all sessions of this process.
std::shared_ptr<const Entity> join_domain(const std::string& run, double participant_lease_s,
                                          const std::string& network = {});

/// A participant in the run's domain; `role` becomes its identity where the run is protected.
/// @throws PeerLost when the machine has no place for one more
Entity create_participant(const std::string& run, const RunKey& key = {}, const std::string& role = {});

/// What Cyclone DDS logged last (it never writes to the terminal): words for a failure.
std::string last_log_line();

/// "type" or the name of a QoS policy, by DDS's number for it.
std::string policy_name(std::uint32_t policy);

/// Topic name from the names of a participant and an interface. DDS allows letters, digits and '_' only: in
/// the parts '_' is doubled and every other character becomes _XX (hexadecimal).
std::string topic_name(const std::string& kind, const std::vector<std::string>& parts = {});

template <class T>
const dds_topic_descriptor_t& descriptor();

/// Sleeps until something attached is triggered.
class Waitset {
 public:
  explicit Waitset(const Entity& participant) : waitset_(dds_create_waitset(participant.get()), "waitset") {}
  void attach(const Entity& condition) {
    checked(dds_waitset_attach(waitset_.get(), condition.get(), 0), "attach");
  }
  /// False when `seconds` have passed.
  bool wait(double seconds) {
    const auto timeout = static_cast<dds_duration_t>(seconds * 1e9);
    return checked(dds_waitset_wait(waitset_.get(), nullptr, 0, timeout), "wait") > 0;
  }

 private:
  Entity waitset_;
};

/// Sends samples of one topic.
template <class T>
class Writer {
 public:
  Writer(const Entity& participant, const std::string& name, Delivery delivery)
      : topic_(dds_create_topic(participant.get(), &descriptor<T>(), name.c_str(), nullptr, nullptr),
               "topic " + name),
        writer_(dds_create_writer(participant.get(), topic_.get(), writer_qos(delivery).get(), nullptr),
                "writer " + name) {}

  void write(const T& sample) { checked(dds_write(writer_.get(), &sample), "write"); }
  /// Waits until every matched reader has everything; false after `seconds`.
  bool arrived(double seconds) const {
    return dds_wait_for_acks(writer_.get(), static_cast<dds_duration_t>(seconds * 1e9)) == DDS_RETCODE_OK;
  }
  /// Readers that can hear this.
  int matched() const {
    dds_publication_matched_status_t status{};
    checked(dds_get_publication_matched_status(writer_.get(), &status), "matched readers");
    return static_cast<int>(status.current_count);
  }
  /// From now on a new or lost reader wakes the waitset until
  /// `matched` is asked; no longer after `ignore_matches`.
  void announce_matches(Waitset& waitset) const {
    checked(dds_set_status_mask(writer_.get(), DDS_PUBLICATION_MATCHED_STATUS), "status mask");
    waitset.attach(writer_);
  }
  void ignore_matches() const { checked(dds_set_status_mask(writer_.get(), 0), "status mask"); }
  /// Policy that keeps a reader from matching, 0 if none was met.
  std::uint32_t incompatible_policy() const {
    dds_offered_incompatible_qos_status_t status{};
    dds_get_offered_incompatible_qos_status(writer_.get(), &status);
    return status.total_count > 0 ? status.last_policy_id : 0;
  }

 private:
  Entity topic_, writer_;
};

/// Receives samples of one topic, one after the other into the same memory: no allocation once it has grown.
template <class T>
class Reader {
 public:
  Reader(const Entity& participant, const std::string& name, Delivery delivery)
      : topic_(dds_create_topic(participant.get(), &descriptor<T>(), name.c_str(), nullptr, nullptr),
               "topic " + name),
        reader_(dds_create_reader(participant.get(), topic_.get(), reader_qos(delivery).get(), nullptr),
                "reader " + name),
        condition_(dds_create_readcondition(reader_.get(), DDS_ANY_STATE), "condition " + name),
        sample_(new(dds_alloc(sizeof(T))) T{}) {}

  /// Calls `use(sample)`, or `use(sample, time of writing)`, for everything that has arrived.
  template <class Use>
  void take(const Use& use) {
    void* place[1] = {sample_.get()};
    dds_sample_info_t info[1];
    while (checked(dds_take(reader_.get(), place, info, 1, 1), "take") > 0) {
      if (!info[0].valid_data) continue;
      if constexpr (requires { use(std::as_const(*sample_), info[0].source_timestamp); }) {
        use(std::as_const(*sample_), info[0].source_timestamp);
      } else {
        use(std::as_const(*sample_));
      }
    }
  }
  const Entity& condition() const { return condition_; }
  /// Writers that can be heard.
  int matched() const {
    dds_subscription_matched_status_t status{};
    checked(dds_get_subscription_matched_status(reader_.get(), &status), "matched writers");
    return static_cast<int>(status.current_count);
  }
  /// From now on a new or lost writer wakes the waitset until
  /// `matched` is asked; no longer after `ignore_matches`.
  void announce_matches(Waitset& waitset) const {
    checked(dds_set_status_mask(reader_.get(), DDS_SUBSCRIPTION_MATCHED_STATUS), "status mask");
    waitset.attach(reader_);
  }
  void ignore_matches() const { checked(dds_set_status_mask(reader_.get(), 0), "status mask"); }
  /// Writers whose liveliness lease holds.
  int alive() const {
    dds_liveliness_changed_status_t status{};
    dds_get_liveliness_changed_status(reader_.get(), &status);
    return static_cast<int>(status.alive_count);
  }
  /// Policy that keeps a writer from matching, 0 if none was met.
  std::uint32_t incompatible_policy() const {
    dds_requested_incompatible_qos_status_t status{};
    dds_get_requested_incompatible_qos_status(reader_.get(), &status);
    return status.total_count > 0 ? status.last_policy_id : 0;
  }

 private:
  struct FreeSample {
    void operator()(T* sample) const { dds_sample_free(sample, &descriptor<T>(), DDS_FREE_ALL); }
  };

  Entity topic_, reader_, condition_;
  std::unique_ptr<T, FreeSample> sample_;
};

}  // namespace fsi::bus
