#include "plume/mesh/separate_process.h"

#include <fmt/format.h>
#include <stdio_ext.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <tuple>
#include <utility>

#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr int kNoMemory = 3;  // exit status of the other process
// Behind the result once the work has returned. A host that ignores SIGCHLD, or waits for any
// child, takes the exit status away.
constexpr std::uint64_t kWhole = 0x77686f6c65u;

[[noreturn]] void cannot_start(const char* call) {
  throw Error(fmt::format(
      "no process of its own can be started for what may crash ({}: {}); free memory or processes",
      call, std::strerror(errno)));
}

class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) cannot_start("memfd_create");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  /// The file's bytes, which outlive it.
  std::pair<std::span<const std::byte>, std::shared_ptr<const void>> contents() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) cannot_start("fstat");
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) return {};
    void* const bytes = mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor_, 0);
    if (bytes == MAP_FAILED) cannot_start("mmap");
    const std::shared_ptr<const void> held(
        bytes, [size](const void* mapped) { munmap(const_cast<void*>(mapped), size); });
    return {{static_cast<const std::byte*>(bytes), size}, held};
  }

 private:
  int descriptor_;
};

// The host's handlers and buffers are copied, too; none of them may act in its name.
void become_nobody(pid_t parent, int said) {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  std::set_terminate(std::abort);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  __fpurge(stdout);
  __fpurge(stderr);
  dup2(said, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
  std::setvbuf(stdout, nullptr, _IONBF, 0);  // what is said before a crash is not lost
}

// noexcept: an exception must not unwind into the copy of the host's callers.
[[noreturn]] void be_the_other(const std::function<void(ResultFile&)>& work, pid_t parent,
                               const MemoryFile& result, const MemoryFile& said,
                               const sigset_t& signals) noexcept {
  become_nobody(parent, said.descriptor());
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  ResultFile file(result.descriptor());
  work(file);
  file.write(std::as_bytes(std::span(&kWhole, 1)));
  _exit(EXIT_SUCCESS);
}

std::string failure_of(int status) {
  if (WIFEXITED(status)) {
    if (WEXITSTATUS(status) == kNoMemory) return "ran out of memory";
    return fmt::format("exited with status {}", WEXITSTATUS(status));
  }
  const int signal = WTERMSIG(status);
  if (signal == SIGABRT) return "aborted";
  return fmt::format("ended by signal {} ({}){}", signal, strsignal(signal),
                     signal == SIGKILL ? ", perhaps for lack of memory" : "");
}

}  // namespace

void ResultFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(kNoMemory);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

SeparateRun run_separately(const std::function<void(ResultFile&)>& work) {
  const MemoryFile result("plume-result"), said("plume-said");
  // Until the copy has its own handlers, no signal may find it with the host's.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid();
  const pid_t other = fork();
  if (other == 0) be_the_other(work, parent, result, said, before);
  const int fork_error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = fork_error;
  if (other < 0) cannot_start("fork");

  SeparateRun run;
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(other, &status, 0);
  while (ended < 0 && errno == EINTR);
  std::tie(run.result, run.keep_alive) = result.contents();
  std::uint64_t mark = 0;
  if (run.result.size() >= sizeof mark) {
    run.result = run.result.first(run.result.size() - sizeof mark);
    std::memcpy(&mark, run.result.data() + run.result.size(), sizeof mark);
  }
  if (mark != kWhole) {
    run.failure = ended == other ? failure_of(status) : "ended in an unknown way";
    run.result = {};
  }
  const auto text = said.contents();
  run.said.assign(reinterpret_cast<const char*>(text.first.data()), text.first.size());
  return run;
}

}  // namespace plume
