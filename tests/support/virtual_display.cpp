#include "virtual_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "platform/files.hpp"
#include "test_paths.hpp"

extern char** environ;

namespace speculum::test {

namespace {

// Starts a child that ends with this process, however that ends.
pid_t start(std::vector<std::string> program) {
  std::vector<std::string> arguments = {"setpriv", "--pdeathsig", "TERM"};
  arguments.insert(arguments.end(), program.begin(), program.end());
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const int failure = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    throw std::runtime_error(program.front() + " cannot be started (is it installed?)");
  }
  return child;
}

// Repeats the signal, because openbox sometimes loses one that comes while it is idle.
void stop(pid_t child) {
  if (child <= 0) {
    return;
  }
  kill(child, SIGTERM);
  for (int i = 0; i < 200; ++i) {
    if (waitpid(child, nullptr, WNOHANG) == child) {
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

// Reads one line from a pipe; empty after a minute without one.
std::string readLine(int descriptor) {
  std::string line;
  pollfd ready{descriptor, POLLIN, 0};
  for (char c = 0; poll(&ready, 1, 60000) == 1 && read(descriptor, &c, 1) == 1 && c != '\n';) {
    line += c;
  }
  return line;
}

class Server {
 public:
  Server() {
    int ends[2];
    if (pipe(ends) != 0) {
      throw std::runtime_error("no pipe");
    }
    server_ = start(
        {"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1280x900x24", "-nolisten", "tcp", "-noreset"});
    close(ends[1]);
    const std::string number = readLine(ends[0]);
    close(ends[0]);
    if (number.empty()) {
      stop(server_);
      throw std::runtime_error("Xvfb did not start");
    }
    display_ = ":" + number;
    use();
    // A window that is mapped while the manager starts may wait for ever to be shown.
    const TemporaryDirectory directory;
    const std::filesystem::path ready = directory.path() / "ready";
    manager_ = start({"openbox", "--config-file", (sourceDir() / "tests" / "window" / "openbox.xml").string(),
                      "--startup", "touch " + ready.string()});
    for (int i = 0; i < 6000 && !std::filesystem::exists(ready); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  ~Server() {
    stop(manager_);
    stop(server_);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void use() const { setenv("DISPLAY", display_.c_str(), 1); }

 private:
  std::string display_;
  pid_t server_ = 0;
  pid_t manager_ = 0;
};

}  // namespace

VirtualDisplay::VirtualDisplay() {
  static const Server server;
  server.use();  // a test may have pointed elsewhere
}

}  // namespace speculum::test
