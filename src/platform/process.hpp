#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

struct ProcessResult {
  int exitCode = -1;   // 127: not found; 128 + N: ended by signal N, or on Windows by the exception that stands for it
  std::string output;  // stdout and stderr, interleaved
};
// Runs a program found on PATH, without a shell. Blocks until it ends.
ProcessResult runProcess(const std::vector<std::string>& arguments);

// Returns the argument as it is typed into the system's shell, in quotes where it needs them: for sh, on Windows for
// cmd.exe. Control characters and marks of direction are escaped, since a terminal acts on them when they are pasted;
// cmd.exe has no notation for these, and takes the escapes as they stand.
std::string shellWord(const std::string& argument);

// Call it first in a program. Returns the arguments in UTF-8, which live as long as the process. On Windows, also makes
// the console take UTF-8, and leaves a console that was opened for this program alone, by a double click.
std::vector<const char*> prepareProcess(int argc, const char* const* argv);
// Shows the message that a program ends with in a box, if Windows has no console or file that takes it.
void showFailure(const std::string& message);

extern const char* const renderDocLibrary;  // file name on this system
// Returns a function of a library (its file name) that is loaded already; null if there is none.
void* loadedFunction(const char* library, const char* name);

// A program that runs beside this one. Destruction ends it.
class ChildProcess {
 public:
  enum class Input { inherited, pipe };  // Windows inherits no input

  explicit ChildProcess(const std::vector<std::string>& arguments, Input input = Input::inherited);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Waits until the program ends. Returns its exit code and the output that readLine() has not taken.
  ProcessResult wait();
  // Returns what wait() returns, without waiting: nothing while the program runs. Once wait() or poll() has returned a
  // result, call neither again.
  std::optional<ProcessResult> poll();

  // Takes a line from the output. Returns nothing if none comes within `seconds`, or if the program has ended: then
  // running() is false, and wait() has its exit code and the rest of its output.
  std::optional<std::string> readLine(double seconds);
  bool running() const { return child_ != 0; }
  // Writes to its Input::pipe. A program that has ended gets nothing.
  void write(std::string_view text);
  void closeInput();
  void kill();  // ends the program at once

 private:
  using Clock = std::chrono::steady_clock;

  bool readable(Clock::time_point end);   // waits until then for output, or the end of it
  bool read();                            // false at the end of the output
  std::optional<std::string> takeLine();  // of the output that was read
  static int waitFor(intptr_t child);     // returns its exit code

  // Process id and file descriptors, the input's that of a socket; on Windows handles.
  intptr_t child_ = 0;        // 0: there is none
  intptr_t descriptor_ = -1;  // of its output
  intptr_t input_ = -1;       // of what the program reads as its input; -1: none
  ProcessResult result_;
};

void setEnvironment(const std::string& name, const std::string& value);
std::string environment(const std::string& name);  // empty if not set
bool isTerminal(int fileDescriptor);

// Makes Ctrl-C, a closed terminal and a termination request only set a flag; a second Ctrl-C ends the process. A signal
// that was ignored at the start, as nohup and scripts do for what runs in the background, stays ignored.
void installInterruptHandler();
bool interruptRequested();

// Makes writes beyond the user's limit of file sizes fail, where a signal would end the process.
void letLargeWritesFail();
// Makes writes to pipes whose reader is gone fail, where a signal would end the process.
void letBrokenPipesFail();

std::string machineDescription();  // processor, its threads, operating system
uint64_t peakResidentBytes();      // of this process
double millisecondsSinceStart();   // of the program's code: without the time to load its libraries

// Keeps up to 64 MiB of freed memory a thread in the process. A Vulkan driver that draws on the CPU (lavapipe)
// allocates and frees the vertices of every draw; the C library would hand them back to the system each time and fault
// the same pages in again at the next draw. The user's own MALLOC_ variables take precedence.
void keepFreedMemory();

// Makes what() of each std::bad_alloc that operator new throws from now on say what would help. If the process's
// address space is limited, also turns an abort or fault into that line and exit code 2: drivers abort or fault where
// memory is short.
void explainLackOfMemory();
// Returns advice to raise the limit of the address space, as ` (...)`; an empty text if there is no limit.
std::string memoryLimitAdvice();

// Gives the memory that is freed so far back to the system. Takes some milliseconds.
void releaseFreedMemory();

}  // namespace speculum
