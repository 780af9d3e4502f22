#pragma once
/// How a message and the C structure that the IDL compiler made of it hold the same values: one list of pairs of members per
/// message (`Members`), for both directions. A new member of a message is one line here and there, and none besides.
///
///     ours                        the IDL's             outgoing       incoming
///     number, bool                the same              value          value
///     std::string                 char*                 borrowed       copied
///     std::vector<number>         sequence of numbers   borrowed       copied, into memory that is kept
///     structure with Members      structure             by its list    by its list
///     std::vector<structure>      sequence of those     `lent`         by its list
///
/// Only convert*.cpp include this.

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "common/bus/convert.hpp"

namespace fsi::bus {

/// The same value in both structures.
template <class Sample, class InSample, class Message, class InMessage>
struct MemberPair {
  InSample Sample::*in_sample;
  InMessage Message::*in_message;
};
template <class Sample, class InSample, class Message, class InMessage>
MemberPair(InSample Sample::*, InMessage Message::*) -> MemberPair<Sample, InSample, Message, InMessage>;

/// `list`: the pairs of a message; sequences of structures are none of them. `Sample`: its C structure.
template <class Message>
struct Members;

template <class Message>
concept HasMembers = requires { Members<Message>::list; };

/// Calls action(pair) for the members of a message.
template <class Message, class Action>
void each_member(const Action& action) {
  std::apply([&](const auto&... member) { (action(member), ...); }, Members<Message>::list);
}

// --- outgoing

/// DDS never writes through a borrowed pointer, but its C types know no const.
template <class Sequence, class Element>
Sequence borrowed(const std::vector<Element>& values) {
  Sequence sequence{};
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(values.size());
  sequence._buffer = const_cast<Element*>(values.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  sequence._release = false;
  return sequence;
}

template <class Number>
  requires std::is_arithmetic_v<Number>
void lend(const Number& from, Number& to) {
  to = from;
}

inline void lend(const std::string& from, char*& to) {
  to = borrow(from);
}

template <class Number, class Sequence>
  requires std::is_arithmetic_v<Number>
void lend(const std::vector<Number>& from, Sequence& to) {
  to = borrowed<Sequence>(from);
}

template <HasMembers Message>
void lend(const Message& from, typename Members<Message>::Sample& to) {
  each_member<Message>([&](const auto& member) { lend(from.*member.in_message, to.*member.in_sample); });
}

/// The C structure of a message; the rest of it, sequences of structures, is empty.
template <HasMembers Message>
typename Members<Message>::Sample lent(const Message& from) {
  typename Members<Message>::Sample to{};
  lend(from, to);
  return to;
}

/// C structures of many.
template <HasMembers Message>
std::vector<typename Members<Message>::Sample> lent(const std::vector<Message>& from) {
  std::vector<typename Members<Message>::Sample> to;
  to.reserve(from.size());
  for (const Message& one : from) to.push_back(lent(one));
  return to;
}

// --- incoming

template <class Number>
  requires std::is_arithmetic_v<Number>
void take(const Number& from, Number& to) {
  to = from;
}

inline void take(const char* from, std::string& to) {
  to = from == nullptr ? "" : from;
}

template <class Sequence, class Number>
  requires std::is_arithmetic_v<Number>
void take(const Sequence& from, std::vector<Number>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

template <HasMembers Message>
void take(const typename Members<Message>::Sample& from, Message& to) {
  each_member<Message>([&](const auto& member) { take(from.*member.in_sample, to.*member.in_message); });
}

/// A sequence of structures, or of strings.
template <class Sequence, class Element>
  requires HasMembers<Element> || std::is_same_v<Element, std::string>
void take(const Sequence& from, std::vector<Element>& to) {
  to.resize(from._length);
  for (std::uint32_t k = 0; k < from._length; ++k) take(from._buffer[k], to[k]);
}

// --- what several messages have

template <>
struct Members<wire::Health> {
  using Sample = amp_fsi_Health;
  using Ours = wire::Health;
  static constexpr std::tuple list{MemberPair{&Sample::min_rho, &Ours::min_rho},
                                   MemberPair{&Sample::min_p, &Ours::min_p},
                                   MemberPair{&Sample::min_det_F, &Ours::min_det_F},
                                   MemberPair{&Sample::min_cell_quality, &Ours::min_cell_quality},
                                   MemberPair{&Sample::first_order_fallbacks, &Ours::first_order_fallbacks},
                                   MemberPair{&Sample::floors, &Ours::floors}};
};

}  // namespace fsi::bus
