#include "common/bus/sessions/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "common/bus/convert.hpp"
#include "common/bus/dds.hpp"
#include "common/bus/lengths.hpp"
#include "common/bus/sessions/link.hpp"
#include "common/core/failure.hpp"

namespace fsi::bus {

namespace {

constexpr double participant_lease_s = 10;
/// Pictures that wait for `pictures`; more than programs of a run send between two looks.
constexpr std::size_t most_pictures = 256;

/// Returns when the request has arrived; `meanwhile` is called several times a second.
/// @throws PeerLost nobody takes it within `timeout_s`, and what `meanwhile` throws
void deliver(const wire::Control& request, const Entity& participant, double timeout_s,
             const std::function<void()>& meanwhile) {
  constexpr double slice_s = 0.1;
  Waitset waitset(participant);
  Writer<amp_fsi_Control> writer(participant, control_topic, Delivery::lasting);
  writer.announce_matches(waitset);
  const auto start = Clock::now();
  const auto over = [&] {
    if (meanwhile) meanwhile();
    return since(start) > timeout_s;
  };
  while (writer.matched() == 0) {
    if (over()) throw PeerLost(fmt::format("nobody of run '{}' takes requests; is it running?", request.run));
    waitset.wait(std::min(timeout_s, slice_s));
  }
  writer.write(borrow(request));
  while (!writer.arrived(std::min(timeout_s, slice_s))) {
    if (over())
      throw PeerLost(
          fmt::format("run '{}' did not take '{}' within {} s", request.run, request.command, timeout_s));
  }
}

}  // namespace

struct Listener::Implementation {
  Implementation(std::string run_id, const std::string& key, const std::string& network)
      : run(std::move(run_id)),
        domain(join_domain(run, participant_lease_s, network)),
        participant(create_participant(run, parse_key(key), "monitor")),
        waitset(participant),
        telemetry_reader(participant, telemetry_topic, Delivery::listening),
        abort_reader(participant, abort_topic, Delivery::lasting) {
    waitset.attach(telemetry_reader.condition());
    waitset.attach(abort_reader.condition());
  }

  std::vector<wire::Telemetry> wait(double seconds) {
    waitset.wait(seconds);
    std::vector<wire::Telemetry> heard;
    telemetry_reader.take([&](const amp_fsi_Telemetry& sample) {
      if (same(sample.run, run)) copy(sample, heard.emplace_back());
    });
    if (looking) looking->reader.take([&](const amp_fsi_Picture& sample) { see(sample); });
    abort_reader.take([&](const amp_fsi_Abort& sample) {
      if (same(sample.run, run) && !abort) copy(sample, abort.emplace());
    });
    return heard;
  }

  void see(const amp_fsi_Picture& sample) {
    if (!same(sample.run, run) || pictures.size() >= most_pictures) return;
    wire::Picture picture;
    copy(sample, picture);
    if (is_sound(picture)) pictures.push_back(std::move(picture));
  }

  void watch(const std::vector<std::string>& wishes) {
    if (!looking) {
      looking.emplace(participant);
      waitset.attach(looking->reader.condition());
    }
    const wire::Watch word{.run = run, .wishes = wishes};
    looking->writer.write(borrow(word).sample);
  }

  /// What it takes to see pictures; made when somebody looks.
  struct Looking {
    explicit Looking(const Entity& participant)
        : writer(participant, watch_topic, Delivery::asking),
          reader(participant, picture_topic, Delivery::listening) {}
    Writer<amp_fsi_Watch> writer;
    Reader<amp_fsi_Picture> reader;
  };

  std::string run;
  std::shared_ptr<const Entity> domain;
  Entity participant;
  Waitset waitset;
  Reader<amp_fsi_Telemetry> telemetry_reader;
  Reader<amp_fsi_Abort> abort_reader;
  std::optional<wire::Abort> abort;
  std::optional<Looking> looking;
  std::vector<wire::Picture> pictures;
};

Listener::Listener(const std::string& run, const std::string& key, const std::string& network)
    : implementation_(std::make_unique<Implementation>(run, key, network)) {}
Listener::Listener(Listener&&) noexcept = default;
Listener& Listener::operator=(Listener&&) noexcept = default;
Listener::~Listener() = default;

std::vector<wire::Telemetry> Listener::wait(double seconds) {
  return implementation_->wait(seconds);
}

void Listener::watch(const std::vector<std::string>& wishes) {
  implementation_->watch(wishes);
}

std::vector<wire::Picture> Listener::pictures() {
  return std::exchange(implementation_->pictures, {});
}

const std::optional<wire::Abort>& Listener::aborted() const {
  return implementation_->abort;
}

int Listener::programs() const {
  return implementation_->telemetry_reader.alive();
}

void Listener::request(Request request, double timeout_s) {
  deliver({.run = implementation_->run, .command = std::string(name_of(request))},
          implementation_->participant, timeout_s, {});
}

void send_control(const std::string& run, const std::string& key, Request request, double timeout_s,
                  const std::string& network, const std::function<void()>& meanwhile) {
  const auto domain = join_domain(run, participant_lease_s, network);
  const Entity participant = create_participant(run, parse_key(key), "control");
  deliver({.run = run, .command = std::string(name_of(request))}, participant, timeout_s, meanwhile);
}

}  // namespace fsi::bus
