/* The spring piston in plain C, as in any language: Cyclone DDS's C library, what idlc makes of idl/amp_fsi.idl, and the page
 * docs/bring_your_own_solid.md; nothing else of AMP-FSI. README.md says how to build and run it; bus.c is its seat at the bus.
 *
 *     wall |--/\/\/\--|######|
 *          |---[==]---|######|  gas        m q'' = F(t) - k q - c q' + (force of the gas),   F = push sin(pi t / 2)^2
 *                     |######| --> q
 */
#define _GNU_SOURCE
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bus.h"

enum { POINTS = 5, TEXT = 4096 }; /* the gas may have any other number of points */

static const char *case_file, *run_dir, *restart;
static char digest[64];                       /* of the case */
static double mass, stiffness, damping, push; /* of the whole piston */
static double face, bottom, top;              /* its face lies at x = face, from y = bottom to top */
static double thickness;                      /* from the face to its back: where its centre is */

/* All that the next steps depend on; the table is cut back to its length at a restart. */
static struct {
  double q, q_dot, q_old, q_older, q_dot_old, q_dot_older, a, mean_before, dt, dt_before;
  long table_length;
} piston;

/* --- the case: `fsi_case resolve` prints it as JSON */

static const char* after(const char* json, const char* key) {
  char quoted[TEXT];
  snprintf(quoted, sizeof quoted, "\"%s\":", key);
  const char* found = json ? strstr(json, quoted) : NULL;
  return found ? found + strlen(quoted) : NULL;
}

static double number(const char* json, const char* key) {
  const char* found = after(json, key);
  if (!found) bus_end(USER_MISTAKE, "solids.%s.data: write `%s: NUMBER`", seat.name, key);
  return strtod(found, NULL);
}

static void read_case(void) {
  static char json[1 << 20];
  setenv("CASE_FILE", case_file, 1);
  FILE* answer = popen("\"$AMP_FSI_BIN/fsi_case\" resolve \"$CASE_FILE\"", "r");
  if (!answer) bus_end(USER_MISTAKE, "fsi_case cannot be started");
  json[fread(json, 1, sizeof json - 1, answer)] = 0;
  if (pclose(answer) != 0) bus_end(USER_MISTAKE, "fsi_case does not take %s", case_file);
  if (sscanf(after(json, "digest"), " \"%63[0-9a-f]", digest) != 1)
    bus_end(USER_MISTAKE, "the case has no digest");
  char own[TEXT];
  snprintf(own, sizeof own, "\"name\": \"%s\"", seat.name);
  const char *solids = after(json, "solids"), *data = after(strstr(solids ? solids : "", own), "data");
  mass = number(data, "mass");
  stiffness = number(data, "stiffness");
  damping = number(data, "damping");
  push = number(data, "push");
  face = number(data, "face");
  bottom = number(data, "bottom");
  top = number(data, "top");
  thickness = number(data, "thickness");
  seat.peer_timeout = number(json, "peer_timeout");
  seat.join_timeout = number(json, "join_timeout");
}

/* --- the piston: docs/bring_your_own_solid.md, "a body with k degrees of freedom" */

static double leading, history_q, history_q_dot; /* of the backward difference of the last step */

static void difference(void) {
  const double r = piston.dt_before > 0 ? piston.dt / piston.dt_before : 0;
  leading = (1 + 2 * r) / (1 + r);
  history_q = (1 + r) * piston.q_old - r * r / (1 + r) * piston.q_older;
  history_q_dot = (1 + r) * piston.q_dot_old - r * r / (1 + r) * piston.q_dot_older;
}

/* To the end of a step, with the acceleration of the last two. */
static void predict(double dt) {
  piston.q_older = piston.q_old;
  piston.q_dot_older = piston.q_dot_old;
  piston.q_old = piston.q;
  piston.q_dot_old = piston.q_dot;
  piston.q += dt * (piston.q_dot + 0.5 * dt * piston.a);
  piston.q_dot += dt * piston.a;
  piston.dt_before = piston.dt;
  piston.dt = dt;
  difference();
}

/* The velocity at the end of the step is known now. */
static void correct(double velocity) {
  piston.q_dot = velocity;
  if (piston.dt == 0) return;
  piston.q = (history_q + piston.dt * velocity) / leading;
  const double mean = (velocity - piston.q_dot_old) / piston.dt;
  piston.a = mean;
  if (piston.dt_before > 0)
    piston.a += piston.dt / (piston.dt + piston.dt_before) * (mean - piston.mean_before);
  piston.mean_before = mean;
}

/* --- the exchange */

static amp_fsi_Numbers numbers(double* values, uint32_t count) {
  return (amp_fsi_Numbers){count, count, values, false};
}
static amp_fsi_Indices indices(int32_t* values, uint32_t count) {
  return (amp_fsi_Indices){count, count, values, false};
}

static double x_0[2 * POINTS], x[2 * POINTS], v[2 * POINTS], n[2 * POINTS];

static void say_hello(void) {
  for (int k = 0; k < POINTS; ++k) {
    x_0[k] = face;
    x_0[POINTS + k] = bottom + (top - bottom) * k / (POINTS - 1);
    n[k] = 1;
  }
  amp_fsi_InterfaceInfo own = {
      .name = (char*)seat.name, .dimension = 2, .x = numbers(x_0, 2 * POINTS), .n = numbers(n, 2 * POINTS)};
  amp_fsi_Hello hello = {.role = "solid",
                         .law = "spring and damper, in C",
                         .config_digest = digest,
                         .points = POINTS,
                         .build = "",
                         .interfaces = {1, 1, &own, false}};
  bus_say_hello(&hello);
}

/* The predicted state, and how it answers a load f: S q_dot = g + dt f, with one mode, N = 1 at every point. */
static amp_fsi_PredictedInterface state_at(uint64_t step, double t) {
  static int32_t zero[POINTS], point[POINTS] = {0, 1, 2, 3, 4};
  static double one[POINTS] = {1, 1, 1, 1, 1}, S, g;
  for (int k = 0; k < POINTS; ++k) {
    x[k] = x_0[k] + piston.q;
    x[POINTS + k] = x_0[POINTS + k];
    v[k] = piston.q_dot;
  }
  difference();
  const double F = push * pow(sin(M_PI * t / 2), 2), dt = piston.dt;
  S = leading * mass + dt * (damping + dt * stiffness / leading);
  g = mass * history_q_dot + dt * (F - stiffness * history_q / leading);
  return (amp_fsi_PredictedInterface){
      .step = step,
      .t = t,
      .proposed_dt = INFINITY,
      .dt_reason = "implicit",
      .x = numbers(x, 2 * POINTS),
      .v = numbers(v, 2 * POINTS),
      .modal = {.modes = 1,
                .S = {indices(zero, 1), indices(zero, 1), numbers(&S, 1)},
                .g = numbers(&g, 1),
                .N = {indices(zero, POINTS), indices(point, POINTS), numbers(one, POINTS)},
                .q_dot = numbers(&piston.q_dot, 1)}};
}

/* --- files */

/* In the set of `step`, under another name until it is whole. The table must be on the disk as far as the state says. */
static void save(uint64_t step, FILE* table) {
  char path[TEXT], whole[TEXT + 8];
  if (ferror(table) || fflush(table) != 0 || fsync(fileno(table)) != 0)
    bus_end(OUTPUT_FAILED, "cannot write the table: %s; check the free space", strerror(errno));
  piston.table_length = ftell(table);
  snprintf(path, sizeof path, "%s/checkpoints", run_dir);
  mkdir(path, 0777);
  snprintf(path, sizeof path, "%s/checkpoints/%08llu", run_dir, (unsigned long long)step);
  mkdir(path, 0777);
  snprintf(whole, sizeof whole, "%s/%s.state", path, seat.name);
  snprintf(path + strlen(path), sizeof path - strlen(path), "/%s.part", seat.name);
  FILE* file = fopen(path, "w");
  const bool written =
      file && fwrite(&piston, sizeof piston, 1, file) == 1 && fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (!written || fclose(file) != 0 || rename(path, whole) != 0)
    bus_end(OUTPUT_FAILED, "cannot write %s", whole);
}

/* Step and time of the set that the run goes on with. */
static void load(uint64_t* step, double* t) {
  char path[TEXT], manifest[TEXT] = "";
  snprintf(path, sizeof path, "%s/%s.state", restart, seat.name);
  FILE* file = fopen(path, "r");
  if (!file || fread(&piston, sizeof piston, 1, file) != 1)
    bus_end(USER_MISTAKE, "%s is no state of this program", path);
  fclose(file);
  snprintf(path, sizeof path, "%s/manifest.json", restart);
  file = fopen(path, "r");
  if (!file || fread(manifest, 1, sizeof manifest - 1, file) == 0)
    bus_end(USER_MISTAKE, "%s cannot be read", path);
  fclose(file);
  *step = (uint64_t)number(manifest, "step");
  *t = number(manifest, "t");
}

static FILE* open_table(void) {
  char path[TEXT];
  snprintf(path, sizeof path, "%s/forces_%s.csv", run_dir, seat.name);
  FILE* table = fopen(path, restart ? "r+" : "w");
  if (!table) bus_end(OUTPUT_FAILED, "cannot write %s", path);
  if (!restart)
    fputs(
        "t [time],force1 [force/depth],force2 [force/depth],power [power/depth],centre1 [length],centre2 "
        "[length],"
        "velocity1 [length/time],velocity2 [length/time]\n",
        table);
  else {
    struct stat found;
    if (fstat(fileno(table), &found) != 0) bus_end(OUTPUT_FAILED, "cannot read %s", path);
    if (found.st_size < piston.table_length)
      bus_end(
          OUTPUT_FAILED,
          "%s has %lld bytes, the checkpoint was written when it had %ld; put the whole table back, or begin "
          "the run anew",
          path, (long long)found.st_size, piston.table_length);
    if (ftruncate(fileno(table), piston.table_length) != 0 || fseek(table, 0, SEEK_END) != 0)
      bus_end(OUTPUT_FAILED, "cannot write %s", path);
  }
  return table;
}

/* --- the run */

static void step_until_stop(void) {
  uint64_t step = 0;
  double t = 0;
  amp_fsi_ProjectedInterface answer = {0};
  if (restart) load(&step, &t);
  FILE* table = open_table();
  for (;;) {
    amp_fsi_PredictedInterface state = state_at(step, t);
    bus_exchange(&state, &answer);
    correct(answer.q_dot._buffer[0]);
    const double force = (top - bottom) * answer.w_n._buffer[POINTS / 2];
    fprintf(table, "%.17g,%.17g,0,%.17g,%.17g,%.17g,%.17g,0\n", t, force, force * piston.q_dot,
            face - 0.5 * thickness + piston.q, 0.5 * (bottom + top), piston.q_dot);
    if (answer.stop) break;
    predict(answer.dt_next);
    t = answer.t_next;
    ++step;
    if (answer.write_checkpoint) save(step, table);
  }
  if (fclose(table) != 0) bus_end(OUTPUT_FAILED, "the table cannot be written");
}

int main(int argc, char** argv) {
  for (int k = 1; k + 1 < argc; k += 2) {
    if (strcmp(argv[k], "--case") == 0) case_file = argv[k + 1];
    if (strcmp(argv[k], "--run-dir") == 0) run_dir = argv[k + 1];
    if (strcmp(argv[k], "--run") == 0) seat.run = argv[k + 1];
    if (strcmp(argv[k], "--name") == 0) seat.name = argv[k + 1];
    if (strcmp(argv[k], "--restart") == 0) restart = argv[k + 1];
  }
  if (!case_file || !run_dir || !seat.run || !seat.name)
    bus_end(USER_MISTAKE, "needs --case, --run-dir, --run and --name");
  signal(SIGTERM, SIG_IGN); /* the coupler gets it too, and ends the run after a checkpoint */
  read_case();
  bus_join();
  say_hello();
  step_until_stop();
  bus_leave();
  return 0;
}
