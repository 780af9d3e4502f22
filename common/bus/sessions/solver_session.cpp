#include "common/bus/sessions/solver_session.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "common/bus/convert.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/peers/peer.hpp"
#include "common/bus/sessions/link.hpp"
#include "common/wire/request.hpp"

namespace fsi::bus {

namespace {

/// The coupler notices first who is missing and says so; only then does a solver give up on it [s].
constexpr double later_than_coupler_s = 2;
constexpr const char* coupler_name = "coupler";

/// One interface: what goes out and what comes in.
struct Channel {
  Channel(const Entity& participant, const wire::Hello& self, const wire::InterfaceInfo& info)
      : interface(info.name),
        size(size_of(info, self.name)),
        predicted_topic(topic_name("predicted", {self.name, info.name})),
        projected_topic(topic_name("projected", {self.name, info.name})),
        writer(participant, predicted_topic, Delivery::lock_step),
        reader(participant, projected_topic, Delivery::lock_step) {}

  bool matched() const {
    const bool is_heard = writer.matched() > 0,
               hears = reader.matched() > 0;  // ask both: asking resets the wake-up
    return is_heard && hears;
  }

  std::string interface;
  InterfaceSize size;
  std::string predicted_topic, projected_topic;
  Writer<amp_fsi_PredictedInterface> writer;
  Reader<amp_fsi_ProjectedInterface> reader;
  wire::ProjectedInterface incoming;
  bool fresh = false;             ///< `incoming` has not been handed out yet
  std::uint64_t awaited = 0;      ///< older steps are stale
  wire::PredictedInterface sent;  ///< the last one, to be sent again
  bool unanswered = false;
  Complaints not_arrived;  ///< the coupler lacks what was sent
  Complaints overtaken;    ///< the coupler waits for the step after it: its answer was lost
  Heard heard;             ///< from the coupler
};

}  // namespace

struct SolverSession::Implementation {
  Implementation(BusOptions options, wire::Hello hello)
      : self(std::move(hello)),
        link(std::move(options), self.role, self.name),
        hello_writer(link.participant(), hello_topic, Delivery::newest),
        control_writer(link.participant(), control_topic, Delivery::lasting),
        welcome_reader(link.participant(), welcome_topic, Delivery::lasting) {
    self.run = link.options().run;
    self.host = host_name();
    self.pid = getpid();
    self.build = link.options().build;
    link.waitset().attach(welcome_reader.condition());
    try {
      open_channels();
      say_hello();
      wait_for_welcome();
    } catch (const Failure& failure) {
      link.abort(failure);
      throw;
    }
  }

  void say_hello() { link.send(hello_writer, hello_topic, borrow(self).sample); }

  void open_channels() {
    for (const wire::InterfaceInfo& info : self.interfaces) {
      Channel& channel = channels.emplace_back(link.participant(), self, info);
      link.waitset().attach(channel.reader.condition());
      channel.reader.announce_matches(link.waitset());
      channel.writer.announce_matches(link.waitset());
    }
  }

  void wait_for_welcome() {
    auto start = Clock::now();
    link.begin_wait();
    while (!all_matched() || !complete || !coupler) {
      link.sleep();
      drain();
      check_counterparts();
      // It waits for our first state only when everybody is here: so that word is as good as its welcome.
      for (const wire::Waiting& word : link.others_waiting())
        complete = complete || (word.from == coupler_name && word.to == self.name);
      if (link.time_to_repeat()) say_hello();
      if (coupler && !complete &&
          link.time_to_check()) {  // it says who is missing: others may initialise for long
        coupler->check(welcome_reader.matched(), welcome_reader.alive(), link.options().peer_timeout_s);
        start = Clock::now();
      }
      if (since(start) > link.options().hello_timeout_s + later_than_coupler_s) {
        throw PeerLost(
            fmt::format("{} waited {:.0f} s (time.join_timeout) for run '{}' to begin, but the coupler {}",
                        self.name, since(start), self.run, coupler ? "cannot be heard" : "is missing"));
      }
    }
    for (const Channel& channel : channels) {
      channel.reader.ignore_matches();
      channel.writer.ignore_matches();
    }
  }

  bool all_matched() const {
    return std::ranges::count_if(channels, &Channel::matched) == std::ssize(channels);
  }

  void check_counterparts() const {
    check_compatible(hello_topic, hello_writer.incompatible_policy());
    check_compatible(welcome_topic, welcome_reader.incompatible_policy());
    for (const Channel& channel : channels) {
      check_compatible(channel.predicted_topic, channel.writer.incompatible_policy());
      check_compatible(channel.projected_topic, channel.reader.incompatible_policy());
    }
  }

  /// Takes in everything that has arrived.
  void drain() {
    welcome_reader.take([&](const amp_fsi_Welcome& sample) {
      if (!same(sample.run, self.run)) return;
      if (sample.protocol != self.protocol) {
        throw PeerLost(fmt::format("the coupler speaks protocol {}, {} speaks {}", sample.protocol, self.name,
                                   self.protocol));
      }
      if (!coupler) coupler = std::make_unique<Peer>("coupler", sample.host, sample.pid);
      complete = sample.complete;
    });
    for (Channel& channel : channels) {
      channel.reader.take(
          [&](const amp_fsi_ProjectedInterface& sample, dds_time_t sent) { accept(channel, sample, sent); });
    }
  }

  void accept(Channel& channel, const amp_fsi_ProjectedInterface& sample, dds_time_t sent) {
    const bool ours = same(sample.run, self.run) && same(sample.to, self.name) &&
                      same(sample.interface_name, channel.interface);
    if (!ours || sample.step < channel.awaited || channel.fresh) {  // fresh: sent again before it was taken
      link.count_dropped(channel.heard);
      return;
    }
    copy(sample, channel.incoming);
    check_lengths(channel.incoming, channel.size);
    channel.fresh = true;
    link.count(channel.heard, payload(channel.incoming), sent);
  }

  Channel& channel_of(const std::string& interface) {
    const auto found = std::ranges::find(channels, interface, &Channel::interface);
    if (found != channels.end()) return *found;
    throw Failure(ExitCode::internal_error,
                  fmt::format("bus: {} has no interface '{}' in its hello", self.name, interface));
  }

  /// Anything older than `step` is stale from now on, also what has already come in.
  void expect(Channel& channel, std::uint64_t step) {
    channel.awaited = step;
    if (!channel.fresh || channel.incoming.step >= step) return;
    channel.fresh = false;
    link.count_dropped(channel.heard);
  }

  void publish(const wire::PredictedInterface& predicted) {
    Channel& channel = channel_of(predicted.interface);
    amp_fsi_PredictedInterface sample = borrow(predicted);
    sample.run = borrow(self.run);
    sample.from = borrow(self.name);
    expect(channel, predicted.step);
    sent_at = Clock::now();
    coupler->spoke();  // it cannot be expected to have said more than it has
    link.send(channel.writer, channel.predicted_topic, sample);
    ++link.counters().messages;
    link.counters().bytes += payload(predicted);
    channel.sent = predicted;  // after it was sent: nobody waits for the copy
    channel.sent.run = self.run;
    channel.sent.from = self.name;
    channel.unanswered = true;
    channel.not_arrived.forget();
    channel.overtaken.forget();
  }

  const wire::ProjectedInterface& receive(const std::string& interface, std::uint64_t step) {
    Channel& channel = channel_of(interface);
    expect(channel, step);
    drain();
    link.begin_wait();
    while (!channel.fresh) {
      link.sleep();
      drain();
      if (!channel.fresh && link.time_to_check()) watch(channel, step);
    }
    if (channel.incoming.step != step) {
      throw PeerLost(fmt::format("the coupler answered step {} of interface '{}' while {} waited for step {}",
                                 channel.incoming.step, interface, self.name, step));
    }
    channel.fresh = channel.unanswered = false;
    channel.awaited = step + 1;
    if (sent_at) link.round_trips().add(since(*sent_at));
    sent_at.reset();
    return channel.incoming;
  }

  /// Looks around while the answer to `step` is missing: does the coupler live, and does it hear us?
  void watch(const Channel& missing, std::uint64_t step) {
    const double timeout = link.options().peer_timeout_s;
    try {
      coupler->check(welcome_reader.matched(), welcome_reader.alive(), timeout);
      coupler->check_endless(link.options().step_timeout_s);
    } catch (const PeerLost& lost) {
      throw PeerLost(fmt::format("{}; {} waited for its ProjectedInterface of step {} (topic '{}')",
                                 lost.what(), self.name, step, missing.projected_topic));
    }
    for (const wire::Waiting& word : link.others_waiting()) hear(word);
    if (link.time_to_repeat()) repeat();
    for (const Channel& channel : channels) judge(channel);
    if (coupler->rested(timeout))
      end_by(answer_to(missing, step), link.waited_s(), "the coupler waits too, and nothing it says arrives");
  }

  void hear(const wire::Waiting& word) {
    if (word.from != coupler_name) return;
    coupler->spoke();
    if (word.to != self.name) return;
    for (Channel& channel : channels) {
      if (word.topic != channel.predicted_topic || !channel.unanswered) continue;
      if (word.step == channel.sent.step) channel.not_arrived.add(link.repetition_s());
      if (word.step > channel.sent.step) channel.overtaken.add(link.repetition_s());
    }
  }

  /// What was sent and not answered, once more; and whose answer is missing.
  void repeat() {
    for (Channel& channel : channels) {
      if (!channel.unanswered || channel.fresh) continue;
      link.send(channel.writer, channel.predicted_topic, borrow(channel.sent));
      link.say_waiting(coupler_name, channel.projected_topic, channel.sent.step);
      ++channel.heard.missing;
      ++link.counters().repeated;
    }
  }

  void judge(const Channel& channel) const {
    const double timeout = link.options().peer_timeout_s;
    if (channel.not_arrived.convincing(timeout)) {
      end_by({.kind = "PredictedInterface",
              .from = self.name,
              .to = coupler_name,
              .topic = channel.predicted_topic,
              .step = channel.sent.step},
             link.waited_s(), "the coupler still asks for it");
    }
    if (channel.overtaken.convincing(timeout))
      end_by(answer_to(channel, channel.sent.step), link.waited_s(), "the coupler is ahead by a step");
  }

  LostMessage answer_to(const Channel& channel, std::uint64_t step) const {
    return {.kind = "ProjectedInterface",
            .from = coupler_name,
            .to = self.name,
            .topic = channel.projected_topic,
            .step = step};
  }

  std::vector<wire::Traffic> traffic() const {
    std::vector<wire::Traffic> all;
    for (const Channel& channel : channels)
      all.push_back(channel.heard.report(channel.interface, coupler_name));
    return all;
  }

  void leave() const {
    const auto start = Clock::now();
    link.wait_for_arrival(start, hello_writer);
    for (const Channel& channel : channels) link.wait_for_arrival(start, channel.writer);
  }

  wire::Hello self;
  Link link;
  Writer<amp_fsi_Hello> hello_writer;
  Writer<amp_fsi_Control> control_writer;
  Reader<amp_fsi_Welcome> welcome_reader;
  std::deque<Channel> channels;
  std::unique_ptr<Peer> coupler;  ///< null until its welcome came
  bool complete = false;
  std::optional<Clock::time_point> sent_at;  ///< last publish not answered yet
};

SolverSession::SolverSession(BusOptions options, wire::Hello self)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(self))) {}
SolverSession::SolverSession(SolverSession&&) noexcept = default;
SolverSession& SolverSession::operator=(SolverSession&&) noexcept = default;
SolverSession::~SolverSession() {
  leave();
}

void SolverSession::publish(const wire::PredictedInterface& predicted) {
  implementation_->publish(predicted);
}

const wire::ProjectedInterface& SolverSession::receive(const std::string& interface, std::uint64_t step) {
  return implementation_->receive(interface, step);
}

void SolverSession::ask_to_end() {
  const wire::Hello& self = implementation_->self;
  const wire::Control request{.run = self.run, .command = std::string(terminate_word) + self.name};
  implementation_->control_writer.write(borrow(request));
}

bool SolverSession::telemetry_due() const {
  return implementation_->link.telemetry_due();
}

void SolverSession::publish(wire::Telemetry telemetry) {
  telemetry.traffic = implementation_->traffic();
  implementation_->link.publish(std::move(telemetry));
}

void SolverSession::show(const Draw& draw, std::uint64_t step, bool always) {
  implementation_->link.watchers().show(draw, step, always);
}

bool SolverSession::waits_watched() const {
  return implementation_->link.watchers().any() && implementation_->link.waited_s() > Link::long_wait_s;
}

void SolverSession::show_missing(const Draw& draw, std::uint64_t step) {
  implementation_->link.watchers().show_missing(draw, step);
}

void SolverSession::abort(const Failure& failure) noexcept {
  implementation_->link.abort(failure);
}

void SolverSession::leave() noexcept {
  if (implementation_) implementation_->leave();
  implementation_.reset();
}

Statistics SolverSession::statistics() const {
  return implementation_->link.statistics();
}

}  // namespace fsi::bus
