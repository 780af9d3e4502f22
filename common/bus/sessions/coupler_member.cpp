#include "common/bus/sessions/coupler_member.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/bus/peers/peer.hpp"
#include "common/core/failure.hpp"

namespace fsi::bus {

std::string label_of(const std::string& role, const std::string& name) {
  return role == name ? name : fmt::format("{} '{}'", role, name);
}

void Channel::hear(const wire::Waiting& word, std::uint64_t step, double repetition_s) {
  if (word.from != owner || word.topic != projected_topic) return;
  if (word.step == step) not_arrived.add(repetition_s);
  if (word.step < step) behind.add(repetition_s);
}

void Channel::judge(std::uint64_t step, double timeout_s, double waited_s) const {
  if (not_arrived.convincing(timeout_s))
    end_by(predicted_of(step), waited_s, "its sender waits for the answer");
  if (sent && behind.convincing(timeout_s))
    end_by(projected_of(sent->step), waited_s, "its receiver still asks for it");
}

std::vector<wire::Traffic> traffic_of(const std::deque<Member>& members) {
  std::vector<wire::Traffic> all;
  for (const Member& member : members) {
    for (const Channel& channel : member.channels)
      all.push_back(channel.heard.report(channel.interface, channel.owner));
  }
  return all;
}

void check_fits(const std::string& label, const wire::Hello& hello, const std::string& digest,
                const std::string& build) {
  if (hello.protocol != wire::protocol_version) {
    throw PeerLost(fmt::format("{} speaks protocol {}, the coupler speaks {}: build them from one version",
                               label, hello.protocol, wire::protocol_version));
  }
  if (hello.config_digest != digest) {
    throw PeerLost(fmt::format("{} read another case than the coupler (digest {}, not {})", label,
                               hello.config_digest, digest));
  }
  if (!build.empty() && !hello.build.empty() && hello.build != build) {
    throw Failure(
        ExitCode::user_mistake,
        fmt::format("{} on {} is {}, the coupler on {} is {}: they would not get the numbers of one machine; "
                    "start the same build on processors of one kind (FSI_MARCH)",
                    label, hello.host, hello.build, host_name(), build));
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
