#include "process/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "ballflow/error.hpp"
#include "ballflow/text.hpp"
#include "process/start.hpp"

extern char** environ;

namespace ballflow {
namespace {

constexpr int channel_of_child = 3;
constexpr std::size_t most_printed = 1u << 20;  // held back; a child that floods loses the middle of it

[[noreturn]] void cannot_start(const std::string& program, int error) {
  throw Error(ExitCode::plugin, "cannot start " + printable(program) + ": " + std::strerror(error));
}

std::vector<std::string> with_defaults(const std::map<std::string, std::string>& defaults) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  for (const auto& [name, value] : defaults) {
    const bool said = std::any_of(all.begin(), all.end(),
                                  [&](const std::string& e) { return e.rfind(name + "=", 0) == 0; });
    if (!said) all.push_back(name + "=" + value);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// Everything that posix_spawnp is told.
class Start {
 public:
  Start(int channel, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, 1);
    posix_spawn_file_actions_adddup2(&actions_, output, 2);
    posix_spawn_file_actions_adddup2(&actions_, channel, channel_of_child);
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~Start() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  /// Sets errno and gives -1 where it fails.
  pid_t start(std::vector<std::string> arguments, std::vector<std::string> environment) {
    pid_t pid = -1;
    const int error = posix_spawnp(&pid, arguments[0].c_str(), &actions_, &attributes_,
                                   pointers(arguments).data(), pointers(environment).data());
    errno = error;
    return error == 0 ? pid : -1;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Child::Child(const ChildCommand& command) : owner_(::getpid()) {
  std::array<int, 2> sockets{}, pipe{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    cannot_start(command.arguments[0], errno);
  channel_ = Descriptor(sockets[0]);
  Descriptor theirs(sockets[1]);
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) cannot_start(command.arguments[0], errno);
  output_ = Descriptor(pipe[0]);
  Descriptor their_output(pipe[1]);
  ::fcntl(output_.get(), F_SETFL, O_NONBLOCK);
  // The numbers that the child is given are not to be among those it is given them from.
  for (Descriptor* end : {&theirs, &their_output}) {
    if (end->get() <= channel_of_child)
      *end = Descriptor(::fcntl(end->get(), F_DUPFD_CLOEXEC, channel_of_child + 1));
  }

  std::vector<std::string> arguments = command.arguments;
  arguments.push_back(std::to_string(::getpid()));
  int error = 0;
  pid_ = start_in_lasting_thread([&] {
    const pid_t pid =
        Start(theirs.get(), their_output.get()).start(arguments, with_defaults(command.environment));
    error = pid < 0 ? errno : 0;
    return pid;
  });
  if (pid_ < 0) cannot_start(command.arguments[0], error);
}

Child::~Child() { end(0); }

bool Child::send(std::string line, int file) {
  line += '\n';
  std::size_t sent = 0;
  while (sent < line.size()) {
    iovec piece{line.data() + sent, line.size() - sent};
    msghdr message{};
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    if (file >= 0 && sent == 0) {
      message.msg_control = control.data();
      message.msg_controllen = control.size();
      cmsghdr* const header = CMSG_FIRSTHDR(&message);
      header->cmsg_level = SOL_SOCKET;
      header->cmsg_type = SCM_RIGHTS;
      header->cmsg_len = CMSG_LEN(sizeof(int));
      std::memcpy(CMSG_DATA(header), &file, sizeof(int));
    }
    const ssize_t count = ::sendmsg(channel_.get(), &message, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

void Child::read_messages() {
  std::array<char, 65536> buffer;
  iovec piece{buffer.data(), buffer.size()};
  msghdr message{};
  message.msg_iov = &piece;
  message.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(16 * sizeof(int))> control{};
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t count = ::recvmsg(channel_.get(), &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (count < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK)) return;
  if (count <= 0) {
    closed_ = true;
    return;
  }
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t files = (header->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < files; ++i) {
      int file = -1;
      std::memcpy(&file, CMSG_DATA(header) + i * sizeof(int), sizeof(int));
      files_.emplace_back(file);
    }
  }
  text_.append(buffer.data(), static_cast<std::size_t>(count));
  for (std::size_t end = 0; (end = text_.find('\n')) != std::string::npos;) {
    lines_.push_back(text_.substr(0, end));
    text_.erase(0, end + 1);
  }
}

void Child::read_output() {
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t count = ::read(output_.get(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) output_.close();
    if (count <= 0) return;
    printed_.append(buffer.data(), static_cast<std::size_t>(count));
    if (printed_.size() > most_printed) printed_.erase(most_printed / 2, printed_.size() - most_printed);
  }
}

std::optional<std::string> Child::receive(int milliseconds) {
  if (lines_.empty() && !closed_) {
    std::array<pollfd, 2> events{{{channel_.get(), POLLIN, 0}, {output_.get(), POLLIN, 0}}};
    if (::poll(events.data(), output_.is_open() ? 2 : 1, milliseconds) > 0) {
      if (output_.is_open() && events[1].revents != 0) read_output();
      if (events[0].revents != 0) read_messages();
    }
  } else if (lines_.empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // it is about to end
  }
  if (lines_.empty()) return std::nullopt;
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  return line;
}

Descriptor Child::take_file() {
  if (files_.empty()) return {};
  Descriptor file = std::move(files_.front());
  files_.pop_front();
  return file;
}

std::vector<std::string> Child::printed(bool all) {
  if (output_.is_open()) read_output();
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = printed_.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(printed_.substr(begin, end - begin));
  printed_.erase(0, begin);
  if (all && !printed_.empty()) lines.push_back(std::exchange(printed_, {}));
  return lines;
}

bool Child::reap(bool wait) {
  if (reaped_ || pid_ < 0 || owner_ != ::getpid()) return true;
  siginfo_t info{};
  int failed = 0;
  do {
    failed = ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | (wait ? 0 : WNOHANG));
  } while (failed != 0 && errno == EINTR);
  if (failed == 0 && info.si_pid == 0) return false;
  // What it has started, while its number is still its own.
  ::kill(-pid_, SIGKILL);
  reaped_ = true;
  if (failed != 0 || ::waitpid(pid_, &status_, 0) < 0) status_ = 0;  // somebody else has waited for it
  return true;
}

bool Child::has_ended() {
  if (!reap(false)) return false;
  while (!closed_ && lines_.empty()) {
    const std::size_t before = text_.size() + files_.size();
    read_messages();
    if (lines_.empty() && text_.size() + files_.size() == before) break;
  }
  return lines_.empty();
}

std::string Child::how_it_ended() const {
  if (WIFSIGNALED(status_)) {
    const int signal = WTERMSIG(status_);
    return "was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  }
  return "ended with exit status " + std::to_string(WEXITSTATUS(status_));
}

void Child::end(int milliseconds) {
  if (pid_ < 0 || reap(false)) return;
  if (milliseconds > 0) {
    ::kill(-pid_, SIGTERM);
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    while (std::chrono::steady_clock::now() < until) {
      if (reap(false)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  ::kill(pid_, SIGKILL);
  reap(true);
}

}  // namespace ballflow
