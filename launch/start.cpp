/// fsi_start PARENT CORES PROGRAM [WORD ...]: becomes PROGRAM, which dies with the process PARENT, even if that is killed, and runs on
/// CORES ("0,2"; "-": on all). The launcher starts its programs by it: a step of its own between fork and exec would cost a copy of
/// its memory, and ten times the time.

#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace {

constexpr int user_mistake = 2, cannot_start = 127, parent_is_gone = 1;

void run_on(const char* cores) {
  if (std::strcmp(cores, "-") == 0) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const char* rest = cores; *rest != '\0'; rest += std::strspn(rest, ",")) {
    char* end = nullptr;
    CPU_SET(std::strtoul(rest, &end, 10), &set);
    if (end == rest) break;
    rest = end;
  }
  sched_setaffinity(0, sizeof set, &set);  // a hint: without it the program runs as well
}

void hear_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int one : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, one);
  sigprocmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: fsi_start PARENT CORES PROGRAM [WORD ...]\n");
    return user_mistake;
  }
  run_on(argv[2]);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != std::atol(argv[1])) return parent_is_gone;
  hear_signals();
  execvp(argv[3], argv + 3);
  std::fprintf(stderr, "fsi_start: %s: %s\n", argv[3], std::strerror(errno));
  return cannot_start;
}
