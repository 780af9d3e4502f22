#pragma once
/* A seat at the bus for a solid with one interface: what docs/bring_your_own_solid.md asks of a program in another language,
 * for any such program. Every call that waits ends the program when the run is over or the coupler is lost. */

#include <dds/dds.h>

#include "amp_fsi.h"

enum { USER_MISTAKE = 2, PEER_LOST = 4, OUTPUT_FAILED = 5 };

/* What the command line and the case say; to be set before anything else. */
struct seat {
  const char *run, *name;
  double peer_timeout, join_timeout; /* `time.` of the case [s] */
};
extern struct seat seat;

/* Joins the run, by the key and the programs that the environment names. */
void bus_join(void);
/* Says hello until everybody is there. Protocol, run, name, host and pid are filled in. */
void bus_say_hello(amp_fsi_Hello* hello);
/* Sends the predicted state and waits for its answer. Run, name and interface are filled in. */
void bus_exchange(amp_fsi_PredictedInterface* state, amp_fsi_ProjectedInterface* answer);
/* Leaves gracefully. */
void bus_leave(void);
/* One line on standard error, an Abort to all others, and the end. */
_Noreturn void bus_end(int code, const char* format, ...);
