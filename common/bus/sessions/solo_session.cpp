#include "common/bus/sessions/solo_session.hpp"

#include "common/bus/convert.hpp"
#include "common/bus/sessions/link.hpp"

namespace fsi::bus {

struct SoloSession::Implementation {
  Implementation(BusOptions options, const std::string& role, const std::string& name)
      : link(std::move(options), role, name),
        control_reader(link.participant(), control_topic, Delivery::lasting) {
    link.waitset().attach(control_reader.condition());
  }

  void drain() {
    control_reader.take([&](const amp_fsi_Control& sample) {
      wire::Control request;
      copy(sample, request);
      if (request.run == link.options().run) requests.push_back(std::move(request));
    });
  }

  void idle(double seconds) {
    const auto start = Clock::now();
    for (drain(); requests.empty() && since(start) < seconds; drain())
      link.sleep(seconds - since(start), "paused");
  }

  Link link;
  Reader<amp_fsi_Control> control_reader;
  std::vector<wire::Control> requests;
};

SoloSession::SoloSession(BusOptions options, const std::string& role, const std::string& name)
    : implementation_(std::make_unique<Implementation>(std::move(options), role, name)) {}
SoloSession::SoloSession(SoloSession&&) noexcept = default;
SoloSession& SoloSession::operator=(SoloSession&&) noexcept = default;
SoloSession::~SoloSession() = default;

std::vector<wire::Control> SoloSession::controls() {
  implementation_->drain();
  return std::exchange(implementation_->requests, {});
}

void SoloSession::idle(double seconds) {
  implementation_->idle(seconds);
}

bool SoloSession::telemetry_due() const {
  return implementation_->link.telemetry_due();
}

void SoloSession::publish(const wire::Telemetry& telemetry) {
  implementation_->link.publish(telemetry);
}

bool SoloSession::picture_due() const {
  return implementation_->link.watchers().due();
}

void SoloSession::show(const Draw& draw, std::uint64_t step, bool always) {
  implementation_->link.watchers().show(draw, step, always);
}

void SoloSession::show_missing(const Draw& draw, std::uint64_t step) {
  implementation_->link.watchers().show_missing(draw, step);
}

void SoloSession::abort(const Failure& failure) noexcept {
  implementation_->link.abort(failure);
}

}  // namespace fsi::bus
