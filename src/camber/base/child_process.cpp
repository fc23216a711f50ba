#include <camber/base/child_process.hpp>
#include <camber/base/error.hpp>
#include <camber/base/progress.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

namespace camber {
namespace {

// What a child says before it ends: one of these, then message, where and remedy, each ended by 0.
constexpr char k_file = 'F', k_mesh = 'M', k_geometry = 'G', k_option = 'O';
constexpr int k_done = 0, k_told = 1;

/// Address space of this process [bytes]; the limit counts all of it.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void set_limits(const ChildLimits& limits) {
  const auto set = [](auto resource, rlim_t soft, rlim_t hard) {
    const rlimit limit{soft, hard};
    ::setrlimit(resource, &limit);
  };
  set(RLIMIT_CORE, 0, 0);
  if (limits.bytes > 0) {
    const rlim_t bytes = limits.bytes + address_space();
    set(RLIMIT_AS, bytes, bytes);
  }
  if (limits.seconds > 0) {
    const auto seconds = static_cast<rlim_t>(limits.seconds);
    set(RLIMIT_CPU, seconds, seconds + 1);
  }
}

void leave_the_terminal() {
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

void tell(int pipe, char kind, const std::string& what, const std::string& where,
          const std::string& remedy) {
  std::string text(1, kind);
  for (const std::string* part : {&what, &where, &remedy}) {
    text += *part;
    text += '\0';
  }
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t count = ::write(pipe, rest.data(), rest.size());
    if (count <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// The child's whole life. Leaves without destructors: they belong to the parent.
[[noreturn]] void live(int pipe, const std::string& subject, const ChildLimits& limits,
                       const std::function<void()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  leave_the_terminal();
  set_limits(limits);
  const auto told = [&](char kind, const Error& error) {
    tell(pipe, kind, error.message(), error.where(), error.remedy());
    ::_exit(k_told);
  };
  try {
    work();
    ::_exit(k_done);
  } catch (const MeshError& error) {
    told(k_mesh, error);
  } catch (const GeometryError& error) {
    told(k_geometry, error);
  } catch (const OptionError& error) {
    told(k_option, error);
  } catch (const Error& error) {
    told(k_file, error);
  } catch (const std::bad_alloc&) {
    tell(pipe, k_file, "reading it takes more memory than the limit of --isolate", subject,
         "raise --isolate-memory if you trust the file");
  } catch (const std::exception& error) {
    tell(pipe, k_file, fmt::format("cannot be read: {}", error.what()), subject,
         "save the file again");
  } catch (...) {
    tell(pipe, k_file, "cannot be read", subject, "save the file again");
  }
  ::_exit(k_told);
}

[[noreturn]] void throw_told(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 1; begin < text.size();) {
    const std::size_t end = std::min(text.find('\0', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.resize(3);
  if (!text.empty() && text.front() == k_mesh) throw MeshError(parts[0], parts[1], parts[2]);
  if (!text.empty() && text.front() == k_geometry) {
    throw GeometryError(parts[0], parts[1], parts[2]);
  }
  if (!text.empty() && text.front() == k_option) throw OptionError(parts[0], parts[1], parts[2]);
  throw FileError(parts[0], parts[1], parts[2]);
}

[[noreturn]] void throw_end(int status, const std::string& subject, const ChildLimits& limits) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw FileError(
        fmt::format("reading it takes more than {} s of processor time", limits.seconds), subject,
        "raise --isolate-time if you trust the file");
  }
  const std::string how = WIFSIGNALED(status) ? fmt::format("signal {}, {}", WTERMSIG(status),
                                                            ::strsignal(WTERMSIG(status)))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  throw FileError(fmt::format("reading it crashed a process of its own ({})", how), subject,
                  "the file is damaged or made to do harm, or it needs more memory than "
                  "--isolate-memory: save it again, or convert it with another program");
}

/// Calls again what a signal interrupted, unless it is to be cancelled, which ends the child.
template <class Call>
auto uninterrupted(pid_t child, const std::function<bool()>& cancelled, const Call& call) {
  while (true) {
    if (cancelled && cancelled()) {
      ::kill(child, SIGKILL);
      while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
      throw Cancelled{};
    }
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// Closes at the end of its life.
struct PipeEnd {
  int fd;
  ~PipeEnd() {
    if (fd >= 0) ::close(fd);
  }
};

}  // namespace

void try_in_child(const std::string& subject, const ChildLimits& limits,
                  const std::function<void()>& work, const std::function<bool()>& cancelled) {
  std::array<int, 2> ends{-1, -1};
  const bool has_pipe = ::pipe2(ends.data(), O_CLOEXEC) == 0;
  const PipeEnd reading{ends[0]};
  const pid_t child = has_pipe ? ::fork() : -1;
  if (child == 0) live(ends[1], subject, limits, work);
  const int reason = errno;
  if (ends[1] >= 0) ::close(ends[1]);
  if (child < 0) {
    throw FileError(
        "cannot be read in a process of its own: " + std::generic_category().message(reason),
        subject, "try again, or leave out --isolate");
  }
  std::string told;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t count = uninterrupted(
        child, cancelled, [&] { return ::read(reading.fd, buffer.data(), buffer.size()); });
    if (count <= 0) break;
    told.append(buffer.data(), static_cast<std::size_t>(count));
  }
  int status = 0;
  uninterrupted(child, cancelled, [&] { return ::waitpid(child, &status, 0); });
  if (WIFEXITED(status) && WEXITSTATUS(status) == k_done) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == k_told && !told.empty()) throw_told(told);
  throw_end(status, subject, limits);
}

}  // namespace camber
