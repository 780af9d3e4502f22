#pragma once
/// Somebody else on this machine who makes packets: forged ones in the name of a run's programs, and those
/// that he overheard, again or damaged. Only to the loopback interface, and so many as he is asked for.

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "common/bus/dds.hpp"
#include "common/bus/options.hpp"
#include "tests/waiting.hpp"

namespace fsi::bus::test {

using Bytes = std::vector<unsigned char>;
using Guid = std::array<unsigned char, 16>;

/// A writer and a reader that hears it.
struct Pair {
  Guid writer, reader;
  bool is_of_state = false;  ///< of an interface in a step
};

inline bool is_of_state(const std::string& topic) {
  return topic.starts_with("amp_fsi/predicted/") || topic.starts_with("amp_fsi/projected/");
}

/// A packet and the port it went to.
struct Overheard {
  std::uint16_t port = 0;
  Bytes bytes;
};

/// Writers or readers of a run by topic, as a member of it sees them. Waits until there are `states`, writers or
/// readers, of the interface states of the run, which every program makes last.
inline std::multimap<std::string, Guid> endpoints(const Entity& participant, dds_entity_t kind,
                                                  std::size_t states) {
  const Entity reader(dds_create_reader(participant.get(), kind, nullptr, nullptr), "reader of endpoints");
  std::multimap<std::string, Guid> found;
  std::set<Guid> of_states;
  for (int k = 0; k < 30000 && of_states.size() < states; ++k) {
    void* place[1] = {nullptr};
    dds_sample_info_t info[1];
    while (dds_take(reader.get(), place, info, 1, 1) > 0) {
      const auto* endpoint = static_cast<const dds_builtintopic_endpoint_t*>(place[0]);
      Guid guid{};
      std::copy_n(endpoint->key.v, guid.size(), guid.begin());
      if (info[0].valid_data) found.emplace(endpoint->topic_name, guid);
      if (info[0].valid_data && is_of_state(endpoint->topic_name)) of_states.insert(guid);
      dds_return_loan(reader.get(), place, 1);
    }
    fsi::test::let_pass(0.01);
  }
  return found;
}

/// Everybody who hears somebody in a run in which so many interface states are sent in a step. A stranger would
/// have to guess them; this one knows the key.
inline std::vector<Pair> pairs_of(const std::string& run, const std::string& key, std::size_t states) {
  const auto domain = join_domain(run, 10);
  const Entity participant = create_participant(run, parse_key(key), "monitor");
  const auto all_writers = endpoints(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, states);
  const auto all_readers = endpoints(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, states);
  std::vector<Pair> pairs;
  for (const auto& [topic, writer] : all_writers) {
    const auto [begin, end] = all_readers.equal_range(topic);
    for (auto reader = begin; reader != end; ++reader)
      pairs.push_back({.writer = writer, .reader = reader->second, .is_of_state = is_of_state(topic)});
  }
  return pairs;
}

/// The message of 72 bytes by which a writer says that the samples `first` to `last` are nothing that this
/// reader needs (RTPS: INFO_DST, GAP).
inline Bytes gap(const Pair& pair, std::uint32_t first, std::uint32_t last) {
  constexpr unsigned char info_destination = 0x0e, gap = 0x08, little_endian = 1, prefix = 12;
  Bytes bytes = {'R', 'T', 'P', 'S', 2, 1, 1, 16};
  const auto add = [&](const Guid& guid, std::size_t from, std::size_t to) {
    bytes.insert(bytes.end(), guid.data() + from, guid.data() + to);
  };
  add(pair.writer, 0, prefix);
  bytes.insert(bytes.end(), {info_destination, little_endian, prefix, 0});
  add(pair.reader, 0, prefix);
  bytes.insert(bytes.end(), {gap, little_endian, 32, 0});
  add(pair.reader, prefix, pair.reader.size());
  add(pair.writer, prefix, pair.writer.size());
  for (const std::uint32_t word : {0U, first, 0U, last + 1, 1U, 0U}) {
    for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<unsigned char>(word >> (8 * k)));
  }
  return bytes;
}

/// Sends from a socket of its own.
class Forger {
 public:
  explicit Forger(const std::string& run)
      : domain_(domain_of(run)), socket_(socket(AF_INET, SOCK_DGRAM, 0)) {}
  Forger(const Forger&) = delete;
  Forger& operator=(const Forger&) = delete;
  Forger(Forger&&) = delete;
  Forger& operator=(Forger&&) = delete;
  ~Forger() { close(socket_); }

  void send(const Bytes& bytes, std::uint16_t port) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(port);
    sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  /// To every port that a program of the run may have.
  void send_to_all(const Bytes& bytes) const {
    constexpr std::uint32_t first = 7400, per_domain = 250, before_unicast = 10, used = 64;
    for (std::uint32_t k = 0; k < used; ++k)
      send(bytes, static_cast<std::uint16_t>(first + per_domain * domain_ + before_unicast + k));
  }

 private:
  std::uint32_t domain_;
  int socket_;
};

/// What `record_packets` has written to a file by now; nothing that is not complete.
inline std::vector<Overheard> overheard(const std::string& path) {
  std::vector<Overheard> packets;
  std::ifstream file(path, std::ios::binary);
  std::array<std::uint16_t, 2> head{};
  while (file.read(reinterpret_cast<char*>(head.data()), sizeof head)) {
    Overheard packet{.port = head[0], .bytes = Bytes(head[1])};
    if (!file.read(reinterpret_cast<char*>(packet.bytes.data()), head[1])) break;
    packets.push_back(std::move(packet));
  }
  return packets;
}

/// From now on this process writes what it sends to a file, at most so many packets.
void record_packets(const std::string& path, int most);

}  // namespace fsi::bus::test
