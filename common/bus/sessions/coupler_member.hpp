#pragma once
/// What the coupler knows of one solver: its hello, whether
/// it lives, and what goes in and out at its interfaces.

#include <fmt/format.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/lengths.hpp"
#include "common/bus/peers/newcomer.hpp"
#include "common/bus/peers/peer.hpp"
#include "common/bus/sessions/link.hpp"

namespace fsi::bus {

/// How a program is called in messages: fluid, solid 'beam'.
std::string label_of(const std::string& role, const std::string& name);

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

  LostMessage predicted_of(std::uint64_t step) const {
    return {
        .kind = "PredictedInterface", .from = owner, .to = "coupler", .topic = predicted_topic, .step = step};
  }
  LostMessage projected_of(std::uint64_t step) const {
    return {
        .kind = "ProjectedInterface", .from = "coupler", .to = owner, .topic = projected_topic, .step = step};
  }

  /// The owner waits: for the answer to a state that is not here, or to the one before.
  void hear(const wire::Waiting& word, std::uint64_t step, double repetition_s);
  /// @throws PeerLost a message of this channel is lost
  void judge(std::uint64_t step, double timeout_s, double waited_s) const;

  bool matched() const {
    const bool hears = reader.matched() > 0,
               is_heard = writer.matched() > 0;  // ask both: asking resets the wake-up
    return is_heard && hears;
  }

  std::string owner, interface;
  InterfaceSize size;
  std::string predicted_topic, projected_topic;
  Reader<amp_fsi_PredictedInterface> reader;
  Writer<amp_fsi_ProjectedInterface> writer;
  std::optional<wire::ProjectedInterface> sent;  ///< the last one, to be sent again
  Complaints not_arrived;  ///< the solver waits for the answer to a state that is not here
  Complaints behind;       ///< the solver lacks what was sent
  Heard heard;             ///< from the solver
};

/// One solver of the run.
struct Member {
  std::string label;
  Newcomer newcomer;
  wire::Hello hello = {};
  std::unique_ptr<Peer> peer = nullptr;  ///< null until its hello came
  std::deque<Channel> channels = {};
  std::size_t first_slot = 0;  ///< place of the first interface among all predicted states
};

/// What came in from everybody.
std::vector<wire::Traffic> traffic_of(const std::deque<Member>& members);

/// `digest` of the case and `build` of the coupler. @throws PeerLost the program speaks another protocol or has read
/// another case. @throws Failure it would compute other numbers (a mistake of the user's)
void check_fits(const std::string& label, const wire::Hello& hello, const std::string& digest,
                const std::string& build);

/// Who has not joined after `seconds`, in words.
std::string who_is_missing(const std::deque<Member>& members, const std::vector<std::string>& strangers,
                           double seconds);

}  // namespace fsi::bus
