#include "common/bus/sessions/coupler_session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "common/bus/convert.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/peers/peer.hpp"
#include "common/bus/sessions/coupler_member.hpp"
#include "common/bus/sessions/link.hpp"

namespace fsi::bus {

namespace {

/// Programs that nobody expects are named up to so many.
constexpr std::size_t most_strangers = 20;

}  // namespace

struct CouplerSession::Implementation {
  Implementation(BusOptions options, std::vector<Expected> expected, std::string config_digest)
      : link(std::move(options), "coupler", "coupler"),
        who(std::move(expected)),
        digest(std::move(config_digest)),
        welcome_writer(link.participant(), welcome_topic, Delivery::newest),
        hello_reader(link.participant(), hello_topic, Delivery::lasting),
        control_reader(link.participant(), control_topic, Delivery::lasting) {
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
      link.abort(failure);
      throw;
    }
  }

  void welcome(bool complete) {
    const std::string host = host_name();
    const amp_fsi_Welcome word{.protocol = wire::protocol_version,
                               .run = borrow(link.options().run),
                               .complete = complete,
                               .host = borrow(host),
                               .pid = getpid()};
    link.send(welcome_writer, welcome_topic, word);
  }

  void wait_for_all() {
    const auto start = Clock::now();
    link.begin_wait();
    while (!all_matched()) {
      link.sleep();
      drain();
      if (link.time_to_repeat()) welcome(false);
      check_counterparts();
      // Even who computes must join some day.
      bool late =
          since(start) > link.options().hello_timeout_s + clock_over_work * link.options().step_timeout_s;
      for (Member& member : members) late = is_late(member) || late;
      if (late) throw PeerLost(who_is_missing(members, strangers, since(start)));
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
      if (request.run == link.options().run) requests.push_back(std::move(request));
    });
    if (predicted.empty()) return;
    for (Member& member : members) {
      for (std::size_t k = 0; k < member.channels.size(); ++k) {
        Channel& channel = member.channels[k];
        channel.reader.take([&](const amp_fsi_PredictedInterface& sample, dds_time_t sent) {
          if (accept(channel, member.first_slot + k, sample))
            link.count(channel.heard, payload(predicted[member.first_slot + k]), sent);
          else
            link.count_dropped(channel.heard);
        });
      }
    }
  }

  void admit(wire::Hello hello) {
    const std::string label = label_of(hello.role, hello.name);
    const auto place = std::ranges::find(who, hello.name, &Expected::name);
    if (place == who.end() || place->role != hello.role) {
      const bool known = std::ranges::find(strangers, label) != strangers.end();
      if (!known && strangers.size() < most_strangers) strangers.push_back(label);
      return;
    }
    Member& member = members[static_cast<std::size_t>(place - who.begin())];
    if (member.peer) {
      if (member.hello.pid == hello.pid && member.hello.host == hello.host) return;
      throw Failure(ExitCode::user_mistake, fmt::format("two programs call themselves {} (pids {} and {})",
                                                        label, member.hello.pid, hello.pid));
    }
    check_fits(label, hello, digest, link.options().build);
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

  /// False: it is not the one that is awaited, or came before.
  bool accept(const Channel& channel, std::size_t slot, const amp_fsi_PredictedInterface& sample) {
    const bool ours = same(sample.run, link.options().run) && same(sample.from, channel.owner) &&
                      same(sample.interface_name, channel.interface);
    if (!ours || sample.step < awaited) return false;
    if (fresh[slot] && sample.step == predicted[slot].step) {  // sent again before it was taken
      if (!same_state(sample, predicted[slot])) {
        throw PeerLost(
            fmt::format("two different states of step {} came from {}: does another program speak in its "
                        "name? A protected run (README.md) cannot be falsified that way",
                        sample.step, channel.owner));
      }
      return false;
    }
    copy(sample, predicted[slot]);
    check_lengths(predicted[slot], channel.size);
    return fresh[slot] = true;
  }

  std::span<const wire::PredictedInterface> gather(std::uint64_t step) {
    expect(step);
    for (Member& member : members) {
      member.peer->begin_step();
      for (Channel& channel : member.channels) {
        channel.not_arrived.forget();
        channel.behind.forget();
      }
    }
    drain();
    link.begin_wait();
    while (std::ranges::find(fresh, false) != fresh.end()) {
      link.sleep();
      drain();
      if (link.time_to_check()) watch(step);
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

  /// Looks after those who have not delivered `step`: do they live, have they sent it, do they hear us?
  void watch(std::uint64_t step) {
    const std::vector<wire::Waiting> words = link.others_waiting();
    const bool time_to_repeat = link.time_to_repeat();
    for (Member& member : members) {
      for (std::size_t k = 0; k < member.channels.size(); ++k) {
        if (fresh[member.first_slot + k]) continue;
        Channel& channel = member.channels[k];
        check_peer(member, channel);
        member.peer->check_step(step, link.options().step_timeout_s);
        for (const wire::Waiting& word : words) channel.hear(word, step, link.repetition_s());
        if (time_to_repeat) repeat(channel, step);
        channel.judge(step, link.options().peer_timeout_s, link.waited_s());
      }
    }
  }

  /// Says what is missing, and what its sender heard last.
  void repeat(Channel& channel, std::uint64_t step) {
    link.say_waiting(channel.owner, channel.predicted_topic, step);
    if (channel.sent) {
      link.send(channel.writer, channel.projected_topic, borrow(*channel.sent));
    } else {
      welcome(true);
    }
    ++channel.heard.missing;
    ++link.counters().repeated;
  }

  void check_peer(Member& member, const Channel& channel) const {
    member.peer->check(channel.reader.matched(), channel.reader.alive(), link.options().peer_timeout_s);
  }

  void scatter(std::span<const wire::ProjectedInterface> projected) {
    scattered_at = Clock::now();
    for (const wire::ProjectedInterface& one : projected) {
      amp_fsi_ProjectedInterface sample = borrow(one);
      sample.run = borrow(link.options().run);
      Channel& channel = channel_of(one.to, one.interface);
      link.send(channel.writer, channel.projected_topic, sample);
      ++link.counters().messages;
      link.counters().bytes += payload(one);
    }
    for (const wire::ProjectedInterface& one :
         projected) {  // all are on their way: nobody waits for the copies
      Channel& channel = channel_of(one.to, one.interface);
      channel.sent = one;
      channel.sent->run = link.options().run;
    }
  }

  Channel& channel_of(const std::string& to, const std::string& interface) {
    for (Member& member : members) {
      for (Channel& channel : member.channels) {
        if (channel.owner == to && channel.interface == interface) return channel;
      }
    }
    throw Failure(ExitCode::internal_error,
                  fmt::format("bus: nobody called '{}' has an interface '{}'", to, interface));
  }

  void idle(double seconds) {
    const auto start = Clock::now();
    while (requests.empty() && since(start) < seconds) {
      link.sleep(seconds - since(start), "paused");
      drain();
      if (link.time_to_repeat()) link.say_waiting("", "", awaited);
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

void CouplerSession::publish(wire::Telemetry telemetry) {
  telemetry.traffic = traffic_of(implementation_->members);
  implementation_->link.publish(std::move(telemetry));
}

bool CouplerSession::picture_due() const {
  return implementation_->link.watchers().due();
}

bool CouplerSession::watched() const {
  return implementation_->link.watchers().any();
}

void CouplerSession::show(wire::Picture picture) {
  implementation_->link.watchers().begin_pause();
  implementation_->link.watchers().publish(std::move(picture));
}

void CouplerSession::abort(const Failure& failure) noexcept {
  implementation_->link.abort(failure);
}

void CouplerSession::leave() noexcept {
  if (implementation_) implementation_->leave();
  implementation_.reset();
}

Statistics CouplerSession::statistics() const {
  return implementation_->link.statistics();
}

}  // namespace fsi::bus
