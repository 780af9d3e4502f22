#include "common/bus/configuration.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "common/bus/options.hpp"

namespace fsi::bus {

namespace {

/// Domains whose ports lie below Linux's ephemeral range (32768
/// and up): nobody's outgoing connection takes them.
constexpr std::uint32_t domains = 100;
/// Of a domain (RTPS 9.6): from 10 on two for each participant, the first ones are those of multicast.
constexpr int ports_of_a_domain = 250;
static_assert(10 + 2 * places_in_a_domain <= ports_of_a_domain, "the next domain has those");
/// Smaller receive buffers lose packets of samples of about 1 MB.
constexpr long comfortable_rmem = 1 << 20;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '$':
        result += "_";
        break;  // Cyclone expands ${VARIABLES}
      default:
        result += c;
    }
  }
  return result;
}

/// On which interface, in what pieces, and where the others are looked for.
struct Ways {
  std::string interface = R"(name="lo")", message = "65500B", fragment = "65000B";
  std::string peers = R"(<Peer Address="127.0.0.1"/>)";
};

/// What is lost on a network is one packet then, and not the whole of a message that was cut into packets.
Ways ways_of(const std::string& network) {
  Ways ways;
  if (network.empty()) return ways;
  ways = {.message = "14720B", .fragment = "1344B", .peers = ""};
  std::istringstream addresses(network);
  for (std::string address; std::getline(addresses, address, ',');) {
    if (ways.peers.empty()) ways.interface = fmt::format(R"(address="{}")", escaped(address));
    ways.peers += fmt::format(R"(<Peer Address="{}"/>)", escaped(address));
  }
  return ways;
}

}  // namespace

std::string configuration_xml(const std::string& run, double participant_lease_s,
                              const std::string& network) {
  const Ways ways = ways_of(network);
  std::string xml = fmt::format(R"(<CycloneDDS><Domain Id="any">
  <General>
    <Interfaces><NetworkInterface {}/></Interfaces>
    <AllowMulticast>false</AllowMulticast>
    <MaxMessageSize>{}</MaxMessageSize>
    <FragmentSize>{}</FragmentSize>
  </General>
  <Discovery>
    <Tag>{}</Tag>
    <ParticipantIndex>auto</ParticipantIndex>
    <MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>
    <Peers>{}</Peers>
    <LeaseDuration>{}s</LeaseDuration>
  </Discovery>
  <Internal>
    <Watermarks><WhcHigh>64MB</WhcHigh><WhcHighInit>64MB</WhcHighInit></Watermarks>
    <SocketReceiveBufferSize min="default" max="8MB"/>
    <NackDelay>1ms</NackDelay>
    <WriterLingerDuration>20ms</WriterLingerDuration>
    <HeartbeatInterval min="1ms" minsched="2ms">10ms</HeartbeatInterval>
  </Internal>
</Domain></CycloneDDS>)",
                                ways.interface, ways.message, ways.fragment, escaped(run),
                                places_in_a_domain - 1, ways.peers, participant_lease_s);
  const char* environment = std::getenv(more_settings);  // NOLINT(concurrency-mt-unsafe): nobody sets it here
  if (environment != nullptr && *environment != '\0') xml += std::string(",") + environment;
  return xml;
}

std::uint32_t domain_of(const std::string& run) {
  const uLong checksum = crc32_z(0, reinterpret_cast<const Bytef*>(run.data()), run.size());
  return 1 + static_cast<std::uint32_t>(checksum) % domains;
}

std::vector<std::string> start_up_warnings() {
  std::vector<std::string> warnings;
  long rmem = 0;
  std::ifstream file("/proc/sys/net/core/rmem_max");
  if (file >> rmem && rmem < comfortable_rmem) {
    warnings.push_back(
        fmt::format("net.core.rmem_max is {}: interfaces of more than about 2000 points may lose packets and "
                    "wait 0.2 s for them; "
                    "as root: sysctl -w net.core.rmem_max=8388608",
                    rmem));
  }
  return warnings;
}

}  // namespace fsi::bus
