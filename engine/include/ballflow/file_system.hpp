// The side effects of the store: the few system calls it makes. A test derives from FileSystem to count
// calls, to fill the disk, to take a feature away or to turn the clock.
//
// Everything is relative to an open folder, as in openat(2): once the store has checked its root, nobody can
// slip another folder under its path. Results are >= 0 or a negative errno value; EINTR is never returned.
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ballflow {

/// Where a file system is attached.
struct Mount {
  std::string type;     // "nfs4"; empty when nothing is known
  std::string point;    // "/scratch"
  std::string options;  // of the mount and of its file system: "rw,noatime,vers=4.2,local_lock=none"
};

class FileSystem {
 public:
  FileSystem() = default;
  virtual ~FileSystem() = default;
  FileSystem(const FileSystem&) = delete;
  FileSystem& operator=(const FileSystem&) = delete;

  /// `folder` for names that are absolute or relative to the working directory.
  static const int working_folder;

  virtual int open(int folder, const std::string& name, int flags, mode_t mode = 0);
  /// May report a late write error (network file systems).
  virtual int close(int file);
  virtual ssize_t read(int file, void* data, std::size_t size);
  virtual ssize_t write(int file, const void* data, std::size_t size);
  virtual int sync(int file);

  virtual int status(int file, struct stat& status);
  /// Of a symbolic link itself, not of its target.
  virtual int status(int folder, const std::string& name, struct stat& status);
  /// The permissions of an open file or folder, whatever the umask.
  virtual int set_mode(int file, mode_t mode);
  /// 0 when entries can be made in the folder: neither its mode nor a read-only mount forbids it.
  virtual int writable(int folder);

  virtual int make_folder(int folder, const std::string& name, mode_t mode);
  /// Atomic. Without `replace`: -EEXIST when the target exists; -EINVAL where the file system cannot promise
  /// that.
  virtual int rename(int from_folder, const std::string& from, int to_folder, const std::string& to,
                     bool replace);
  /// A second name for a file; -EEXIST when the target exists.
  virtual int link(int from_folder, const std::string& from, int to_folder, const std::string& to);
  virtual int remove(int folder, const std::string& name);
  virtual int remove_folder(int folder, const std::string& name);
  /// The names in an open folder, without "." and "..", in no particular order.
  virtual int list(int folder, std::vector<std::string>& names);

  /// Sets the time of modification of an open file to now.
  virtual int touch(int file);
  /// Bytes of the whole disk that holds an open folder.
  virtual int capacity(int folder, std::uint64_t& bytes);

  /// The mount that an open folder is in.
  virtual Mount mount(int folder);
  /// "<name of the host>-<boot id>": tells this machine, since its start, from every other. It has no '/'.
  virtual std::string machine();

  /// Takes the flock of an open file; -EWOULDBLOCK while another open file holds it. close() gives it back.
  /// The file must be open for writing: NFS makes byte-range locks of it, which fail otherwise (-EBADF).
  virtual int try_lock(int file);
  virtual bool process_alive(pid_t process);
  /// Nanoseconds since 1970, on the clock that stamps files.
  virtual std::int64_t now();
};

}  // namespace ballflow
