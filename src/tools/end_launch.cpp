// Ends a launch when its work is done: stands before the command of a node that comes to an end,
// and sends roslaunch an interrupt then, as Ctrl-C does. A node that is `required` ends it too, but
// as an accident, with a red banner.
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

volatile std::sig_atomic_t told_to_end = 0;
pid_t child = -1;

// The command gets what this program is told.
void passOn(int signal) {
  told_to_end = 1;
  if (child > 0) kill(child, signal);
}

bool isRoslaunch(pid_t process) {
  std::string words;
  std::getline(std::ifstream("/proc/" + std::to_string(process) + "/cmdline"), words);
  return words.find("roslaunch") != std::string::npos;
}

int statusOf(int waited) {
  return WIFEXITED(waited) ? WEXITSTATUS(waited) : 128 + WTERMSIG(waited);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h") {
    std::fputs("usage: end_launch COMMAND...   as launch-prefix of a node\n", stdout);
    return argc < 2 ? 2 : 0;
  }
  const pid_t parent = getppid();
  child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    execvp(argv[1], argv + 1);
    std::perror(argv[1]);
    _exit(127);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, passOn);
  int waited = 0;
  while (waitpid(child, &waited, 0) < 0) continue;
  const int status = statusOf(waited);
  if (told_to_end != 0) return status;
  if (status != 0) std::fprintf(stderr, "%s ended with status %d\n", argv[1], status);
  if (isRoslaunch(parent)) kill(parent, SIGINT);
  return status;
}
