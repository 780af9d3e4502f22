#include "common/bus/dds.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include "common/bus/configuration.hpp"
#include "common/bus/options.hpp"
#include "common/core/failure.hpp"

namespace fsi::bus {

namespace {

/// Writers prove every third of this that they live.
constexpr dds_duration_t liveliness_lease = DDS_MSECS(300);
constexpr int lock_step_depth = 8;
constexpr int lasting_depth = 64;
constexpr int asking_depth = 16;

/// The latest line of Cyclone's log. A flood of malformed packets costs no more than this. What it dies of is said at once.
class LastLine {
 public:
  static LastLine& instance() {
    static LastLine line;
    return line;
  }
  std::string get() {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  LastLine() { dds_set_log_sink(&LastLine::keep, this); }
  static void keep(void* self, const dds_log_data_t* data) {
    auto& line = *static_cast<LastLine*>(self);
    std::string text(data->message, data->size);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    if ((data->priority & DDS_LC_FATAL) != 0) std::fprintf(stderr, "bus: %s\n", text.c_str());
    const std::lock_guard lock(line.mutex_);
    line.text_ = std::move(text);
  }

  std::mutex mutex_;
  std::string text_;
};

/// The domains this process is in; a domain is configured once per process.
struct OpenDomain {
  std::string run;
  std::weak_ptr<const Entity> entity;
};

/// Cyclone allocates every large message anew. Without this the memory goes back to the kernel each time and
/// comes back page by page, 13 % of the round trip at 10000 points.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 128 << 20);
}

/// What helps, by the words of Cyclone's log. Past the last place of a domain, creation fails.
std::string advice_on(const std::string& trouble, const std::string& run, const std::string& network) {
  if (trouble.find("participant index") != std::string::npos)
    return fmt::format(
        ". Domain {} of this machine is full ({} programs): end other runs, or give this run another name; "
        "if this "
        "run alone has too many, with its monitors, let some of them run on other machines (fsi run --hosts)",
        domain_of(run), places_in_a_domain);
  if (trouble.find("interface") == std::string::npos) return "";
  if (network.empty()) return "; is the loopback interface up? as root: ip link set lo up";
  return fmt::format("; this machine needs an interface that has the address {}", network);
}

dds_entity_t checked_place(dds_entity_t handle, const std::string& run, const std::string& network = "") {
  if (handle >= 0) return handle;
  const std::string trouble = last_log_line();
  throw PeerLost(fmt::format("cannot join run '{}' on the bus: {} ({}){}", run, dds_strretcode(handle),
                             trouble, advice_on(trouble, run, network)));
}

/// The plugins lie in a folder beside the library itself (Debian: libddsc0debian/).
std::string plugin_path(const std::string& name) {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &info) != 0) {
    const std::filesystem::path folder = std::filesystem::weakly_canonical(info.dli_fname).parent_path();
    if (std::filesystem::exists(folder / name)) return folder / name;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string inside = entry.path().filename().string();
      if (inside.starts_with("libddsc") && std::filesystem::exists(entry.path() / name))
        return entry.path() / name;
    }
  }
  throw Failure(ExitCode::user_mistake,
                fmt::format("bus: {} of Cyclone DDS is not where libddsc.so is: packets cannot be signed "
                            "(fsi run --no-security does without)",
                            name));
}

Qos participant_qos(const std::string& run, const RunKey& key, const std::string& role) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  if (key.protection == Protection::off) return qos;
  const auto set = [&](const std::string& name, const std::string& value) {
    dds_qset_prop(qos.get(), ("dds.sec." + name).c_str(), value.c_str());
  };
  const auto load = [&](const std::string& kind, const std::string& library, const std::string& function) {
    set(kind + ".library.path", plugin_path("libdds_security_" + library + ".so"));
    set(kind + ".library.init", "init_" + function);
    set(kind + ".library.finalize", "finalize_" + function);
  };
  load("auth", "auth", "authentication");
  load("access", "ac", "access_control");
  load("crypto", "crypto", "crypto");
  const Credentials own = make_credentials(key, run, role);
  set("auth.identity_ca", "data:," + own.authority);
  set("auth.identity_certificate", "data:," + own.certificate);
  set("auth.private_key", "data:," + own.private_key);
  set("access.permissions_ca", "data:," + own.authority);
  set("access.governance", "data:," + own.governance);
  set("access.permissions", "data:," + own.permissions);
  return qos;
}

}  // namespace

dds_return_t checked(dds_return_t result, const std::string& doing) {
  if (result >= 0) return result;
  throw Failure(ExitCode::internal_error,
                fmt::format("bus: {}: {}{}", doing, dds_strretcode(result),
                            last_log_line().empty() ? "" : " (" + last_log_line() + ")"));
}

std::string last_log_line() {
  return LastLine::instance().get();
}

std::shared_ptr<const Entity> join_domain(const std::string& run, double participant_lease_s,
                                          const std::string& network) {
  static std::mutex mutex;
  static std::map<std::uint32_t, OpenDomain> open;
  const std::lock_guard lock(mutex);
  LastLine::instance();
  keep_freed_memory();
  OpenDomain& domain = open[domain_of(run)];
  if (auto entity = domain.entity.lock()) {
    if (domain.run == run) return entity;
    throw Failure(ExitCode::internal_error,
                  fmt::format("bus: runs '{}' and '{}' share a domain and cannot live in one process", run,
                              domain.run));
  }
  const std::uint32_t id = domain_of(run);
  const dds_entity_t handle = checked_place(
      dds_create_domain(id, configuration_xml(run, participant_lease_s, network).c_str()), run, network);
  auto entity = std::make_shared<const Entity>(handle, "domain");
  domain = {run, entity};
  return entity;
}

Entity create_participant(const std::string& run, const RunKey& key, const std::string& role) {
  const Qos qos = participant_qos(run, key, role);
  return {checked_place(dds_create_participant(domain_of(run), qos.get(), nullptr), run), "participant"};
}

Qos writer_qos(Delivery delivery) {
  Qos qos = reader_qos(delivery);
  dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, liveliness_lease);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  return qos;
}

Qos reader_qos(Delivery delivery) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  switch (delivery) {
    case Delivery::lock_step:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
      dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, lock_step_depth);
      break;
    case Delivery::passing:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
      dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, lasting_depth);
      break;
    case Delivery::newest:
    case Delivery::lasting:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
      dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
      dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST,
                                  delivery == Delivery::newest ? 1 : lasting_depth, DDS_LENGTH_UNLIMITED,
                                  DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, delivery == Delivery::newest ? 1 : lasting_depth);
      break;
    case Delivery::listening:
    case Delivery::asking:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
      dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, delivery == Delivery::asking ? asking_depth : 1);
      break;
  }
  return qos;
}

std::string policy_name(std::uint32_t policy) {
  switch (policy) {
    case DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID:
      return "the message type (another version of amp_fsi.idl)";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "the data representation";
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    default:
      return fmt::format("QoS policy {}", policy);
  }
}

std::string topic_name(const std::string& kind, const std::vector<std::string>& parts) {
  std::string name = "amp_fsi/" + kind;
  for (const std::string& part : parts) {
    name += '/';
    for (const char c : part) {
      const auto byte = static_cast<unsigned char>(c);
      if (std::isalnum(byte) != 0) {
        name += c;
      } else {
        name += c == '_' ? "__" : fmt::format("_{:02X}", byte);
      }
    }
  }
  return name;
}

template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Hello>() {
  return amp_fsi_Hello_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Welcome>() {
  return amp_fsi_Welcome_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_PredictedInterface>() {
  return amp_fsi_PredictedInterface_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_ProjectedInterface>() {
  return amp_fsi_ProjectedInterface_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Abort>() {
  return amp_fsi_Abort_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Control>() {
  return amp_fsi_Control_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Waiting>() {
  return amp_fsi_Waiting_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Telemetry>() {
  return amp_fsi_Telemetry_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Watch>() {
  return amp_fsi_Watch_desc;
}
template <>
const dds_topic_descriptor_t& descriptor<amp_fsi_Picture>() {
  return amp_fsi_Picture_desc;
}

}  // namespace fsi::bus
