#pragma once
/// Between the plain structures of common/wire and the generated IDL types.
///
/// Outgoing samples borrow: their strings and sequences point into the plain structure, so nothing is copied
/// before serialisation; the structure must outlive the sample. Incoming samples are copied into plain
/// structures whose vectors keep their memory from step to step.

#include <cstddef>
#include <string>
#include <vector>

#include "amp_fsi.h"
#include "common/wire/messages.hpp"

namespace fsi::bus {

/// A sample with sequences of structures, together with the memory those sequences point to.
template <class T, class Part>
struct Borrowed {
  T sample{};
  std::vector<Part> parts;
};

struct BorrowedTelemetry : Borrowed<amp_fsi_Telemetry, amp_fsi_InterfaceTelemetry> {
  std::vector<amp_fsi_Traffic> traffic;
  std::vector<amp_fsi_StepsLimited> limits;
};

Borrowed<amp_fsi_Hello, amp_fsi_InterfaceInfo> borrow(const wire::Hello& hello);
BorrowedTelemetry borrow(const wire::Telemetry& telemetry);
amp_fsi_PredictedInterface borrow(const wire::PredictedInterface& predicted);
amp_fsi_ProjectedInterface borrow(const wire::ProjectedInterface& projected);
amp_fsi_Abort borrow(const wire::Abort& abort);
amp_fsi_Control borrow(const wire::Control& control);
amp_fsi_Waiting borrow(const wire::Waiting& waiting);
Borrowed<amp_fsi_Watch, char*> borrow(const wire::Watch& watch);
Borrowed<amp_fsi_Picture, amp_fsi_PictureGrid> borrow(const wire::Picture& picture);
/// A string for an outgoing sample.
inline char* borrow(const std::string& text) {
  return const_cast<char*>(text.c_str());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

void copy(const amp_fsi_Hello& from, wire::Hello& to);
void copy(const amp_fsi_Telemetry& from, wire::Telemetry& to);
void copy(const amp_fsi_PredictedInterface& from, wire::PredictedInterface& to);
void copy(const amp_fsi_ProjectedInterface& from, wire::ProjectedInterface& to);
void copy(const amp_fsi_Abort& from, wire::Abort& to);
void copy(const amp_fsi_Control& from, wire::Control& to);
void copy(const amp_fsi_Waiting& from, wire::Waiting& to);
void copy(const amp_fsi_Watch& from, wire::Watch& to);
void copy(const amp_fsi_Picture& from, wire::Picture& to);

/// True when an incoming string is `text`.
bool same(const char* incoming, const std::string& text);

/// True when the arrays of motion and traction of an incoming state are those of `state`, bit by bit.
bool same_state(const amp_fsi_PredictedInterface& incoming, const wire::PredictedInterface& state);

/// Bytes of all arrays of a message.
std::size_t payload(const wire::PredictedInterface& predicted);
std::size_t payload(const wire::ProjectedInterface& projected);

}  // namespace fsi::bus
