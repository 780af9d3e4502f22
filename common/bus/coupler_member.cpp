#include "common/bus/coupler_member.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/core/failure.hpp"

namespace fsi::bus {

std::string label_of(const std::string& role, const std::string& name) {
  return role == name ? name : fmt::format("{} '{}'", role, name);
}

void check_fits(const std::string& label, const wire::Hello& hello, const std::string& digest) {
  if (hello.protocol != wire::protocol_version) {
    throw PeerLost(fmt::format("{} speaks protocol {}, the coupler speaks {}: build them from one version",
                               label, hello.protocol, wire::protocol_version));
  }
  if (hello.config_digest != digest) {
    throw PeerLost(fmt::format("{} read another case than the coupler (digest {}, not {})", label,
                               hello.config_digest, digest));
  }
}

std::string who_is_missing(const std::deque<Member>& members, const std::vector<std::string>& strangers,
                           double seconds) {
  std::vector<std::string> missing, silent, here;
  for (const Member& member : members) {
    const bool matched = std::ranges::all_of(member.channels, &Channel::matched);
    (!member.peer ? missing : !matched ? silent : here).push_back(member.label);
  }
  std::string text = fmt::format("after {:.3g} s (time.join_timeout)", seconds);
  if (!missing.empty()) text += fmt::format(" {} did not join", fmt::join(missing, ", "));
  if (!silent.empty()) text += fmt::format(" {} joined but cannot be heard", fmt::join(silent, ", "));
  if (!here.empty()) text += fmt::format("; {} did", fmt::join(here, ", "));
  if (!strangers.empty()) text += fmt::format("; not expected: {}", fmt::join(strangers, ", "));
  return text;
}

}  // namespace fsi::bus
