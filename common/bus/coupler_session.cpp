#include "common/bus/coupler_session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "common/bus/convert.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/link.hpp"
#include "common/bus/newcomer.hpp"
#include "common/bus/peer.hpp"
#include "common/bus/seal.hpp"

namespace fsi::bus {

namespace {

std::string label_of(const std::string& role, const std::string& name) {
  return role == name ? name : fmt::format("{} '{}'", role, name);
}

/// One interface of one solver: what comes in and what goes out.
struct Channel {
  Channel(const Entity& participant, const std::string& owner_name, const wire::InterfaceInfo& info)
      : owner(owner_name),
        interface(info.name),
        size(size_of(info, owner_name)),
        predicted_topic(topic_name("predicted", {owner, interface})),
        projected_topic(topic_name("projected", {owner, interface})),
        reader(participant, predicted_topic, Delivery::lock_step),
        writer(participant, projected_topic, Delivery::lock_step) {}

  bool matched() const {
    const bool hears = reader.matched() > 0,
               heard = writer.matched() > 0;  // ask both: asking resets the wake-up
    return heard && hears;
  }

  std::string owner, interface;
  InterfaceSize size;
  std::string predicted_topic, projected_topic;
  Reader<amp_fsi_PredictedInterface> reader;
  Writer<amp_fsi_ProjectedInterface> writer;
};

/// One solver of the run.
struct Member {
  std::string label;
  Newcomer newcomer;
  wire::Hello hello;
  std::unique_ptr<Peer> peer;  ///< null until its hello came
  std::deque<Channel> channels;
  std::size_t first_slot = 0;  ///< place of the first interface among all predicted states
};

}  // namespace

struct CouplerSession::Implementation {
  Implementation(BusOptions options, std::vector<Expected> expected, std::string config_digest)
      : link(std::move(options), "coupler", "coupler"),
        who(std::move(expected)),
        digest(std::move(config_digest)),
        welcome_writer(link.participant(), welcome_topic, Delivery::lasting),
        hello_reader(link.participant(), hello_topic, Delivery::lasting),
        control_reader(link.participant(), control_topic, Delivery::lasting),
        gatekeeper(link.options().run, link.options().key) {
    link.waitset().attach(hello_reader.condition());
    link.waitset().attach(control_reader.condition());
    for (const Expected& one : who) {
      const auto pid = link.options().pids.find(one.name);
      const std::string label = label_of(one.role, one.name);
      members.push_back(
          {.label = label, .newcomer = {label, pid == link.options().pids.end() ? 0 : pid->second}});
    }
    try {
      welcome(false);
      wait_for_all();
      welcome(true);
    } catch (const Failure& failure) {
      link.abort(failure.code(), failure.what());
      throw;
    }
  }

  void welcome(bool complete) {
    const std::string host = host_name();
    welcome_writer.write({.protocol = wire::protocol_version,
                          .run = borrow(link.options().run),
                          .complete = complete,
                          .host = borrow(host),
                          .pid = getpid()});
  }

  void wait_for_all() {
    const auto start = Clock::now();
    while (!all_matched()) {
      link.sleep();
      drain();
      check_counterparts();
      // Even who computes must join some day.
      bool late =
          since(start) > link.options().hello_timeout_s + clock_over_work * link.options().step_timeout_s;
      for (Member& member : members) late = is_late(member) || late;
      if (late) throw PeerLost(who_is_missing(since(start)));
    }
    for (const Member& member : members) {
      for (const Channel& channel : member.channels) {
        channel.reader.ignore_matches();
        channel.writer.ignore_matches();
      }
    }
    number_slots();
  }

  bool is_late(Member& member) const {
    if (member.peer) member.peer->check_process();
    member.newcomer.look();
    return member.newcomer.idle_s() > link.options().hello_timeout_s &&
           !(member.peer && std::ranges::all_of(member.channels, &Channel::matched));
  }

  bool all_matched() const {
    return std::ranges::all_of(members, [](const Member& member) {
      return member.peer &&
             std::ranges::count_if(member.channels, &Channel::matched) == std::ssize(member.channels);
    });
  }

  void check_counterparts() const {
    check_compatible(hello_topic, hello_reader.incompatible_policy());
    check_compatible(welcome_topic, welcome_writer.incompatible_policy());
    for (const Member& member : members) {
      for (const Channel& channel : member.channels) {
        check_compatible(channel.predicted_topic, channel.reader.incompatible_policy());
        check_compatible(channel.projected_topic, channel.writer.incompatible_policy());
      }
    }
  }

  std::string who_is_missing(double seconds) const {
    Attendance now{.strangers = strangers};
    for (const Member& member : members) {
      const bool matched = std::ranges::all_of(member.channels, &Channel::matched);
      (!member.peer ? now.missing : !matched ? now.silent : now.here).push_back(member.label);
    }
    return describe(now, seconds);
  }

  void number_slots() {
    std::size_t slots = 0;
    for (Member& member : members) {
      member.first_slot = slots;
      slots += member.channels.size();
      all_hellos.push_back(member.hello);
    }
    predicted.resize(slots);
    fresh.assign(slots, false);
  }

  /// Takes in everything that has arrived.
  void drain() {
    hello_reader.take([&](const amp_fsi_Hello& sample) {
      wire::Hello hello;
      copy(sample, hello);
      if (hello.run == link.options().run) admit(std::move(hello));
    });
    control_reader.take([&](const amp_fsi_Control& sample) {
      wire::Control request;
      copy(sample, request);
      if (gatekeeper.lets_in(request)) requests.push_back(std::move(request));
    });
    if (predicted.empty()) return;
    for (Member& member : members) {
      for (std::size_t k = 0; k < member.channels.size(); ++k) {
        member.channels[k].reader.take([&](const amp_fsi_PredictedInterface& sample) {
          accept(member.channels[k], member.first_slot + k, sample);
        });
      }
    }
  }

  void admit(wire::Hello hello) {
    const std::string label = label_of(hello.role, hello.name);
    const auto place = std::ranges::find(who, hello.name, &Expected::name);
    if (place == who.end() || place->role != hello.role) {
      strangers.push_back(label);
      return;
    }
    Member& member = members[static_cast<std::size_t>(place - who.begin())];
    if (member.peer) {
      if (member.hello.pid == hello.pid && member.hello.host == hello.host) return;
      throw Failure(ExitCode::user_mistake, fmt::format("two programs call themselves {} (pids {} and {})",
                                                        label, member.hello.pid, hello.pid));
    }
    check_fits(label, hello);
    member.peer = std::make_unique<Peer>(label, hello.host, hello.pid);
    member.newcomer.joined();
    for (const wire::InterfaceInfo& info : hello.interfaces) {
      Channel& channel = member.channels.emplace_back(link.participant(), hello.name, info);
      link.waitset().attach(channel.reader.condition());
      channel.reader.announce_matches(link.waitset());
      channel.writer.announce_matches(link.waitset());
    }
    member.hello = std::move(hello);
  }

  void check_fits(const std::string& label, const wire::Hello& hello) const {
    if (hello.protocol != wire::protocol_version) {
      throw PeerLost(fmt::format("{} speaks protocol {}, the coupler speaks {}: build them from one version",
                                 label, hello.protocol, wire::protocol_version));
    }
    if (hello.config_digest != digest) {
      throw PeerLost(fmt::format("{} read another case than the coupler (digest {}, not {})", label,
                                 hello.config_digest, digest));
    }
  }

  void accept(const Channel& channel, std::size_t slot, const amp_fsi_PredictedInterface& sample) {
    const bool ours = same(sample.run, link.options().run) && same(sample.from, channel.owner) &&
                      same(sample.interface_name, channel.interface);
    if (!ours || sample.step < awaited) {
      ++link.counters().stale;
      return;
    }
    copy(sample, predicted[slot]);
    check_lengths(predicted[slot], channel.size);
    fresh[slot] = true;
    ++link.counters().messages;
    link.counters().bytes += payload(predicted[slot]);
  }

  std::span<const wire::PredictedInterface> gather(std::uint64_t step) {
    expect(step);
    for (const Member& member : members) member.peer->begin_step();
    drain();
    while (std::ranges::find(fresh, false) != fresh.end()) {
      link.sleep();
      drain();
      if (link.time_to_check()) check_peers(step);
    }
    for (const Member& member : members) member.peer->end_step();
    for (const wire::PredictedInterface& one : predicted) {
      if (one.step != step) {
        throw PeerLost(
            fmt::format("{} sent step {} while the coupler waited for step {}", one.from, one.step, step));
      }
    }
    fresh.assign(fresh.size(), false);
    awaited = step + 1;
    if (scattered_at) link.round_trips().add(since(*scattered_at));
    scattered_at.reset();
    return predicted;
  }

  /// Anything older than `step` is stale from now on, also what has already come in.
  void expect(std::uint64_t step) {
    awaited = step;
    for (std::size_t slot = 0; slot < fresh.size(); ++slot) {
      if (!fresh[slot] || predicted[slot].step >= step) continue;
      fresh[slot] = false;
      ++link.counters().stale;
    }
  }

  /// Looks after those who have not delivered `step`.
  void check_peers(std::uint64_t step) {
    for (Member& member : members) {
      for (std::size_t k = 0; k < member.channels.size(); ++k) {
        if (fresh[member.first_slot + k]) continue;
        check_peer(member, member.channels[k]);
        member.peer->check_step(step, link.options().step_timeout_s);
      }
    }
  }

  void check_peer(Member& member, const Channel& channel) const {
    member.peer->check(channel.reader.matched(), channel.reader.alive(), link.options().peer_timeout_s);
  }

  void scatter(std::span<const wire::ProjectedInterface> projected) {
    scattered_at = Clock::now();
    for (const wire::ProjectedInterface& one : projected) {
      amp_fsi_ProjectedInterface sample = borrow(one);
      sample.run = borrow(link.options().run);
      channel_of(one.to, one.interface).writer.write(sample);
      ++link.counters().messages;
      link.counters().bytes += payload(one);
    }
  }

  Channel& channel_of(const std::string& to, const std::string& interface) {
    for (Member& member : members) {
      for (Channel& channel : member.channels) {
        if (channel.owner == to && channel.interface == interface) return channel;
      }
    }
    throw Failure(ExitCode::expectation_missed,
                  fmt::format("bus: nobody called '{}' has an interface '{}'", to, interface));
  }

  void idle(double seconds) {
    const auto start = Clock::now();
    while (requests.empty() && since(start) < seconds) {
      link.sleep(seconds - since(start), "paused");
      drain();
      if (!link.time_to_check()) continue;
      for (Member& member : members) {
        for (const Channel& channel : member.channels) check_peer(member, channel);
      }
    }
  }

  void leave() const {
    const auto start = Clock::now();
    link.wait_for_arrival(start, welcome_writer);
    for (const Member& member : members) {
      for (const Channel& channel : member.channels) link.wait_for_arrival(start, channel.writer);
    }
  }

  Link link;
  std::vector<Expected> who;
  std::string digest;
  Writer<amp_fsi_Welcome> welcome_writer;
  Reader<amp_fsi_Hello> hello_reader;
  Reader<amp_fsi_Control> control_reader;
  Gatekeeper gatekeeper;
  std::deque<Member> members;  ///< in the order of `who`
  std::vector<std::string> strangers;
  std::vector<wire::Hello> all_hellos;
  std::vector<wire::PredictedInterface> predicted;  ///< per member and interface
  std::vector<bool> fresh;                          ///< arrived since the last gather
  std::uint64_t awaited = 0;                        ///< older steps are stale
  std::vector<wire::Control> requests;
  std::optional<Clock::time_point> scattered_at;
};

CouplerSession::CouplerSession(BusOptions options, std::vector<Expected> who,
                               const std::string& config_digest)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(who), config_digest)) {}
CouplerSession::CouplerSession(CouplerSession&&) noexcept = default;
CouplerSession& CouplerSession::operator=(CouplerSession&&) noexcept = default;
CouplerSession::~CouplerSession() {
  leave();
}

const std::vector<wire::Hello>& CouplerSession::hellos() const {
  return implementation_->all_hellos;
}

std::span<const wire::PredictedInterface> CouplerSession::gather(std::uint64_t step) {
  return implementation_->gather(step);
}

void CouplerSession::scatter(std::span<const wire::ProjectedInterface> projected) {
  implementation_->scatter(projected);
}

std::vector<wire::Control> CouplerSession::controls() {
  implementation_->drain();
  return std::exchange(implementation_->requests, {});
}

void CouplerSession::idle(double seconds) {
  implementation_->idle(seconds);
}

bool CouplerSession::telemetry_due() const {
  return implementation_->link.telemetry_due();
}

void CouplerSession::publish(const wire::Telemetry& telemetry) {
  implementation_->link.publish(telemetry);
}

void CouplerSession::abort(ExitCode code, const std::string& reason) noexcept {
  implementation_->link.abort(code, reason);
}

void CouplerSession::leave() noexcept {
  if (implementation_) implementation_->leave();
  implementation_.reset();
}

Statistics CouplerSession::statistics() const {
  return implementation_->link.statistics();
}

}  // namespace fsi::bus
