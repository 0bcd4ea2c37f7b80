#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "platform/win32.hpp"

namespace speculum {

namespace {

using win32::Handle;

std::atomic<bool> interruptFlag{false};
bool ownConsole = false;  // was opened for this process alone

HANDLE handleOf(intptr_t value) {
  return reinterpret_cast<HANDLE>(value);
}

// Returns the word as oneLine() prints it behind other text. Keeps its :: and ##, because runners find no command in
// what shellWord() returns.
std::string withoutHidden(const std::string& word) {
  std::string shown;
  for (size_t first = 0, end = 0; first < word.size(); first = end) {
    const size_t pair = word.find("##", first);
    end = pair == std::string::npos ? word.size() : pair + 1;
    shown += oneLine('.' + word.substr(first, end - first)).substr(1);
  }
  return shown;
}

// Quotes an argument as CommandLineToArgvW reads it: backslashes count only before a quote.
void appendQuoted(std::string& line, const std::string& argument) {
  line += line.empty() ? "\"" : " \"";
  size_t slashes = 0;
  for (const char c : argument) {
    line.append(c == '"' ? slashes + 1 : 0, '\\');
    slashes = c == '\\' ? slashes + 1 : 0;
    line += c;
  }
  line.append(slashes, '\\') += '"';
}

// Looks at the folders of PATH only: the system's own search begins in the working folder, which may hold anything.
std::filesystem::path findProgram(const std::string& name) {
  std::istringstream folders(environment("PATH"));
  for (std::string folder; std::getline(folders, folder, ';');) {
    const std::filesystem::path file = std::filesystem::path(folder) / (name + ".exe");
    if (!folder.empty() && isFile(file)) {
      return file;
    }
  }
  return {};
}

// A pipe of which the process that is started may inherit one end.
struct Pipe {
  Handle theirs;
  Handle ours;
};

Pipe pipeThatIs(bool readByUs, const std::string& program) {
  HANDLE reads = nullptr;
  HANDLE writes = nullptr;
  if (!::CreatePipe(&reads, &writes, nullptr, 0)) {
    throw std::runtime_error("no pipe could be made for " + program);
  }
  Pipe pipe{.theirs = Handle(readByUs ? writes : reads), .ours = Handle(readByUs ? reads : writes)};
  ::SetHandleInformation(pipe.theirs.get(), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  return pipe;
}

// Starts a program that inherits these handles and no others: another child that had them would keep the pipes open.
Handle start(const std::filesystem::path& program, std::wstring line, STARTUPINFOEXW& startup,
             std::vector<HANDLE> inherited) {
  SIZE_T size = 0;
  ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
  std::vector<std::byte> attributes(size);
  startup.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(attributes.data());
  PROCESS_INFORMATION process{};
  if (::InitializeProcThreadAttributeList(startup.lpAttributeList, 1, 0, &size)) {
    ::UpdateProcThreadAttribute(startup.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, inherited.data(),
                                inherited.size() * sizeof(HANDLE), nullptr, nullptr);
    ::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE,
                     EXTENDED_STARTUPINFO_PRESENT | CREATE_NO_WINDOW, nullptr, nullptr, &startup.StartupInfo, &process);
    ::DeleteProcThreadAttributeList(startup.lpAttributeList);
  }
  Handle(process.hThread).reset();
  return Handle(process.hProcess);
}

// Ctrl-C and the end of the console or session.
BOOL WINAPI requestInterrupt(DWORD event) {
  const bool first = !interruptFlag.exchange(true);
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) {
    ::Sleep(INFINITE);  // the process ends when this function returns, or a few seconds from now
  }
  return first ? TRUE : FALSE;
}

std::string registryText(const wchar_t* key, const wchar_t* value) {
  std::array<wchar_t, 256> text{};
  DWORD bytes = sizeof text;
  return ::RegGetValueW(HKEY_LOCAL_MACHINE, key, value, RRF_RT_REG_SZ, nullptr, text.data(), &bytes) == ERROR_SUCCESS
             ? win32::utf8(text.data())
             : "unknown";
}

struct NoMemory : std::bad_alloc {
  const char* what() const noexcept override {
    return "there is not enough memory (use smaller models, fewer or smaller textures, or a smaller --size)";
  }
};

}  // namespace

int ChildProcess::waitFor(intptr_t child) {
  const Handle process(handleOf(child));
  DWORD code = 0;
  ::WaitForSingleObject(process.get(), INFINITE);
  ::GetExitCodeProcess(process.get(), &code);
  // An exception that nobody handled is the exit code.
  constexpr int aborted = 6;  // SIGABRT elsewhere
  return code == STATUS_ACCESS_VIOLATION ? 128 + SIGSEGV : code >= 0xc0000000u ? 128 + aborted : static_cast<int>(code);
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, Input input) {
  const std::string& name = arguments.front();
  Pipe output = pipeThatIs(true, name);
  Pipe fed = input == Input::pipe ? pipeThatIs(false, name) : Pipe{};
  std::string line;
  for (const std::string& argument : arguments) {
    appendQuoted(line, argument);
  }
  STARTUPINFOEXW startup{.StartupInfo = {.cb = sizeof startup, .dwFlags = STARTF_USESTDHANDLES}};
  startup.StartupInfo.hStdInput = fed.theirs.get();
  startup.StartupInfo.hStdOutput = startup.StartupInfo.hStdError = output.theirs.get();
  std::vector<HANDLE> inherited{output.theirs.get()};
  if (fed.theirs) {
    inherited.push_back(fed.theirs.get());
  }
  const std::filesystem::path typed = name;
  const std::filesystem::path program = typed.has_parent_path() ? typed : findProgram(name);
  if (Handle child = program.empty() ? nullptr : start(program, win32::wide(line), startup, inherited)) {
    child_ = reinterpret_cast<intptr_t>(child.release());
  } else {
    result_ = {127, name + ": cannot be run"};
  }
  descriptor_ = reinterpret_cast<intptr_t>(output.ours.release());
  input_ = fed.ours ? reinterpret_cast<intptr_t>(fed.ours.release()) : -1;
}

ChildProcess::~ChildProcess() {
  if (child_ != 0) {
    kill();
    waitFor(child_);
  }
  closeInput();
  ::CloseHandle(handleOf(descriptor_));
}

bool ChildProcess::read() {
  std::array<char, 4096> block;
  DWORD count = 0;
  const bool more = ::ReadFile(handleOf(descriptor_), block.data(), block.size(), &count, nullptr) != 0;
  result_.output.append(block.data(), count);
  return more;
}

bool ChildProcess::readable(Clock::time_point end) {
  constexpr DWORD pause = 2;  // milliseconds; nothing can wait for an anonymous pipe
  DWORD waiting = 0;
  while (::PeekNamedPipe(handleOf(descriptor_), nullptr, 0, nullptr, &waiting, nullptr) && waiting == 0) {
    if (Clock::now() >= end) {
      return false;
    }
    ::Sleep(pause);
  }
  return true;
}

void ChildProcess::write(std::string_view text) {
  DWORD count = 0;
  while (!text.empty() &&
         ::WriteFile(handleOf(input_), text.data(), static_cast<DWORD>(text.size()), &count, nullptr)) {
    text.remove_prefix(count);
  }
}

void ChildProcess::closeInput() {
  if (input_ >= 0) {
    ::CloseHandle(handleOf(std::exchange(input_, -1)));
  }
}

void ChildProcess::kill() {
  if (child_ != 0) {
    ::TerminateProcess(handleOf(child_), 128 + 9);  // as SIGKILL leaves it
  }
}

// Within quotes cmd.exe still replaces %NAME%, and it ends quotes at a quote with a backslash before it, which programs
// take as a part of the word. Both characters stand outside of quotes, behind a caret: no variable has such a name. So
// does a second #, because runners act on ##.
std::string shellWord(const std::string& argument) {
  const std::string shown = withoutHidden(argument);
  const auto plain = [](unsigned char c) {
    return c < 0x80 &&
           (std::isalnum(c) || std::string_view("-_./\\:=+").find(static_cast<char>(c)) != std::string_view::npos);
  };
  if (!shown.empty() && std::ranges::all_of(shown, plain)) {
    return shown;
  }
  std::string word = "\"";
  size_t slashes = 0;  // before this character; before a quote each counts half
  for (size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    if (c == '"' || c == '%' || (c == '#' && i > 0 && shown[i - 1] == '#')) {
      word.append(std::exchange(slashes, 0), '\\');
      word += c == '"' ? "\"\\^\"\"" : std::string("\"^") + c + '"';
    } else {
      slashes = c == '\\' ? slashes + 1 : 0;
      word += c;
    }
  }
  return word.append(slashes, '\\') + '"';
}

std::vector<const char*> prepareProcess(int, const char* const*) {
  static std::vector<std::string> texts;
  int count = 0;
  wchar_t** const wides = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  for (int i = 0; i < count; ++i) {
    texts.push_back(win32::utf8(wides[i]));
  }
  ::LocalFree(wides);
  for (std::FILE* stream : {stdin, stdout, stderr}) {
    ::_setmode(::_fileno(stream), _O_BINARY);  // lines end as everywhere: scripts compare them
  }
  static const UINT codePage = ::GetConsoleOutputCP();
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit([] { ::SetConsoleOutputCP(codePage); });  // the console's other programs expect theirs
  DWORD process = 0;
  // A child of another program may have a hidden console, and write to pipes.
  ownConsole = ::GetConsoleProcessList(&process, 1) == 1 && isTerminal(1) && isTerminal(2);
  // Started by a double click, or with a file that was dropped on it.
  if (ownConsole && count <= 2) {
    ::FreeConsole();
    for (std::FILE* stream : {stdout, stderr}) {
      static_cast<void>(std::freopen("NUL", "w", stream));
    }
  }
  std::vector<const char*> arguments;
  for (const std::string& text : texts) {
    arguments.push_back(text.c_str());
  }
  return arguments;
}

void showFailure(const std::string& message) {
  if (ownConsole || ::GetFileType(::GetStdHandle(STD_ERROR_HANDLE)) == FILE_TYPE_UNKNOWN) {
    ::MessageBoxW(nullptr, win32::wide(message).c_str(), L"Speculum", MB_OK | MB_ICONERROR);
  }
}

const char* const renderDocLibrary = "renderdoc.dll";

void* loadedFunction(const char* library, const char* name) {
  const HMODULE loaded = ::GetModuleHandleW(win32::wide(library).c_str());
  return loaded ? reinterpret_cast<void*>(::GetProcAddress(loaded, name)) : nullptr;
}

// The C library keeps variables of its own beside the system's.
void setEnvironment(const std::string& name, const std::string& value) {
  ::_wputenv_s(win32::wide(name).c_str(), win32::wide(value).c_str());
}

std::string environment(const std::string& name) {
  const wchar_t* value = ::_wgetenv(win32::wide(name).c_str());
  return value ? win32::utf8(value) : "";
}

bool isTerminal(int fileDescriptor) {
  DWORD mode = 0;
  return ::GetConsoleMode(reinterpret_cast<HANDLE>(::_get_osfhandle(fileDescriptor)), &mode) != 0;
}

void installInterruptHandler() {
  ::SetConsoleCtrlHandler(&requestInterrupt, TRUE);
}

bool interruptRequested() {
  return interruptFlag;
}

// Windows has no signals for these: such writes fail anyway.
void letLargeWritesFail() {}
void letBrokenPipesFail() {}

std::string memoryLimitAdvice() {
  return {};
}

void explainLackOfMemory() {
  std::set_new_handler([] { throw NoMemory(); });
}

std::string machineDescription() {
  return registryText(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString") + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " threads, " +
         registryText(L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion", L"ProductName");
}

uint64_t peakResidentBytes() {
  PROCESS_MEMORY_COUNTERS counters{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters);
  return counters.PeakWorkingSetSize;
}

// The heap of Windows keeps what is freed by itself.
void keepFreedMemory() {}
void releaseFreedMemory() {}

}  // namespace speculum
