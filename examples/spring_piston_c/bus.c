#define _GNU_SOURCE
#include "bus.h"

#include <dlfcn.h>
#include <errno.h>
#include <glob.h>
#include <libgen.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 4096, HOST = 256 };

struct seat seat;

static dds_entity_t participant, waitset, hello_writer, welcome_reader, predicted_writer, projected_reader,
    abort_reader, abort_writer, waiting_reader;
static int coupler_pid;              /* 0: not known, or on another machine */
static bool is_welcome, all_welcome; /* the coupler is here; everybody is */
static dds_time_t coupler_spoke;     /* last, or could not be expected to */

_Noreturn void bus_end(int code, const char* format, ...) {
  char text[TEXT];
  va_list rest;
  va_start(rest, format);
  vsnprintf(text, sizeof text, format, rest);
  va_end(rest);
  fprintf(stderr, "%s: %s\n", seat.name ? seat.name : "solid", text);
  if (abort_writer > 0) {
    amp_fsi_Abort word = {.run = (char*)seat.run, .from = (char*)seat.name, .exit_code = code, .what = text};
    word.place = (amp_fsi_Place){.step = -1, .t = NAN, .program = "", .interface_name = "", .grid = ""};
    dds_write(abort_writer, &word);
    dds_wait_for_acks(abort_writer, DDS_MSECS(300));
  }
  bus_leave();
  exit(code);
}

void bus_leave(void) {
  dds_delete(DDS_CYCLONEDDS_HANDLE);
}

/* Of Cyclone's own log; what it warns of while the participants find each other comes right by itself. */
static char last_line[TEXT];
static void keep(void* line, const dds_log_data_t* data) {
  snprintf(line, TEXT, "%.*s", (int)data->size, data->message);
}

static dds_entity_t made(dds_entity_t result, const char* what) {
  if (result < 0)
    bus_end(PEER_LOST, "cannot join run '%s': %s: %s; %s", seat.run, what, dds_strretcode(result), last_line);
  return result;
}

/* 1 + CRC-32 of the run's name mod 100. */
static uint32_t domain(void) {
  uint32_t crc = ~0u;
  for (const char* c = seat.run; *c; ++c) {
    crc ^= (unsigned char)*c;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return 1 + ~crc % 100;
}

static void open_domain(void) {
  char way[TEXT] = "name=\"lo\"", peers[TEXT] = "<Peer Address=\"127.0.0.1\"/>", xml[3 * TEXT];
  const char* network = getenv("AMP_FSI_NETWORK"); /* of several machines: "OWN,OTHER,.." */
  if (network && *network) {
    char *list = strdup(network), *rest = list, *address;
    for (*peers = 0; (address = strsep(&rest, ","));) {
      if (!*peers) snprintf(way, sizeof way, "address=\"%s\"", address);
      snprintf(peers + strlen(peers), sizeof peers - strlen(peers), "<Peer Address=\"%s\"/>", address);
    }
    free(list);
  }
  snprintf(xml, sizeof xml,
           "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface %s/></Interfaces>"
           "<AllowMulticast>false</AllowMulticast></General><Discovery><Tag>%s</Tag><Peers>%s</Peers>"
           "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>119</MaxAutoParticipantIndex>"
           "<LeaseDuration>%gs</LeaseDuration></Discovery></Domain></CycloneDDS>",
           way, seat.run, peers, fmax(10, 2 * seat.peer_timeout));
  made(dds_create_domain(domain(), xml), "domain");
}

/* A plugin of DDS Security lies beside Cyclone's library, or in a folder there. */
static void set_plugin(dds_qos_t* qos, const char* kind, const char* library, const char* function) {
  Dl_info dds;
  char folder[PATH_MAX], pattern[2 * PATH_MAX + TEXT], property[TEXT], value[TEXT];
  glob_t found = {0};
  if (dladdr((void*)dds_create_participant, &dds) == 0 || !realpath(dds.dli_fname, folder))
    bus_end(USER_MISTAKE, "where is libddsc.so?");
  const char* beside = dirname(folder);
  snprintf(pattern, sizeof pattern, "{%s,%s/libddsc*}/libdds_security_%s.so", beside, beside, library);
  if (glob(pattern, GLOB_BRACE | GLOB_NOMAGIC, NULL, &found) != 0 || access(found.gl_pathv[0], R_OK) != 0)
    bus_end(USER_MISTAKE, "there is no %s: packets cannot be signed (fsi run --no-security does without)",
            pattern);
  snprintf(property, sizeof property, "dds.sec.%s.library.path", kind);
  dds_qset_prop(qos, property, found.gl_pathv[0]);
  globfree(&found);
  for (int k = 0; k < 2; ++k) {
    const char* what = k == 0 ? "init" : "finalize";
    snprintf(property, sizeof property, "dds.sec.%s.library.%s", kind, what);
    snprintf(value, sizeof value, "%s_%s", what, function);
    dds_qset_prop(qos, property, value);
  }
}

/* The files of fsi_credentials, and the properties that name them. */
static const char* const credentials[][2] = {{"auth.identity_ca", "authority.pem"},
                                             {"access.permissions_ca", "authority.pem"},
                                             {"auth.identity_certificate", "certificate.pem"},
                                             {"auth.private_key", "private_key.pem"},
                                             {"access.governance", "governance.p7s"},
                                             {"access.permissions", "permissions.p7s"}};
enum { CREDENTIALS = sizeof credentials / sizeof *credentials };

static void set_credentials(dds_qos_t* qos, const char* folder) {
  char property[TEXT], value[TEXT];
  setenv("RUN", seat.run, 1);
  setenv("FOLDER", folder, 1);
  if (system("\"$AMP_FSI_BIN/fsi_credentials\" \"$RUN\" solid \"$FOLDER\"") != 0)
    bus_end(USER_MISTAKE, "no credentials");
  set_plugin(qos, "auth", "auth", "authentication");
  set_plugin(qos, "access", "ac", "access_control");
  set_plugin(qos, "crypto", "crypto", "crypto");
  for (int k = 0; k < CREDENTIALS; ++k) {
    snprintf(property, sizeof property, "dds.sec.%s", credentials[k][0]);
    snprintf(value, sizeof value, "file:%s/%s", folder, credentials[k][1]);
    dds_qset_prop(qos, property, value);
  }
}

/* Cyclone reads the credentials while it makes the participant; then they can go. */
static void create_participant(void) {
  const char* key = getenv("AMP_FSI_KEY");
  char folder[] = "/tmp/amp_fsi-XXXXXX", path[TEXT];
  const bool is_protected = key && *key;
  dds_qos_t* qos = dds_create_qos();
  if (is_protected && !mkdtemp(folder)) bus_end(USER_MISTAKE, "no folder for credentials");
  if (is_protected) set_credentials(qos, folder);
  const dds_entity_t result = dds_create_participant(domain(), qos, NULL);
  for (int k = 0; is_protected && k < CREDENTIALS; ++k) {
    snprintf(path, sizeof path, "%s/%s", folder, credentials[k][1]);
    unlink(path);
  }
  if (is_protected) rmdir(folder);
  dds_delete_qos(qos);
  participant = made(result, "participant");
}

/* `depth`: of the history; `kept`: samples for those who come late, 0: none. */
static dds_entity_t endpoint(bool writes, const char* topic, const dds_topic_descriptor_t* type, int depth,
                             int kept) {
  dds_qos_t* qos = dds_create_qos();
  const dds_entity_t at = made(dds_create_topic(participant, type, topic, NULL, NULL), topic);
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  dds_qset_durability(qos, kept ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (kept) dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, kept, -1, -1, -1);
  if (writes) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_MSECS(300));
  if (writes) dds_qset_writer_data_lifecycle(qos, false);
  const dds_entity_t result =
      made((writes ? dds_create_writer : dds_create_reader)(participant, at, qos, NULL), topic);
  dds_delete_qos(qos);
  if (!writes) dds_waitset_attach(waitset, made(dds_create_readcondition(result, DDS_ANY_STATE), topic), 0);
  return result;
}

/* amp_fsi/KIND/NAME/NAME: in a name `_` is doubled, and what is no letter or digit becomes _XX. */
static dds_entity_t own_endpoint(bool writes, const char* kind, const dds_topic_descriptor_t* type) {
  char part[TEXT] = "/", topic[3 * TEXT], *last = part + 1;
  for (const char* c = seat.name; *c && last < part + TEXT - 4; ++c) {
    const bool plain = (*c >= '0' && *c <= '9') || (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z');
    last += plain       ? sprintf(last, "%c", *c)
            : *c == '_' ? sprintf(last, "__")
                        : sprintf(last, "_%02X", (unsigned char)*c);
  }
  snprintf(topic, sizeof topic, "amp_fsi/%s%s%s", kind, part, part);
  return endpoint(writes, topic, type, 8, 0);
}

void bus_join(void) {
  dds_set_log_sink(keep, last_line);
  open_domain();
  create_participant();
  waitset = made(dds_create_waitset(participant), "waitset");
  hello_writer = endpoint(true, "amp_fsi/hello", &amp_fsi_Hello_desc, 1, 1);
  welcome_reader = endpoint(false, "amp_fsi/welcome", &amp_fsi_Welcome_desc, 64, 64);
  abort_reader = endpoint(false, "amp_fsi/abort", &amp_fsi_Abort_desc, 64, 64);
  waiting_reader = endpoint(false, "amp_fsi/waiting", &amp_fsi_Waiting_desc, 64, 0);
  abort_writer = endpoint(true, "amp_fsi/abort", &amp_fsi_Abort_desc, 64, 64);
  predicted_writer = own_endpoint(true, "predicted", &amp_fsi_PredictedInterface_desc);
  projected_reader = own_endpoint(false, "projected", &amp_fsi_ProjectedInterface_desc);
}

/* The next sample of this run into `sample`, if one has come; `run`: where it says whose it is. */
static bool take(dds_entity_t reader, void* sample, char* const* run) {
  dds_sample_info_t info;
  while (dds_take(reader, &sample, &info, 1, 1) > 0)
    if (info.valid_data && strcmp(*run, seat.run) == 0) return true;
  return false;
}

static void hear_welcome(void) {
  static amp_fsi_Welcome word;
  char host[HOST] = "";
  gethostname(host, sizeof host - 1);
  while (take(welcome_reader, &word, &word.run)) {
    if (word.protocol != amp_fsi_PROTOCOL_VERSION)
      bus_end(PEER_LOST, "the coupler speaks protocol %u, this program %u", word.protocol,
              amp_fsi_PROTOCOL_VERSION);
    coupler_pid = strcmp(host, word.host) == 0 ? word.pid : 0;
    is_welcome = true;
    coupler_spoke = dds_time();
    all_welcome = word.complete;
  }
}

static void hear_abort(void) {
  static amp_fsi_Abort word;
  while (take(abort_reader, &word, &word.run)) {
    if (strcmp(word.from, seat.name) == 0) continue;
    abort_writer = 0; /* the others know */
    bus_end(word.exit_code, "%s ended the run: %s", word.from, word.what);
  }
}

/* Who waits for long says so once a second. */
static void hear_waiting(void) {
  static amp_fsi_Waiting word;
  while (take(waiting_reader, &word, &word.run))
    if (strcmp(word.from, "coupler") == 0) coupler_spoke = dds_time();
}

/* Sleeps until a message comes, a tenth of a second at most, and looks around. */
static void look_around(void) {
  dds_liveliness_changed_status_t coupler = {0};
  dds_waitset_wait(waitset, NULL, 0, DDS_MSECS(100));
  hear_abort();
  hear_welcome();
  hear_waiting();
  if (!is_welcome) return;
  if (coupler_pid && kill(coupler_pid, 0) != 0 && errno == ESRCH) {
    dds_sleepfor(DDS_MSECS(300)); /* why it ended may have come since we looked */
    hear_abort();
    bus_end(PEER_LOST, "the coupler (pid %d) has died", coupler_pid);
  }
  dds_get_liveliness_changed_status(welcome_reader, &coupler);
  if (coupler.alive_count > 0) coupler_spoke = dds_time();
  if ((double)(dds_time() - coupler_spoke) > seat.peer_timeout * DDS_NSECS_IN_SEC)
    bus_end(PEER_LOST, "the coupler has been silent for %g s (time.peer_timeout)", seat.peer_timeout);
}

/* Whether a second has passed since `said`, which is now then. */
static bool time_to_repeat(dds_time_t* said) {
  if (dds_time() - *said < DDS_SECS(1)) return false;
  *said = dds_time();
  return true;
}

void bus_say_hello(amp_fsi_Hello* hello) {
  char host[HOST] = "";
  gethostname(host, sizeof host - 1);
  hello->protocol = amp_fsi_PROTOCOL_VERSION;
  hello->run = (char*)seat.run;
  hello->name = (char*)seat.name;
  hello->host = host;
  hello->pid = getpid();
  dds_publication_matched_status_t out = {0};
  dds_subscription_matched_status_t in = {0};
  dds_time_t said = 0;
  const dds_time_t begun = dds_time();
  while (!all_welcome || out.current_count == 0 || in.current_count == 0) {
    if (time_to_repeat(&said)) dds_write(hello_writer, hello);
    look_around();
    if (!is_welcome && (double)(dds_time() - begun) > (seat.join_timeout + 2) * DDS_NSECS_IN_SEC)
      bus_end(PEER_LOST, "the coupler is missing"); /* once it is there, it says who is missing */
    dds_get_publication_matched_status(predicted_writer, &out);
    dds_get_subscription_matched_status(projected_reader, &in);
  }
}

void bus_exchange(amp_fsi_PredictedInterface* state, amp_fsi_ProjectedInterface* answer) {
  state->run = (char*)seat.run;
  state->from = state->interface_name = (char*)seat.name;
  dds_write(predicted_writer, state);
  dds_time_t said = coupler_spoke = dds_time();
  for (;;) {
    while (take(projected_reader, answer, &answer->run))
      if (answer->step == state->step) return;
    look_around();
    if (time_to_repeat(&said)) dds_write(predicted_writer, state);
  }
}
